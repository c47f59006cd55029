// Effects hidden in a recording: what is added is what the key says, and nothing else is changed.
#include "analysis/blind/recorded.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "analysis/blind/key.hpp"
#include "analysis/blind/session/answer_trials.hpp"
#include "analysis/blind/session/diagnosing_solver.hpp"
#include "analysis/blind/session/make_trials.hpp"
#include "analysis/strapdown/case_identify.hpp"
#include "analysis/strapdown/sensed.hpp"
#include "core/base/check.hpp"
#include "core/estimate/layout.hpp"
#include "core/recording/recording_output.hpp"
#include "tests/support/program.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::blind::recorded_test {
namespace {

const std::string study_text = test::strapdown_study("45.75 deg", "9.80665 m/s^2") +
                               R"toml([monte_carlo]
seed = 3
[blind]
trials = 6
sizes = [15]
[blind.shares]
null = 1
single = 5
wrong_noise = 0
pair = 0
outside = 0
local = 0
)toml";

/// A unit turned by hand, its file, and the study.
struct Hand {
  test::ScratchFolder scratch;
  mc::Study study = mc::read_study(scratch.write("blind.toml", study_text));
  Recording recording;

  Hand() {
    test::StrapdownScript script;
    script.dwells = 18;
    script.seed = 5;
    Theta sensors = Theta::Zero();
    test::set(sensors, "D_F_x", 900.0);
    test::set(sensors, "s_y", 6000.0);
    test::set(sensors, "xi_z", -2200.0);
    test::set(sensors, "K0_x", 4000.0);
    write_recording(strapdown_recording(script, sensors), scratch.file("hand.csv"));
    recording = read_recording(scratch.file("hand.csv"), RecordingKind::strapdown, 9.80665);
  }
  TrialSource source() const { return {study, &recording}; }
  mc::Study nominal(const TrialPlan& plan) const {
    return mc::read_study(scratch.write("nominal.toml", source().nominal_text(plan)));
  }
  MadeTrial made(TrialPlan plan, Stratum stratum) const {
    plan.stratum = stratum;
    return hide_in(recording, study, nominal(plan), plan);
  }
};

/// A parameter found by a filter that has one more than the nominal one, as the sensors have it.
double found(const mc::Study& nominal, const Recording& recording, std::size_t param) {
  const strapdown::CaseStudy of = strapdown::case_study(nominal, recording);
  FilterSpec filter = strapdown::case_filter(nominal.filters.front(), of);
  const double sigma = filter.believed(param).sigma();
  filter.active.set(param);
  filter.priors[param] = normal(0.0, 1e3 * sigma);  // says nothing
  const BatchResult fit = fit_batch(filter, of.measured(), strapdown::start_of(filter, of));
  return strapdown::as_sensed(fit.estimate).find(param)->value;
}

}  // namespace

TEST(BlindRecorded, WhatIsHiddenIsFoundByWhoeverKnowsWhatToLookFor) {
  const Hand hand;
  int compared = 0;
  for (const TrialPlan& plan : hand.source().plans()) {
    if (plan.stratum != Stratum::single) continue;
    const MadeTrial with = hand.made(plan, Stratum::single),
                    without = hand.made(plan, Stratum::null);
    ASSERT_EQ(with.recording.rows(), without.recording.rows());
    const HiddenEffect& e = with.key.effects.at(0);
    EXPECT_DOUBLE_EQ(e.size, 15.0);
    EXPECT_GE(e.absorbed, 0.0);
    EXPECT_LE(e.absorbed, 1.0);
    if (e.parameters.size() != 1) continue;  // several share what is found
    ++compared;
    const std::size_t param = *TermLibrary::find(e.parameters[0].key);
    const mc::Study nominal = hand.nominal(plan);
    const double unit = TermLibrary::specs[param].unit.to_si,
                 change = found(nominal, with.recording, param) -
                          found(nominal, without.recording, param);
    // The same noise is in both; what is left is of second order, in sensors of a few percent.
    EXPECT_NEAR(change / unit, e.parameters[0].value, 0.05 * std::abs(e.parameters[0].value))
        << e.term << " " << e.parameters[0].key;
  }
  EXPECT_GE(compared, 2);
}

TEST(BlindRecorded, WhereNothingIsHiddenTheReadingsAreThoseOfTheRecording) {
  const Hand hand;
  const MadeTrial made = hand.made(hand.source().plans().front(), Stratum::null);
  EXPECT_TRUE(made.key.effects.empty());
  EXPECT_TRUE(made.key.certificate.concealed);
  const Channel& time = *hand.recording.find("time");
  const auto begin = std::ranges::find(time.values, made.recording.find("time")->values.front()) -
                     time.values.begin();
  for (const char* name : {"gyro_x", "acc_z"})
    for (std::size_t k = 0; k < made.recording.rows(); ++k)
      ASSERT_EQ(made.recording.find(name)->values[k],
                hand.recording.find(name)->values[static_cast<std::size_t>(begin) + k]);
  const double part =
      static_cast<double>(made.recording.rows()) / static_cast<double>(hand.recording.rows());
  EXPECT_GT(part, 0.55);  // two thirds of the rests, and the ways between them
}

TEST(BlindRecorded, TrialsAreSealedDiagnosedAndScoredLikeSimulatedOnes) {
  const Hand hand;
  const std::string folder = hand.scratch.file("out");
  const std::string key = make_trials(hand.source(), folder, {2}).value();
  EXPECT_EQ(test::text_of(folder + "/trials/0001/study.toml").find("blind]"), std::string::npos);
  ASSERT_TRUE(answer_trials(folder, diagnosing_solver(), {2}));
  std::size_t right = 0, effects = 0;
  for (const TrialScore& s : score_folder(folder)) {
    EXPECT_FALSE(s.answer.failed) << s.answer.failure;
    if (s.key.plan.stratum == Stratum::single) {
      ++effects;
      right += s.in_set;
      EXPECT_TRUE(s.detected) << s.key.effects[0].term;  // 15 sigma
    }
  }
  EXPECT_EQ(effects, 5u);
  EXPECT_GE(right, 3u);
  // The same again, and what is gone is made anew as it was.
  std::filesystem::remove(folder + "/trials/0002/recording.csv");
  restore_trials(hand.source(), folder, true);
  EXPECT_EQ(make_trials(hand.source(), folder, {1}).value(), key);
}

TEST(BlindRecorded, WhatCannotBeAskedForIsRefused) {
  Hand hand;
  const auto refused = [&](const TrialSource& source) {
    try {
      source.require_usable();
      source.plans();
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused(hand.source()), "");
  EXPECT_NE(refused({hand.study, nullptr}).find("Name one after the study"), std::string::npos);
  hand.study.blind.shares.pair = 1.0;
  EXPECT_NE(refused(hand.source()).find("null and single alone"), std::string::npos);
  hand.study.kind = RecordingKind::platform;
  EXPECT_NE(refused(hand.source()).find("strapdown unit alone"), std::string::npos);
}

}  // namespace drift::blind::recorded_test
