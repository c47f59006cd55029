#include "mc/store/manifest.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/base/check.hpp"
#include "mc/store/store.hpp"
#include "mc/store/study_reader.hpp"
#include "mc/store/text_difference.hpp"
#include "tests/support/program.hpp"
#include "tests/support/synthetic_study.hpp"

namespace drift::manifest_test {
namespace {

using test::ScratchFolder;
using test::SyntheticStudy;

/// What claim_folder answers to a study that the folder does not hold.
std::string refusal(const std::string& folder, const SyntheticStudy& study) {
  try {
    mc::claim_folder(folder, study.manifest());
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::store);
    return error.what();
  }
  return "accepted";
}

TEST(Manifest, ReadsBackAsWritten) {
  const ScratchFolder folder;
  const SyntheticStudy study{.points = 3, .text = "a = 1\nb = \"\xc3\xa9\"\n"};
  const mc::Manifest written = study.manifest();
  mc::claim_folder(folder.path(), written);
  const mc::Manifest read = mc::read_manifest(folder.path());
  EXPECT_EQ(read.hash, written.hash);
  EXPECT_EQ(read.identity.text, study.text);
  ASSERT_EQ(read.points.size(), 3u);
  EXPECT_EQ(read.points[2].label, "point 2");
  EXPECT_EQ(read.points[2].columns[1].name, "made/1");
  EXPECT_EQ(read.points[2].columns[1].unit.to_si, unit::arcsec.to_si);
  EXPECT_EQ(read.provenance, written.provenance);
  EXPECT_EQ(test::text_of(folder.file("study.toml")), study.text);
}

TEST(Manifest, RemembersTheMostThatWasAskedForAndTheMostThatWasComplete) {
  const ScratchFolder folder;
  SyntheticStudy study{.options = {.runs = 100}};
  study.run(folder.path());
  EXPECT_EQ(mc::read_manifest(folder.path()).finished, 100u);
  const auto written = std::filesystem::last_write_time(folder.file("manifest.json"));
  study.run(folder.path());
  EXPECT_EQ(std::filesystem::last_write_time(folder.file("manifest.json")), written)
      << "nothing new, nothing written";
  study.options.runs = 300;
  study.options.share = {0, 2};
  study.run(folder.path());
  study.options.runs = 20;
  study.options.share = {};
  study.run(folder.path());
  const mc::Manifest m = mc::read_manifest(folder.path());
  EXPECT_EQ(m.runs, 300u);
  EXPECT_EQ(m.finished, 100u) << "the other worker's part of 300 is not there";
  std::filesystem::remove(folder.file("worker-0000.sqlite"));
  EXPECT_EQ(mc::StudyReader(folder.path()).runs(), 300u);
}

TEST(Manifest, AnotherStudyIsRefusedWithWhatDiffersAndNothingIsChanged) {
  const ScratchFolder folder;
  SyntheticStudy study{.text = "a = 1\nb = 2\nc = 3\n"};
  mc::claim_folder(folder.path(), study.manifest());
  EXPECT_EQ(refusal(folder.path(), study), "accepted");
  const std::string before = test::text_of(folder.file("manifest.json"));
  SyntheticStudy other = study;
  other.text = "a = 1\nb = 5\nc = 3\n";
  const std::string why = refusal(folder.path(), other);
  EXPECT_NE(why.find("- b = 2\n  + b = 5"), std::string::npos) << why;
  EXPECT_EQ(why.find("c = 3"), std::string::npos) << why;
  other = study;
  other.task.seed = 2;
  EXPECT_NE(refusal(folder.path(), other).find("seed: 1 in the folder, 2 asked for"),
            std::string::npos);
  other = study;
  other.block_size = 32;
  EXPECT_NE(refusal(folder.path(), other).find("block size: 64 in the folder, 32 asked for"),
            std::string::npos);
  other = study;
  other.task.columns = 6;
  EXPECT_NE(refusal(folder.path(), other).find("other columns"), std::string::npos);
  EXPECT_EQ(test::text_of(folder.file("manifest.json")), before);
  EXPECT_EQ(test::text_of(folder.file("study.toml")), study.text);
}

TEST(Manifest, ResultsOfAnotherArithmeticAreNotMixedIn) {
  const ScratchFolder folder;
  const SyntheticStudy study;
  mc::Manifest elsewhere = study.manifest();
  elsewhere.arithmetic = "000000000000";
  mc::claim_folder(folder.path(), elsewhere);
  EXPECT_NE(refusal(folder.path(), study).find("arithmetic of the C library"), std::string::npos);
}

TEST(Manifest, ResultsOfAnotherCompilerAreNotMixedIn) {
  const ScratchFolder folder;
  const SyntheticStudy study;
  mc::Manifest elsewhere = study.manifest();
  for (auto& [key, value] : elsewhere.provenance)
    if (key == "compiler") value = "another 1.0";
  mc::claim_folder(folder.path(), elsewhere);
  EXPECT_NE(refusal(folder.path(), study).find("compiler: another 1.0 in the folder"),
            std::string::npos);
}

/// A folder of two workers, made by `study`.
void fill(const std::string& folder, SyntheticStudy study) {
  for (const std::size_t worker : {0u, 1u}) {
    study.options.share = {worker, 2};
    study.run(folder);
  }
}

/// What a reader of a folder answers.
std::string reading(const std::string& folder) {
  try {
    mc::StudyReader reader(folder);
    return "read";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::store);
    return error.what();
  }
}

