// A study whose own terms gave way to those of the next one computes nothing wrong: it says so.
#include "mc/study/own_terms_check.hpp"

#include <gtest/gtest.h>

#include "core/physics/own/own_terms.hpp"
#include "mc/engine/engine.hpp"
#include "mc/engine/study_work.hpp"
#include "mc/statistics/point_statistics.hpp"
#include "mc/store/study_identity.hpp"
#include "mc/study/declared_keys.hpp"
#include "mc/study/sweep.hpp"
#include "mc/task/study_task.hpp"
#include "mc/task/trace.hpp"
#include "tests/support/two_own_studies.hpp"

namespace drift::own_terms_check_test {
namespace {

using namespace drift::test;

/// The library is everybody's: it is left as it was.
class OwnTermsCheck : public testing::Test {
  KeptOwnTerms kept_;
};

bool is_current(const mc::Study& study) {
  return stale([&] { mc::require_own_terms(study); }).empty();
}

TEST_F(OwnTermsCheck, SaysWhatHappenedAndWhatToDo) {
  const mc::Study first = read_text(with_rumble(sine_rumble));
  EXPECT_TRUE(is_current(first));
  const mc::Study second = read_text(with_rumble(cosine_rumble));
  EXPECT_TRUE(is_current(second));
  const std::string said = stale([&] { mc::require_own_terms(first); });
  EXPECT_EQ(said.find(first.path + ": the own terms of another study have been read since"), 0u)
      << said;
  EXPECT_NE(said.find("now rumble, declared otherwise (expected those that this study was read "
                      "with: rumble). Read this study "
                      "again, or keep its terms by KeptOwnTerms"),
            std::string::npos)
      << said;
  const mc::Study third = read_text(no_rumble);
  EXPECT_FALSE(is_current(first));
  EXPECT_FALSE(is_current(second));
  read_text(with_rumble(cosine_rumble));
  EXPECT_TRUE(is_current(second)) << "read again";
  EXPECT_NE(stale([&] { mc::require_own_terms(third); })
                .find("now rumble (expected those that "
                      "this study was read with: none)"),
            std::string::npos);
}

TEST_F(OwnTermsCheck, TheSameTermsAreTheSameStudyOrNot) {
  const mc::Study study = read_text(with_rumble(sine_rumble));
  read_text(study.text);
  EXPECT_TRUE(is_current(study)) << "as it is written into a folder";
  read_text(with_rumble(sine_rumble), {{"plan.dwell", "\"10 min\""}});
  EXPECT_TRUE(is_current(study));
  {
    const KeptOwnTerms kept;
    read_text(with_rumble(cosine_rumble));
    EXPECT_FALSE(is_current(study));
  }
  EXPECT_TRUE(is_current(study)) << "kept";
  mc::declared_keys(config::Node{});
  EXPECT_TRUE(is_current(study)) << "looked at, not read";
  read_text(no_rumble);
  set_own_terms(*study.own_terms);
  EXPECT_TRUE(is_current(study)) << "put back";
  mc::Study by_hand;
  read_text(with_rumble(cosine_rumble));
  EXPECT_TRUE(is_current(by_hand));
}

TEST_F(OwnTermsCheck, AStudyThatCannotBeReadTakesNoPlace) {
  const mc::Study study = read_text(with_rumble(sine_rumble));
  for (const std::string& wrong :
       {with_rumble("A * sinn(t)"), with_rumble(cosine_rumble, "[nonsense]\n"),
        with_rumble(cosine_rumble, "[sweep]\n\"plan.preset\" = [\"six\", \"seven\"]\n"),
        std::string("schema = \n")}) {
    EXPECT_THROW(read_text(wrong), InputError);
    EXPECT_TRUE(is_current(study)) << wrong;
  }
}

TEST_F(OwnTermsCheck, NothingIsComputedWithTheTermsOfAnother) {
  const std::string sweep = "[sweep]\n\"truth.coupling\" = [\"eq5\", \"eq6\"]\n";
  const mc::Study study = read_text(with_rumble(sine_rumble)),
                  swept = read_text(with_rumble(sine_rumble, sweep));
  const mc::StudyTask task(study);
  const std::vector<mc::StudyPoint> points = mc::study_points(swept);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_TRUE(is_current(study)) << "points bring the same";
  const mc::StudyWork work = mc::work_of(swept);
  read_text(with_rumble(cosine_rumble));
  const std::pair<const char*, std::function<void()>> entrances[] = {
      {"study_points", [&] { mc::study_points(study); }},
      {"study_points of a sweep", [&] { mc::study_points(swept); }},
      {"StudyTask", [&] { mc::StudyTask again(study); }},
      {"study_tasks", [&] { mc::study_tasks(points); }},
      {"worker", [&] { task.worker(); }},
      {"work_of", [&] { mc::work_of(study); }},
      {"StudyColumns", [&] { mc::StudyColumns columns(study); }},
      {"PointStatistics", [&] { mc::PointStatistics statistics(study); }},
      {"trace_run", [&] { mc::trace_run(study, 0); }}};
  for (const auto& [name, entrance] : entrances)
    EXPECT_NE(stale(entrance).find("own terms of another study"), std::string::npos) << name;
  const StudyFile file("");
  const std::string folder = file.path() + ".results";
  mc::Manifest manifest = mc::make_manifest(mc::identity_of(swept), swept.text, work.points);
  manifest.runs = 20;
  mc::claim_folder(folder, manifest);
  const auto run = [&] {
    mc::Ranks ranks;
    return mc::run_study(work, {.runs = 20, .threads = 2}, folder, manifest, ranks);
  };
  EXPECT_NE(stale(run).find("own terms of another study"), std::string::npos) << stale(run);
  read_text(with_rumble(sine_rumble));
  EXPECT_TRUE(run().complete) << "and no run was stored before";
  for (const auto& [name, entrance] : entrances) EXPECT_EQ(stale(entrance), "") << name;
}

/// The numbers are those of the study, whatever was read in between.
TEST_F(OwnTermsCheck, WhatIsReadAgainComputesTheSame) {
  const auto row = [](const std::string& equation) {
    const mc::StudyTask task(read_text(with_rumble(equation)));
    std::vector<double> all(task.columns().size(), std::nan(""));
    EXPECT_EQ(task.worker()->execute(3, all).status, mc::RunStatus::ok);
    return all;
  };
  const std::vector<double> sine = row(sine_rumble), cosine = row(cosine_rumble);
  EXPECT_NE(sine, cosine);
  EXPECT_EQ(row(sine_rumble), sine);
}

}  // namespace
}  // namespace drift::own_terms_check_test
