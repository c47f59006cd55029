// No estimate, diagnosis, ranking or report is made of a study with the own terms of another.
#include <gtest/gtest.h>

#include <functional>

#include "analysis/blind/source.hpp"
#include "analysis/diagnosis/diagnose_recordings.hpp"
#include "analysis/identification/identify.hpp"
#include "analysis/planning/rank.hpp"
#include "analysis/preparation/prepare.hpp"
#include "analysis/preparation/recorded_test.hpp"
#include "analysis/report/identify/report.hpp"
#include "analysis/report/rank/report.hpp"
#include "analysis/strapdown/case_study.hpp"
#include "core/physics/own/own_terms.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/two_own_studies.hpp"

namespace drift::own_terms_of_another_test {
namespace {

using namespace drift::test;

class OwnTermsOfAnother : public testing::Test {
  KeptOwnTerms kept_;
};

Recording recorded(const mc::Study& study) {
  const Timeline timeline = lay_out(study.plan, study.site);
  return make_recording(
      timeline, Simulator(study.truth, study.readout).run(timeline, 3, 0).measured, study.readout);
}

TEST_F(OwnTermsOfAnother, AreRefusedByWhateverComputes) {
  const mc::Study study = read_text(with_rumble(sine_rumble));
  const Recording recording = recorded(study);
  diagnosis::RecordingsOptions options;
  options.advising = diagnosis::Advising::left_out;
  options.diagnose.whiteness_draws = 0;
  const identification::Identification id = identification::identify_simulated(study, 0, 1);
  const planning::PlanRanking ranking = planning::rank_plan(study, {});
  const std::pair<const char*, std::function<void()>> entrances[] = {
      {"prepare", [&] { preparation::prepare(study, {recording}); }},
      {"recorded_test", [&] { preparation::recorded_test(study, {recording}); }},
      {"identify_simulated", [&] { identification::identify_simulated(study, 0, 1); }},
      {"identify_recordings", [&] { identification::identify_recordings(study, {recording}, 1); }},
      {"diagnose", [&] { diagnosis::diagnose(study, {recording}, options.diagnose); }},
      {"diagnose_recordings", [&] { diagnosis::diagnose_recordings(study, {recording}, options); }},
      {"rank_plan", [&] { planning::rank_plan(study, {}); }},
      {"criterion_of", [&] { planning::criterion_of(study, "A"); }},
      {"identification_report", [&] { report::identification_report(study, id); }},
      {"rank_report", [&] { report::rank_report(study, ranking); }}};
  for (const auto& [name, entrance] : entrances) EXPECT_EQ(stale(entrance), "") << name;
  for (const std::string& other : {with_rumble(cosine_rumble), no_rumble}) {
    read_text(other);
    for (const auto& [name, entrance] : entrances)
      EXPECT_NE(stale(entrance).find("own terms of another study"), std::string::npos) << name;
    EXPECT_NE(
        stale([&] { strapdown::case_study(study, recording); }).find("own terms of another study"),
        std::string::npos);
  }
  read_text(with_rumble(sine_rumble));
  for (const auto& [name, entrance] : entrances) EXPECT_EQ(stale(entrance), "") << name;
}

/// The study that a solver gets has the terms of the blind study: neither is another's.
TEST_F(OwnTermsOfAnother, ATrialOfABlindStudyHasTheSame) {
  const mc::Study study = read_text(with_rumble(sine_rumble, R"toml([blind]
trials = 3
plans = ["six"]
couplings = ["eq5"]
sizes = [6]
most_prior_sigmas = 100
[blind.shares]
null = 1
wrong_noise = 0
single = 2
pair = 0
outside = 0
local = 0
)toml"));
  const blind::TrialSource source(study);
  source.require_usable();
  for (const blind::TrialPlan& plan : source.plans()) {
    const mc::Study nominal = mc::read_study_text(source.nominal_text(plan), "trial.toml");
    const blind::MadeTrial made = source.make(nominal, plan);
    EXPECT_EQ(stale([&] { preparation::prepare(nominal, {made.recording}); }), "");
    EXPECT_EQ(stale([&] { preparation::prepare(study, {made.recording}); }), "");
  }
  const mc::Study nominal = mc::read_study_text(source.nominal_text(source.plans().front()), "t");
  read_text(no_rumble);
  EXPECT_NE(stale([&] {
              source.make(nominal, source.plans().front());
            }).find("own terms of another study"),
            std::string::npos);
}

}  // namespace
}  // namespace drift::own_terms_of_another_test