/// Parts that were computed elsewhere and copied together.
TEST(Origin, AFileOfAnotherArithmeticIsRefusedByAllAndNothingOfItIsChanged) {
  const ScratchFolder folder;
  const SyntheticStudy study;
  fill(folder.file("ours"), study);
  mc::Manifest elsewhere = study.manifest();
  elsewhere.arithmetic = "bb3d00000000";
  mc::claim_folder(folder.file("theirs"), elsewhere);
  {
    mc::WorkerStore store(folder.file("theirs"), 2, elsewhere);
    store.begin_session(300);
  }
  const std::string foreign = folder.file("ours") + "/worker-0002.sqlite";
  std::filesystem::copy_file(folder.file("theirs") + "/worker-0002.sqlite", foreign);
  const std::string before = test::text_of(foreign);
  const std::string said = reading(folder.file("ours"));
  EXPECT_NE(said.find("worker-0002.sqlite: holds results of another study, program or arithmetic"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("- arithmetic bb3d00000000"), std::string::npos) << said;
  SyntheticStudy third = study;
  for (const mc::WorkerShare share : {mc::WorkerShare{}, mc::WorkerShare{2, 3}}) {
    third.options.share = share;
    EXPECT_THROW(third.run(folder.file("ours")), InputError);
  }
  // Where no manifest says what the folder is of, none is made either.
  std::filesystem::remove(folder.file("ours") + "/manifest.json");
  EXPECT_NE(refusal(folder.file("ours"), study).find("worker-0002.sqlite"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder.file("ours") + "/manifest.json"));
  EXPECT_EQ(test::text_of(foreign), before);
  std::filesystem::remove(foreign);
  fill(folder.file("ours"), study);
  EXPECT_EQ(reading(folder.file("ours")), "read");
}

TEST(Origin, SoundBlocksOfAnotherStudyAreNotTakenForDamaged) {
  const ScratchFolder folder;
  const SyntheticStudy study;
  fill(folder.path(), study);
  const std::string file = folder.file("worker-0000.sqlite"), before = test::text_of(file);
  std::filesystem::remove(folder.file("manifest.json"));
  EXPECT_NE(reading(folder.path()).find("it is made anew, and what is stored is kept"),
            std::string::npos);
  SyntheticStudy other;
  other.task.seed = study.task.seed + 1;
  const std::string said = refusal(folder.path(), other);
  EXPECT_NE(said.find("- seed"), std::string::npos) << said;
  EXPECT_EQ(test::text_of(file), before);
  mc::claim_folder(folder.path(), study.manifest());
  EXPECT_EQ(study.run(folder.path()).done, 0u) << "nothing was lost";
}

TEST(Origin, ADamagedTableIsMendedAndNoOtherStudy) {
  const ScratchFolder folder;
  const SyntheticStudy study;
  fill(folder.path(), study);
  mc::Database(folder.file("worker-0000.sqlite"), mc::Database::Use::write)
      .execute("UPDATE study SET value = 'another' WHERE key = 'arithmetic'");
  EXPECT_EQ(reading(folder.path()), "read");
  fill(folder.path(), study);
  mc::StudyReader reader(folder.path());
  EXPECT_TRUE(reader.misfits().empty());
}

TEST(Manifest, OfManyThatClaimAFolderAtOnceOneMakesItAndTheOthersJoin) {
  const ScratchFolder folder;
  const SyntheticStudy study;
  std::vector<std::jthread> claims;
  std::atomic<int> refused = 0;
  for (int i = 0; i < 8; ++i)
    claims.emplace_back([&] {
      try {
        mc::claim_folder(folder.file("new"), study.manifest());
      } catch (const InputError&) {
        ++refused;
      }
    });
  claims.clear();
  EXPECT_EQ(refused, 0);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.file("new")))
    ++files;
  EXPECT_EQ(files, 2u) << "no temporary files are left";
}

