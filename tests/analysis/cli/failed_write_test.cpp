// A write that fails, once, anywhere, is never exit 0 with something else in the file.
#include "core/base/check.hpp"
#include "core/base/temporary_file.hpp"
#include "tests/support/faults.hpp"

namespace drift {
namespace {

using namespace drift::test;
namespace fs = std::filesystem;

constexpr int io_error = static_cast<int>(ExitCode::io);

void expect_no_temporaries(const std::string& folder) {
  for (const auto& entry : fs::directory_iterator(folder))
    EXPECT_FALSE(is_temporary(entry.path().filename().string())) << entry.path();
}

/// What is written under a fault is what is written without one, or nothing and exit code 6.
void expect_whole_or_nothing(const ScratchFolder& scratch, const std::string& program,
                             const std::string& command, const std::string& file,
                             const std::string& kind, std::size_t at_least) {
  const std::string target = scratch.file(file);
  ASSERT_EQ(run_program(program, command + " -o " + target).code, 0);
  const std::string whole = text_of(target);
  std::size_t seen = 0;
  const std::size_t calls = with_every_fault(
      program, command + " -o " + target, kind, [&](std::size_t at, const Answer& a) {
        seen += a.code == io_error;
        EXPECT_TRUE(a.code == 0 || a.code == io_error) << kind << " " << at << ": " << a.err;
        EXPECT_EQ(text_of(target), whole) << kind << " " << at << ", exit code " << a.code;
      });
  EXPECT_GE(calls, at_least) << "the faults do not reach " << file;
  EXPECT_GE(seen, std::min<std::size_t>(calls, 1));
  fs::remove(target);
  with_every_fault(program, command + " -o " + target, kind, [&](std::size_t at, const Answer& a) {
    EXPECT_EQ(fs::exists(target), a.code == 0) << kind << " " << at;
    if (a.code == 0) {
      EXPECT_EQ(text_of(target), whole) << kind << " " << at;
    }
    fs::remove(target);
  });
  expect_no_temporaries(scratch.path());
}

TEST(FailedWrite, OfAnExportIsExitCode6) {
  const ScratchFolder scratch;
  const std::string study = scratch.write(
      "s.toml",
      "schema = 1\ntitle = \"synthetic columns=12 points=2 fail_every=50\"\n[site]\n"
      "latitude = \"45.75 deg\"\n[plan]\npreset = \"six\"\n[truth]\ncoupling = \"eq5\"\n"
      "[[filter]]\nname = \"eq5\"\ncoupling = \"eq5\"\n[monte_carlo]\nruns = 320\n"
      "allowed_failures = 99\n");
  const std::string out = scratch.file("out");
  ASSERT_EQ(run_program(DRIFT_SYNTHETIC, "run " + study + " -o " + out).code, 0);
  for (const std::string format : {"hdf5", "csv", "json"})
    for (const std::string kind : {"write", "fsync", "close"})
      expect_whole_or_nothing(scratch, DRIFT_SYNTHETIC, "export " + out + " --format " + format,
                              "x." + format, kind, format == "hdf5" && kind == "write" ? 15 : 1);
}

TEST(FailedWrite, OfARecordingIsExitCode6) {
  const ScratchFolder scratch;
  const std::string study = std::string(DRIFT_SOURCE_DIR) + "/configs/cheap.toml";
  for (const std::string file : {"r.csv", "r.h5", "r.mat"})
    for (const std::string kind : {"write", "fsync", "close"})
      expect_whole_or_nothing(scratch, DRIFT_PROGRAM, "simulate '" + study + "'", file, kind, 1);
}

}  // namespace
}  // namespace drift
