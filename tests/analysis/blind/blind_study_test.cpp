#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <set>

#include "analysis/blind/key.hpp"
#include "analysis/blind/session/answer_trials.hpp"
#include "analysis/blind/session/make_trials.hpp"
#include "analysis/blind/session/seal.hpp"
#include "analysis/blind/summary.hpp"
#include "core/base/check.hpp"
#include "core/base/sha256.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_blind_study.hpp"

namespace drift::blind::blind_study_test {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;
using test::text_of;

mc::Study study_in(const ScratchFolder& scratch, const std::string& text = test::tiny_blind_study) {
  return mc::read_study(scratch.write("blind.toml", text));
}

Answer consistent(const std::string&, const std::string&) {
  return {};
}

TEST(BlindStudy, TheSolverGetsNeitherTruthNorSeedNorKey) {
  const ScratchFolder scratch;
  const mc::Study study = study_in(scratch);
  const std::string folder = scratch.file("out");
  const std::string hash = make_trials(study, folder, {1}).value();
  EXPECT_EQ(hash, sha256_hex(text_of(folder + "/key.json")));
  EXPECT_EQ(published_hash(folder, "key.json"), hash);
  for (int n = 1; n <= 6; ++n) {
    const std::string here = folder + "/trials/000" + std::to_string(n);
    const mc::Study given = mc::read_study(here + "/study.toml");
    EXPECT_FALSE(given.has_truth || given.has_blind);
    EXPECT_EQ(text_of(here + "/study.toml").find("seed"), std::string::npos);
    EXPECT_EQ(text_of(here + "/recording.csv").find("seed"), std::string::npos);
  }
}

TEST(BlindStudy, WhatIsHiddenHasTheSizeThatWasAskedFor) {
  const ScratchFolder scratch;
  const std::string folder = scratch.file("out");
  make_trials(study_in(scratch), folder, {1});
  for (const KeyEntry& k : read_key(text_of(folder + "/key.json")).entries) {
    switch (k.plan.stratum) {
      case Stratum::null:
        EXPECT_TRUE(k.effects.empty());
        break;
      case Stratum::wrong_noise:
        EXPECT_EQ(k.effects.size(), 1u);
        break;
      case Stratum::pair:
        EXPECT_EQ(k.effects.size(), 2u);
        [[fallthrough]];
      default:
        for (const HiddenEffect& e : k.effects) {
          EXPECT_NEAR(e.size, k.plan.size, 0.0101 * k.plan.size);  // the strength is sought to 1 %
          EXPECT_GE(e.absorbed, 0.0);
          EXPECT_LE(e.absorbed, 1.0);
        }
    }
    EXPECT_GT(k.certificate.chi2_per_dof, 0.0);
    EXPECT_LT(k.certificate.band_low, 1.0);
    EXPECT_GT(k.certificate.band_high, 1.0);
  }
}

TEST(BlindStudy, AFailingSolverIsRecordedAndStopsNoOther) {
  const ScratchFolder scratch;
  const std::string folder = scratch.file("out");
  make_trials(study_in(scratch), folder, {1});
  answer_trials(folder,
                [](const std::string& path, const std::string&) -> Answer {
                  if (path.find("0003") != std::string::npos)
                    throw std::runtime_error("no convergence");
                  return {};
                },
                {2});
  const auto scores = score_folder(folder);
  ASSERT_EQ(scores.size(), 6u);
  for (const TrialScore& s : scores) EXPECT_EQ(s.answer.failed, s.key.plan.number == 3);
  EXPECT_EQ(scores[2].answer.failure, "no convergence");
  EXPECT_EQ(summarise(scores).failed, 1u);
}

TEST(BlindStudy, AnswersAreKeptAndTheRestIsAnsweredLater) {
  const ScratchFolder scratch;
  const mc::Study study = study_in(scratch);
  const std::string folder = scratch.file("out");
  const std::string key = make_trials(study, folder, {1}).value();
  std::atomic<int> calls{0};
  const Solver counting = [&](const std::string&, const std::string&) {
    ++calls;
    return Answer{};
  };
  const std::string first = answer_trials(folder, counting, {1}).value();
  EXPECT_EQ(calls, 6);
  fs::remove(folder + "/trials/0002/answer.json");
  EXPECT_EQ(make_trials(study, folder, {1}), key);
  answer_trials(folder, counting, {1});
  EXPECT_EQ(calls, 7);
  EXPECT_EQ(first.size(), 64u);
}

TEST(BlindStudy, AChangedKeyOrChangedAnswersAreNotScored) {
  const ScratchFolder scratch;
  const std::string folder = scratch.file("out");
  make_trials(study_in(scratch), folder, {1});
  answer_trials(folder, consistent, {1});
  EXPECT_EQ(score_folder(folder).size(), 6u);
  for (const char* name : {"key.json", "answers.json"}) {
    const std::string path = folder + "/" + name, text = text_of(path);
    std::ofstream(path, std::ios::binary) << text << " ";
    try {
      score_folder(folder);
      ADD_FAILURE() << name;
    } catch (const InputError& e) {
      EXPECT_EQ(e.code(), ExitCode::self_check);
      EXPECT_NE(std::string(e.what()).find("was changed after it was sealed"), std::string::npos);
    }
    std::ofstream(path, std::ios::binary) << text;
  }
}

TEST(BlindStudy, NothingIsDiagnosedBeforeTheKeyIsSealedNorScoredBeforeTheAnswersAre) {
  const ScratchFolder scratch;
  const std::string folder = scratch.file("out");
  make_trials(study_in(scratch), folder, {1});
  EXPECT_THROW(score_folder(folder), InputError);
  fs::remove(folder + "/key.sha256");
  EXPECT_THROW(answer_trials(folder, consistent, {1}), InputError);
}

TEST(BlindStudy, AFolderOfAnotherStudyIsRefused) {
  const ScratchFolder scratch;
  const mc::Study study = study_in(scratch);
  const std::string folder = scratch.file("out");
  make_trials(study, folder, {1});
  mc::Study other = study;
  other.text += "# another\n";
  try {
    make_trials(other, folder, {1});
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_EQ(e.code(), ExitCode::store);
  }
}

TEST(BlindStudy, TrialsDependOnTheSeedAloneAndNotOnThreads) {
  const ScratchFolder scratch;
  const mc::Study study = study_in(scratch);
  const auto one = make_trials(study, scratch.file("one"), {1}),
             two = make_trials(study, scratch.file("two"), {2});
  EXPECT_EQ(one, two);
  for (int n = 1; n <= 6; ++n) {
    const std::string name = "/trials/000" + std::to_string(n) + "/recording.csv";
    EXPECT_EQ(text_of(scratch.file("one") + name), text_of(scratch.file("two") + name));
  }
}

}  // namespace
}  // namespace drift::blind::blind_study_test
