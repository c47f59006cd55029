// No command answers from less than what was stored without saying so.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "tests/support/faults.hpp"

namespace drift::damage_told_test {
namespace {

using namespace drift::test;
namespace fs = std::filesystem;

/// A complete study of two blocks.
struct Folder : ScratchFolder {
  std::string study = write("s.toml", cheap_study()), out = file("out"),
              line = "run " + study + " --runs 128 --threads 1 --progress none -o " + out;
  Folder() { EXPECT_EQ(driftscope(line).code, 0); }
  /// Flips a bit of what the second half of the file holds, the rows of a block.
  void damage() const {
    const std::string path = out + "/worker-0000.sqlite";
    std::string bytes = text_of(path);
    bytes[bytes.size() - 2000] = static_cast<char>(bytes[bytes.size() - 2000] ^ 1);
    std::ofstream(path, std::ios::binary) << bytes;
  }
};

void expect_says(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "expected: " << part << "\nin: " << text;
}

TEST(DamageTold, AReportIsNotMadeOfWhatIsLeft) {
  const Folder folder;
  const std::string report = text_of(folder.out + "/report.html");
  folder.damage();
  const Answer a = driftscope("report " + folder.out);
  EXPECT_EQ(a.code, store_error) << a.out;
  expect_says(a.err, "damage: ");
  expect_says(a.err, "of 1 of 1 points results are not there any more");
  EXPECT_EQ(text_of(folder.out + "/report.html"), report);
  EXPECT_EQ(driftscope(folder.line).code, 0);
  EXPECT_EQ(driftscope("report " + folder.out).code, 0);
}

TEST(DamageTold, ARunWhoseBlockIsDamagedIsNotCalledNew) {
  const Folder folder;
  folder.damage();
  int damaged = 0;
  for (const char* run : {"0", "127"}) {
    const Answer a = driftscope("replay " + folder.out + " --run " + run);
    if (a.code == 0) continue;
    ++damaged;
    EXPECT_EQ(a.code, store_error);
    expect_says(a.out, "what is stored of it is damaged");
    expect_says(a.err, "is damaged (expected a whole one)");
  }
  EXPECT_EQ(damaged, 1);
}

TEST(DamageTold, AFileThatIsCutOffIsNotToBeMovedAwayAsItsWholeBlocksAreTakenOver) {
  const Folder folder;
  const std::string file = folder.out + "/worker-0000.sqlite";
  const std::string more =
      "run " + folder.study + " --runs 640 --threads 1 --progress none -o " + folder.out;
  const Answer whole = driftscope(more);
  ASSERT_EQ(whole.code, 0) << whole.err;
  fs::resize_file(file, fs::file_size(file) / 4 * 3);
  const Answer verify = driftscope("verify " + folder.out + " --sample 0%");
  EXPECT_EQ(verify.code, store_error);
  for (const std::string& said : {driftscope("status " + folder.out).out, verify.out}) {
    expect_says(said, "run the same command (the one of this worker): whole blocks are taken over");
    EXPECT_EQ(said.find("worker-0000.sqlite: the structure of the file is damaged. Move it away"),
              std::string::npos)
        << said;
  }
  const Answer again = driftscope(more);
  EXPECT_EQ(again.out, whole.out);
  expect_says(again.err, " whole blocks taken over from it");
  EXPECT_EQ(again.err.find(" 0 whole blocks"), std::string::npos) << again.err;
}

TEST(DamageTold, VerifyKnowsWhatWasWrittenBesideTheResults) {
  const Folder folder;
  for (const char* name : {"summary.json", "report.html"}) {
    const std::string path = folder.out + "/" + name, whole = text_of(path);
    std::string text = whole;
    text[text.size() / 2] = static_cast<char>(text[text.size() / 2] ^ 1);
    std::ofstream(path, std::ios::binary) << text;
    const Answer a = driftscope("verify " + folder.out + " --sample 0%");
    EXPECT_EQ(a.code, store_error);
    expect_says(a.out, std::string(name) + ": not as driftscope wrote it");
    std::ofstream(path, std::ios::binary) << whole;
  }
  EXPECT_EQ(driftscope("verify " + folder.out + " --sample 0%").code, 0);
}

/// Exit 0 with another answer is what must not be; a disk that cannot be read is told as that.
TEST(DamageTold, AReadThatFailsOnceGivesNoOtherAnswer) {
  const Folder folder;
  ::setenv("DRIFT_FAULT_UNDER", folder.path().c_str(), 1);
  ::setenv("DRIFT_FAULT_ERRNO", "5", 1);
  const std::string kept = folder.file("kept");
  fs::copy(folder.out, kept, fs::copy_options::recursive);
  // Each fault meets the same folder: what was set aside after one is read by the next.
  const auto restored = [&](std::size_t) {
    fs::remove_all(folder.out);
    fs::copy(kept, folder.out, fs::copy_options::recursive);
  };
  for (const std::string& line : {"report " + folder.out, folder.line}) {
    const std::string whole = driftscope(line).out;
    const std::size_t faults =
        with_faults(DRIFT_PROGRAM, line, "read", 1, restored, [&](std::size_t at, const Answer& a) {
          if (a.code == 0) {
            EXPECT_EQ(a.out, whole) << line << ", read " << at << "\n" << a.err;
          }
          EXPECT_EQ(a.err.find("changed since"), std::string::npos) << at << ": " << a.err;
          EXPECT_EQ(a.err.find("filebuf"), std::string::npos) << at << ": " << a.err;
        });
    EXPECT_GE(faults, 20u) << line;
    EXPECT_EQ(driftscope(line).out, whole);
  }
  ::unsetenv("DRIFT_FAULT_UNDER");
  ::unsetenv("DRIFT_FAULT_ERRNO");
}

/// HDF5 calls what it cannot read damaged; from the second of all reads on the disk gives nothing.
TEST(DamageTold, ARecordingThatTheDiskDoesNotGiveIsNotCalledDamaged) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", cheap_study()), made = folder.file("r.h5");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + made).code, 0);
  fs::create_directory(folder.file("disk"));
  fs::rename(made, folder.file("disk/r.h5"));
  const Answer a =
      run_program("/usr/bin/env", "LD_PRELOAD=" DRIFT_FAULTS
                                  " DRIFT_FAULT_AT=1 DRIFT_FAULT_STICKY=1 "
                                  "DRIFT_FAULT_KIND=read DRIFT_FAULT_ERRNO=5 DRIFT_FAULT_UNDER='" +
                                      folder.file("disk") + "' " DRIFT_PROGRAM " identify " +
                                      study + " " + folder.file("disk/r.h5"));
  EXPECT_EQ(a.code, io_error) << a.out << a.err;
  expect_says(a.err, "cannot be read: Input/output error");
}

}  // namespace
}  // namespace drift::damage_told_test