TEST(Manifest, DamageIsNoticed) {
  const ScratchFolder folder;
  EXPECT_THROW(mc::read_manifest(folder.path()), InputError);
  mc::claim_folder(folder.path(), SyntheticStudy{}.manifest());
  const std::string path = folder.file("manifest.json"), text = test::text_of(path);
  for (std::string damaged :
       {std::string(), text.substr(0, text.size() / 2), std::string("[1]"), std::string("\xff")}) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << damaged;
    EXPECT_THROW(mc::read_manifest(folder.path()), InputError) << damaged.substr(0, 20);
  }
  std::string other_seed = text;
  other_seed.replace(other_seed.find("\"seed\": 1"), 9, "\"seed\": 3");
  std::ofstream(path, std::ios::binary | std::ios::trunc) << other_seed;
  EXPECT_THROW(mc::read_manifest(folder.path()), InputError);
}

TEST(Manifest, EveryByteIsGuarded) {
  const ScratchFolder folder;
  mc::claim_folder(folder.path(), SyntheticStudy{.points = 2}.manifest());
  const std::string path = folder.file("manifest.json"), text = test::text_of(path);
  for (std::size_t at = 0; at < text.size(); ++at) {
    std::string damaged = text;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << at % 8));
    std::ofstream(path, std::ios::binary | std::ios::trunc) << damaged;
    EXPECT_THROW(mc::read_manifest(folder.path()), InputError)
        << "byte " << at << ": " << text.substr(at > 20 ? at - 20 : 0, 40);
  }
}

TEST(Manifest, OfTheFormatBeforeIsReadAndRenewedByTheNextRun) {
  const ScratchFolder folder;
  const SyntheticStudy study;
  const std::string digest = study.run(folder.path()).digest;
  const std::string path = folder.file("manifest.json");
  auto json = nlohmann::ordered_json::parse(test::text_of(path));
  json["format"] = 1;
  json.erase("checksum");
  std::ofstream(path, std::ios::binary | std::ios::trunc) << json.dump(1) << "\n";
  EXPECT_EQ(mc::read_manifest(folder.path()).read_as, 1);
  EXPECT_EQ(study.run(folder.path()).digest, digest);
  EXPECT_EQ(mc::read_manifest(folder.path()).read_as, mc::Manifest::file_format);
}

TEST(TextDifference, ShowsChangedLinesOnly) {
  EXPECT_TRUE(mc::difference("a\nb\n", "a\nb\n").empty());
  EXPECT_EQ(mc::difference("a\nb\nc\n", "a\nc\nd\n"), (std::vector<std::string>{"- b", "+ d"}));
  EXPECT_EQ(mc::difference("", "1\n2\n3\n", 2),
            (std::vector<std::string>{"+ 1", "+ 2", "... and 1 more"}));
}

}  // namespace
}  // namespace drift::manifest_test
