// What is said of several recordings: which of them.
#include <gtest/gtest.h>

#include "analysis/inference/noise/noise_component.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/diagnosis/words/not_examined_words.hpp"
#include "analysis/report/diagnosis/words/remark_words.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "analysis/report/diagnosis/words/words.hpp"

namespace drift::several_recordings_words_test {
namespace {

const std::vector<diagnosis::RecordingSpan> two{{"a.csv", 0.0, 900.0, 0.0},
                                                {"b.csv", 900.0, 3600.0, 800.0}};

TEST(SeveralRecordingsWords, SayFromWhichOneOnSomethingIsAnother) {
  diagnosis::RecoveredSignal s;
  s.shape.kind = diagnosis::Shape::Kind::onset;
  s.correlation = 0.9;
  s.shape.seconds = 900.0;
  EXPECT_EQ(report::shape_text(s, two),
            "is another from recording 2 (b.csv) on (correlation 0.90)");
  EXPECT_EQ(report::shape_text(s), "sets in at 900 s and stays (correlation 0.90)");
  s.shape.seconds = 1200.0;
  EXPECT_EQ(report::shape_text(s, two), "sets in at 400 s of b.csv and stays (correlation 0.90)");
  diagnosis::Where where;
  where.equation = "accelerometer x";
  where.recordings = two;
  where.onset_s = 900.0;
  EXPECT_EQ(report::where_sentence(where),
            "The misfit is in the accelerometer x; it is another from recording 2 (b.csv) on.");
  where.onset_s = 300.0;
  EXPECT_EQ(report::where_sentence(where),
            "The misfit is in the accelerometer x; it sets in at 300 s of a.csv and stays.");
  where.recordings = {{"recording 1", 0.0, 900.0, 0.0}, {"recording 2", 900.0, 3600.0, 900.0}};
  where.onset_s = 900.0;
  EXPECT_EQ(report::where_sentence(where),
            "The misfit is in the accelerometer x; it is another from recording 2 on.");
}

TEST(SeveralRecordingsWords, SayOfAConstantThatItIsAnotherInEach) {
  EXPECT_EQ(report::in_words(diagnosis::remark::FreeInputExplains{"accelerometer x", 105.06, true}),
            "An unknown constant in accelerometer x alone, another one in each recording, would "
            "explain it (twice the log likelihood better by 105.1).");
  EXPECT_EQ(report::in_words(diagnosis::remark::FreeInputExplains{"gimbal outer", 20.0}),
            "An unknown input of free form in gimbal outer alone would explain it (twice the log "
            "likelihood better by 20.0).");
}

TEST(SeveralRecordingsWords, SayOfNoiseWhereItIsNearlyConstantInEach) {
  diagnosis::Diagnosis d;
  d.verdict = diagnosis::Verdict::consistent;
  inference::NoiseFinding f;
  f.component = inference::acc_markov.name;
  f.value = 18.0;
  f.unit = "ug";
  f.factor = std::numeric_limits<double>::quiet_NaN();
  f.significant = true;
  f.tau_s = 3000.0;
  d.noise = {f};
  const std::string words = "slowly wandering accelerometer error",
                    constant = words + " that is nearly constant in each recording";
  const auto says = [&](const std::string& text) {
    return report::sentence(d).find(text) != std::string::npos;
  };
  EXPECT_TRUE(says(words + " (accelerometer_markov: 18 ug)"));
  d.where.recordings = two;  // of 2700 s at most
  EXPECT_TRUE(says(constant + " (accelerometer_markov: 18 ug)")) << report::sentence(d);
  d.noise.front().tau_s = 2000.0;
  EXPECT_FALSE(says(constant));
}

TEST(SeveralRecordingsWords, SayWhichOneLacksWhatATermFollows) {
  diagnosis::NotExamined n{.term = "temperature_drift",
                           .why = diagnosis::NotExamined::Why::no_covariate,
                           .missing = covariate("temperature").set()};
  const auto sentence = [&] { return report::not_examined_sentences({n}, two).front(); };
  EXPECT_EQ(sentence(), "Not examined: temperature_drift: the temperature was not recorded");
  EXPECT_EQ(report::reason_in_words(n, two), "it follows the temperature, which was not recorded");
  n.lacking = {1};
  EXPECT_EQ(sentence(),
            "Not examined: temperature_drift: the temperature was not recorded in b.csv");
  EXPECT_EQ(report::reason_in_words(n, two),
            "it follows the temperature, which was not recorded in b.csv");
  EXPECT_NE(report::followed_text({n}, two).find("which was not recorded in b.csv: record it"),
            std::string::npos);
  n.missing = further_column(0);  // of a [[term]]
  EXPECT_EQ(sentence(),
            "Not examined: temperature_drift: b.csv lacks the covariate that they follow");
  EXPECT_EQ(report::reason_in_words(n, two), "it follows a covariate that is not in b.csv");
}

/// Nothing explains two recordings, and an effect comes near.
diagnosis::Diagnosis near_to(const char* term) {
  diagnosis::Diagnosis d;
  d.verdict = diagnosis::Verdict::unexplained;
  d.nominal.name = "nominal";
  d.where.recordings = two;
  d.nearest_known = {{{term, "", term}}, 86.0, 78.0};
  d.remarks.emplace_back(diagnosis::remark::StrongestLeft{{term}, "gimbal_angle_drift G_s"});
  for (const char* follows : {"temperature_drift", "temperature_g_drift"})
    d.not_examined.push_back({.term = follows, .missing = covariate("temperature").set()});
  return d;
}

TEST(SeveralRecordingsWords, WhatTheyMayNotHaveInCommonIsLookedUpBeforeAnEffectIsAdded) {
  diagnosis::Diagnosis d = near_to("g2_drift");
  const auto next = [&d] { return report::diagnosis_in_brief(d).next; };
  const std::string advice =
      "ore than one effect, or one of another shape, seems to be missing. Diagnose again with the "
      "first in the model: --set \"filter.nominal.terms+=g2_drift\".";
  EXPECT_EQ(next(),
            "Next: look up whether the temperature was the same in all recordings. M" + advice);
  for (auto& n : d.not_examined) n.lacking = {1};
  EXPECT_EQ(next(),
            "Next: give b.csv the temperature, or leave it out, and diagnose again: "
            "temperature_drift and temperature_g_drift were not examined.");
  d.where.recordings.clear();
  EXPECT_EQ(next(), "Next: m" + advice);
}

TEST(SeveralRecordingsWords, AnotherLatitudeMayBeThatOfOneOfThem) {
  diagnosis::Diagnosis d = near_to("latitude_error");
  const auto next = [&d] { return report::diagnosis_in_brief(d).next; };
  EXPECT_EQ(next(),
            "Next: diagnose each recording alone: they may be of several places, and [site] is one "
            "for all of them.");
  d.where.recordings.clear();
  EXPECT_NE(next().find("terms+=latitude_error"), std::string::npos) << next();
}

}  // namespace
}  // namespace drift::several_recordings_words_test
