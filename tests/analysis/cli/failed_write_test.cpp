// A write that fails, once, anywhere, is never exit 0 with something else in the file.
#include "core/base/check.hpp"
#include "core/base/temporary_file.hpp"
#include "tests/support/faults.hpp"

namespace drift::failed_write_test {
namespace {

using namespace drift::test;
namespace fs = std::filesystem;

void expect_no_temporaries(const std::string& folder) {
  for (const auto& entry : fs::directory_iterator(folder))
    EXPECT_FALSE(is_temporary(entry.path().filename().string())) << entry.path();
}

/// What is written under a fault is what is written without one, or nothing and exit code 6; an
/// earlier file stays as it was.
void expect_whole_or_nothing(const ScratchFolder& scratch, const std::string& program,
                             const std::string& command, const std::string& file,
                             const std::string& kind, std::size_t stride) {
  const std::string target = scratch.file(file), line = command + " -o " + target;
  ASSERT_EQ(run_program(program, line).code, 0);
  const std::string whole = text_of(target);
  std::size_t told = 0;
  const std::size_t faults = with_faults(
      program, line, kind, stride,
      [&](std::size_t at) {
        if (at / stride % 2 == 1)
          fs::remove(target);
        else
          scratch.write(file, whole);
      },
      [&](std::size_t at, const Answer& a) {
        told += a.code == io_error;
        EXPECT_TRUE(a.code == 0 || a.code == io_error) << kind << " " << at << ": " << a.err;
        EXPECT_TRUE(fs::exists(target) || a.code != 0) << kind << " " << at;
        if (fs::exists(target)) {
          EXPECT_TRUE(text_of(target) == whole)
              << file << ", " << kind << " " << at << ", exit code " << a.code;
        }
      });
  EXPECT_GE(faults, 1u) << "no fault reaches " << file;
  if (kind == "write") {
    EXPECT_EQ(told, faults) << "a write that failed was not noticed";
  }
  expect_no_temporaries(scratch.path());
}

TEST(FailedWrite, OfAnExportIsExitCode6) {
  const ScratchFolder scratch;
  const std::string study = scratch.write(
      "s.toml",
      "schema = 1\ntitle = \"synthetic columns=6 fail_every=50\"\n[site]\n"
      "latitude = \"45.75 deg\"\n[plan]\npreset = \"six\"\n[truth]\ncoupling = \"eq5\"\n"
      "[[filter]]\nname = \"eq5\"\ncoupling = \"eq5\"\n[monte_carlo]\nruns = 96\n"
      "allowed_failures = 99\n");
  const std::string out = scratch.file("out");
  ASSERT_EQ(run_program(DRIFT_SYNTHETIC, "run " + study + " -o " + out).code, 0);
  for (const auto& [format, stride] :
       {std::pair<std::string, std::size_t>{"hdf5", 1}, {"csv", 7}, {"json", 7}})
    for (const std::string kind : {"write", "fsync", "close"})
      expect_whole_or_nothing(scratch, DRIFT_SYNTHETIC, "export " + out + " --format " + format,
                              "x." + format, kind, kind == "write" ? stride : 1);
}

TEST(FailedWrite, OfARecordingIsExitCode6) {
  const ScratchFolder scratch;
  const std::string study = std::string(DRIFT_SOURCE_DIR) + "/configs/cheap.toml";
  for (const auto& [file, stride] :
       {std::pair<std::string, std::size_t>{"r.csv", 1}, {"r.h5", 1}, {"r.mat", 43}})
    for (const std::string kind : {"write", "fsync", "close"})
      expect_whole_or_nothing(scratch, DRIFT_PROGRAM, "simulate '" + study + "'", file, kind,
                              kind == "write" ? stride : 1);
}

TEST(FailedWrite, OfNamedArraysIsExitCode6) {
  const ScratchFolder scratch;
  const std::string out = scratch.file("out");
  ASSERT_EQ(driftscope("run " + config("cheap.toml") + " --runs 64 -o " + out).code, 0);
  for (const std::string kind : {"write", "fsync", "close"})
    expect_whole_or_nothing(scratch, DRIFT_PROGRAM, "export " + out + " --format netcdf", "x.nc",
                            kind, kind == "write" ? 11 : 1);
}

TEST(FailedWrite, OfATextIsExitCode6) {
  const ScratchFolder scratch;
  const std::string target = scratch.file("new.toml");
  ASSERT_EQ(driftscope("new study -o " + target).code, 0);
  const std::string whole = text_of(target);
  for (const std::string kind : {"write", "fsync", "open", "rename", "close"}) {
    const std::size_t faults = with_faults(
        DRIFT_PROGRAM, "new study -o " + target, kind, 1, [&](std::size_t) { fs::remove(target); },
        [&](std::size_t at, const Answer& a) {
          // Exit code 6 with the file where its name may not have reached the disk.
          EXPECT_TRUE(a.code != 0 || fs::exists(target)) << kind << " " << at;
          if (fs::exists(target)) {
            EXPECT_EQ(text_of(target), whole) << kind << " " << at << ": " << a.err;
          }
          EXPECT_TRUE(a.code == 0 || a.code == io_error) << kind << " " << at << ": " << a.err;
          EXPECT_TRUE(kind != "write" || a.code == io_error) << at;
        });
    EXPECT_GE(faults, 1u) << "no fault of " << kind << " reaches it";
  }
}

}  // namespace
}  // namespace drift::failed_write_test
