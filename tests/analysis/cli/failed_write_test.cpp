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

/// What an answer says, whenever it was made; empty where there is none.
std::string numbers_of(const std::string& folder) {
  std::string all = text_of(folder + "/identification.json");
  if (const auto date = all.find("\"date\":"); date != std::string::npos)
    all.erase(date, all.find('\n', date) - date);
  for (const char* name : {"/estimates.csv", "/residuals.csv", "/recording.csv"})
    all += text_of(folder + name);
  return all;
}

/// An answer of --seed 2 under a fault, into no folder or, every other time, over the answer in
/// `kept`: all of it is there, or nothing, or the one of before.
void expect_answer_or_before(const std::string& command, const std::string& out,
                             const std::string& kept, const std::string& fresh,
                             const std::string& kind, std::size_t stride) {
  const std::string before = numbers_of(kept);
  ASSERT_NE(before, fresh);
  const auto over_another = [&](std::size_t at) { return at / stride % 2 == 1; };
  const std::size_t faults = with_faults(
      DRIFT_PROGRAM, command + " --seed 2", kind, stride,
      [&](std::size_t at) {
        fs::remove_all(out);
        if (over_another(at)) fs::copy(kept, out, fs::copy_options::recursive);
      },
      [&](std::size_t at, const Answer& a) {
        const std::string now = numbers_of(out);
        const bool named = a.err.find("may not have reached the disk") != std::string::npos;
        EXPECT_TRUE(a.code == 0 || a.code == io_error) << kind << " " << at << ": " << a.err;
        EXPECT_TRUE(now == (a.code == 0 || named ? fresh
                            : over_another(at)   ? before
                                                 : ""))
            << kind << " " << at << ", exit code " << a.code << ": " << a.err;
        EXPECT_EQ(fs::exists(out), !now.empty()) << kind << " " << at;
        if (fs::exists(out)) expect_no_temporaries(out);
      });
  EXPECT_GE(faults, 2u) << "no fault of " << kind << " reaches it";
}

/// A folder with some files of an answer would look like one.
TEST(FailedWrite, OfAnAnswerLeavesNothingOrTheOneBefore) {
  const ScratchFolder scratch;
  const std::string out = scratch.file("out"), kept = scratch.file("kept"),
                    command = "identify " + config("cheap.toml") + " --progress none -o " + out;
  ASSERT_EQ(driftscope(command + " --seed 1").code, 0);
  fs::copy(out, kept, fs::copy_options::recursive);
  fs::remove_all(out);
  ASSERT_EQ(driftscope(command + " --seed 2").code, 0);
  const std::string fresh = numbers_of(out);
  for (const auto& [kind, stride] : {std::pair<std::string, std::size_t>{"write", 13},
                                     {"open", 3},
                                     {"rename", 1},
                                     {"close", 5},
                                     {"fsync", 3}})
    expect_answer_or_before(command, out, kept, fresh, kind, stride);
}

/// Told to end while its files take the place of another's, it ends when they have.
TEST(FailedWrite, ASignalBetweenTheFilesOfAnAnswerMixesNoTwo) {
  const ScratchFolder scratch;
  const std::string out = scratch.file("out"), kept = scratch.file("kept"),
                    command = "identify " + config("cheap.toml") + " --progress none -o ";
  ASSERT_EQ(driftscope(command + kept + " --seed 1").code, 0);
  ASSERT_EQ(driftscope(command + out + " --seed 2").code, 0);
  const std::string before = numbers_of(kept), fresh = numbers_of(out);
  std::size_t done = 0;
  const std::size_t signals = with_faults(
      DRIFT_PROGRAM, command + out + " --seed 2", "rename", 1,
      [&](std::size_t) {
        fs::remove_all(out);
        fs::copy(kept, out, fs::copy_options::recursive);
      },
      [&](std::size_t at, const Answer& a) {
        const std::string now = numbers_of(out);
        EXPECT_EQ(a.code, static_cast<int>(ExitCode::terminated)) << at << ": " << a.err;
        EXPECT_TRUE(now == before || now == fresh) << "mixed at " << at;
        done += now == fresh;
        expect_no_temporaries(out);
      },
      "DRIFT_FAULT_SIGNAL=15");
  EXPECT_GE(signals, 4u) << "one for each file";
  EXPECT_GE(done, 2u) << "none came between the files";
}

TEST(FailedWrite, OnADiskThatStaysFullLeavesNoAnswer) {
  const ScratchFolder scratch;
  const std::string out = scratch.file("out");
  for (const char* at : {"1", "4", "20"}) {
    const Answer a = run_program("/usr/bin/env",
                                 std::string("LD_PRELOAD=" DRIFT_FAULTS " DRIFT_FAULT_KIND=write "
                                             "DRIFT_FAULT_STICKY=1 DRIFT_FAULT_AT=") +
                                     at + " '" DRIFT_PROGRAM "' identify " + config("cheap.toml") +
                                     " --progress none -o " + out);
    EXPECT_EQ(a.code, io_error) << a.err;
    EXPECT_NE(a.err.find("Nothing was changed"), std::string::npos) << a.err;
    EXPECT_FALSE(fs::exists(out)) << at;
  }
}

}  // namespace
}  // namespace drift::failed_write_test
