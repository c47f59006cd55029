// What is said of gyros on a case, and of numbers that say nothing.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "analysis/diagnosis/asides.hpp"
#include "analysis/report/diagnosis/sections.hpp"
#include "analysis/report/diagnosis/words/effect_words.hpp"
#include "analysis/report/diagnosis/words/remark_words.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"

namespace drift::case_words_test {
namespace {

using diagnosis::Diagnosis, diagnosis::Verdict;
using report::Instrument;

bool says(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

Diagnosis of_case(const char* term, const char* axis, const char* key) {
  Diagnosis d;
  d.of_case = true;
  d.verdict = Verdict::named;
  d.p_value = 1e-20;
  search::Cause c;
  c.term = term;
  c.axis = axis;
  c.parameters = {{key, TermLibrary::find(key).value(), 40.0, 2.0, "ppm", false}};
  d.causes = {c};
  search::CandidateScore score;
  score.term = term;
  score.axis = axis;
  score.label = search::keyed(term, axis);
  d.candidates = {score};
  return d;
}

TEST(CaseWords, AStrapdownUnitHasAScaleFactorAndNoTorquer) {
  for (const char* key :
       {"torquer_scale", "torquer_asymmetry", "torquer_nonlinearity", "torquer_temperature"}) {
    EXPECT_FALSE(says(report::in_words(key, "x", Instrument::on_case), "torquer")) << key;
    EXPECT_TRUE(says(report::in_words(key, "x", Instrument::on_case), "of the gyros, gyro x"));
    EXPECT_TRUE(says(report::in_words(key, "x"), "torquer")) << key;
  }
  const Diagnosis d = of_case("torquer_asymmetry", "y", "s_a_y");
  EXPECT_TRUE(says(report::sentence(d),
                   "lacks scale factor asymmetry of the gyros, gyro y (torquer_asymmetry.y: "))
      << report::sentence(d);
  const std::string what = report::text_of({report::what(d), report::rivals(d)});
  EXPECT_TRUE(says(what, "scale factor asymmetry of the gyros (torquer_asymmetry.y)")) << what;
  const TermInfo& term = TermLibrary::terms[*TermLibrary::find_term("torquer_asymmetry")];
  EXPECT_TRUE(says(std::string(report::equation_of(term, Instrument::on_case)), "reading"));
  EXPECT_EQ(report::equation_of(term, Instrument::platform), term.equation);
}

/// A direction of a wide cause may look like another effect; the cause does not.
TEST(CaseWords, ACauseOfManySizesIsATwinOnlyWhereAllOfItIs) {
  Diagnosis d = of_case("accelerometer", "", "K2_x");
  d.causes[0].parameters.push_back(
      {"K2_y", TermLibrary::find("K2_y").value(), 10.0, 2.0, "ug/g^2", false});
  d.causes[0].confusable_with = {{"accelerometer_cross", "z", 1.0}};
  EXPECT_FALSE(says(report::sentence(d), "same trace")) << report::sentence(d);
  d.inseparable = {{{"accelerometer", "", ""}, {"accelerometer_cross", "z", ""}}};
  EXPECT_TRUE(says(report::sentence(d), "same trace")) << report::sentence(d);
}

/// Three drifts of which the test does not see the common part; a misalignment beside them.
Diagnosis less_mean() {
  Diagnosis d = of_case("gyro_misalignment", "", "xi_y");
  search::Cause drift;
  drift.term = "g_drift";
  for (const char* key : {"D_I_x", "D_I_y", "D_I_z"}) {
    drift.parameters.push_back(
        {key, TermLibrary::find(key).value(), 150.0, 10.0, "deg/h/g", false});
    drift.parameters.back().less_mean = true;
  }
  d.causes.push_back(drift);
  return d;
}

TEST(LessTheMean, IsSaidWhereverSuchANumberStands) {
  Diagnosis d = less_mean();
  EXPECT_TRUE(says(report::sentence(d),
                   "D_I_x = 150±10 deg/h/g, 75 times its usual size, D_I_y = 150±10 deg/h/g, 75 "
                   "times its usual size, D_I_z = 150±10 deg/h/g, 75 times its usual size, each "
                   "less the mean of the three)"))
      << report::sentence(d);
  const std::string table = report::text_of({report::what(d)});
  for (const char* text : {"D_I_x* ", "D_I_z* ", "*: less the mean of the three.", "xi_y  "})
    EXPECT_TRUE(says(table, text)) << text << table;
  const auto figures = report::cause_figure(d);
  EXPECT_TRUE(says(std::get<report::Figure>(figures.at(0).content).svg,
                   "150±10 deg/h/g, less the mean of the three"));
  const report::Json causes = report::Json::parse(report::to_json(d))["causes"];
  EXPECT_TRUE(causes[0]["parameters"][0]["note"].is_null());
  EXPECT_EQ(causes[1]["parameters"][2]["note"], "less the mean of the three");
  // By itself, and the largest of many.
  search::Cause& drift = d.causes[1];
  drift.parameters.resize(1);
  EXPECT_TRUE(says(report::in_words(drift), "D_I_x = 150±10 deg/h/g less the mean of the three"))
      << report::in_words(drift);
  for (const char* key : {"D_O_x", "D_O_y", "D_O_z"})
    drift.parameters.push_back({key, TermLibrary::find(key).value(), 0.1, 0.1, "deg/h/g", false});
  EXPECT_TRUE(says(report::in_words(drift), "150±10 deg/h/g less the mean of the three"))
      << report::in_words(drift);
  EXPECT_TRUE(says(report::in_words(drift), " and 3 more")) << report::in_words(drift);
}

TEST(LessTheMean, IsNotSaidOfANumberThatIsWhole) {
  Diagnosis d = less_mean();
  for (search::CauseParameter& p : d.causes[1].parameters) p.less_mean = false;
  EXPECT_FALSE(says(report::to_text(d) + report::to_json(d), "less the mean"));
}

TEST(LessTheMean, IsSaidOfAProfile) {
  Diagnosis d;
  diagnosis::Profile p{.label = "g_drift", .key = "D_I_x", .unit = "deg/h/g"};
  p.value = p.top = 150.0;
  p.sigma = 10.0;
  for (const double x : {-3.0, -1.5, 0.0, 1.5, 3.0}) p.points.push_back({150.0 + 10.0 * x, x * x});
  p.low_95 = 130.4;
  p.high_95 = 169.6;
  p.less_mean = true;
  d.profiles = {p};
  const report::Section section = report::profiles(d);
  EXPECT_TRUE(says(std::get<report::Figure>(section.blocks[0].content).svg,
                   "D_I_x less the mean of the three [deg/h/g]"));
  EXPECT_TRUE(says(std::get<report::Sentences>(section.blocks[1].content).items[0],
                   "D_I_x, less the mean of the three: 130 to 170 deg/h/g by refits"));
}

/// A candidate that leaves nothing, were it so many times its usual size.
search::CandidateScore explaining(const char* term, const char* axis, const char* label,
                                  double size_sigma) {
  search::CandidateScore c;
  c.term = term;
  c.axis = axis;
  c.label = label;
  c.p_value = 1e-20;
  c.size_sigma = size_sigma;
  c.leaves_nothing = true;
  return c;
}

TEST(TooLarge, ACandidateThatLosesByItsSizeAloneIsNamedWithIt) {
  Diagnosis d = of_case("magnetic_drift", "y", "M_y");
  d.of_case = false;
  d.candidates.push_back(explaining("base_motion_leak", "y", "base_motion_leak.y", 11.5));
  EXPECT_TRUE(says(report::sentence(d), "loses by its size alone: ")) << report::sentence(d);
  EXPECT_TRUE(says(report::sentence(d), "base_motion_leak.y (12 times its usual size)."))
      << report::sentence(d);
  for (const auto change : {+[](search::CandidateScore& c) { c.leaves_nothing = false; },
                            +[](search::CandidateScore& c) { c.size_sigma = 4.0; },
                            +[](search::CandidateScore& c) { c.p_value = 0.3; },
                            +[](search::CandidateScore& c) { c.term = "magnetic_drift"; }}) {
    Diagnosis other = d;
    change(other.candidates.back());
    EXPECT_FALSE(says(report::sentence(other), "size alone")) << report::sentence(other);
  }
}

TEST(TooLarge, WhatIsUnknownMayBeAnEffectOfASizeThatNobodyExpects) {
  Diagnosis d = of_case("magnetic_drift", "y", "M_y");
  d.of_case = false;
  d.verdict = Verdict::unexplained;
  d.causes.clear();
  EXPECT_TRUE(says(report::sentence(d), "no known effect explains it")) << report::sentence(d);
  d.probabilities.outside = 0.979;
  d.probabilities.named = {
      {{{"mass_unbalance_step", "y", "mass_unbalance_step.y"}}, 0.018},
  };
  d.candidates.push_back(explaining("magnetic_drift", "y", "magnetic_drift.y", 30.0));
  const std::string text = report::sentence(d);
  EXPECT_TRUE(says(text,
                   "is more probable (0.979) than the likeliest known effect (0.018), step of "
                   "the mass unbalance, gyro y (mass_unbalance_step.y)"))
      << text;
  EXPECT_TRUE(says(text,
                   "What would explain it, but loses by its size alone: magnetic_drift.y (30 times "
                   "its usual size)."))
      << text;
}

TEST(TooLarge, AnotherParameterOfTheTermThatIsNamedIsAnotherEffect) {
  Diagnosis d = of_case("encoder_harmonics", "middle", "enc_s2_middle");
  d.of_case = false;
  d.candidates.push_back(
      explaining("encoder_harmonics", "middle", "encoder_harmonics.middle enc_s1_middle", 6.1));
  EXPECT_TRUE(says(report::sentence(d), "encoder_harmonics.middle enc_s1_middle (6.1 times"))
      << report::sentence(d);
  d.candidates.back().label = "encoder_harmonics.middle enc_s2_middle";
  EXPECT_FALSE(says(report::sentence(d), "size alone")) << report::sentence(d);
}

TEST(TooLarge, IsSaidBeforePairsThatLeaveTheSameTrace) {
  Diagnosis d = of_case("magnetic_drift", "y", "M_y");
  d.of_case = false;
  d.causes[0].confusable_with = {{"base_motion_leak", "y", 1.0}};
  d.candidates.push_back(explaining("torquer_asymmetry", "", "torquer_asymmetry", 11.5));
  const std::string text = report::sentence(d);
  ASSERT_TRUE(says(text, "same trace")) << text;
  EXPECT_LT(text.find("loses by its size alone"), text.find("same trace")) << text;
}

/// 4.9 of its usual sizes cost it e^12, and it is less likely than what is named by e^6.6 only.
TEST(TooLarge, ACandidateThatItsSizeMakesLessLikelyIsNamedWithTheCause) {
  Diagnosis d = of_case("gimbal_angle_drift", "y", "G_c_y");
  d.of_case = false;
  search::CandidateScore named;
  named.term = "gimbal_angle_drift";
  named.log_bayes = 120.0;
  search::CandidateScore torquer =
      explaining("torquer_asymmetry", "y", "torquer_asymmetry.y", 4.86);
  torquer.log_bayes = 113.4;
  d.candidates = {named, torquer};
  EXPECT_TRUE(says(report::sentence(d), "torquer_asymmetry.y (4.9 times its usual size)."))
      << report::sentence(d);
  d.candidates[1].log_bayes = 105.0;  // less likely whatever its size
  EXPECT_FALSE(says(report::sentence(d), "size alone")) << report::sentence(d);
  d.candidates[1].log_bayes = 119.0;
  d.candidates[1].size_sigma = 2.9;  // no size to speak of
  EXPECT_FALSE(says(report::sentence(d), "size alone")) << report::sentence(d);
}

TEST(CaseWords, AChanceNearOneIsNoNumber) {
  Diagnosis d;
  d.p_value = 1.0;
  EXPECT_TRUE(says(report::sentence(d), "(noise alone nearly always shows as much)"))
      << report::sentence(d);
  d.p_value = 0.98;
  EXPECT_TRUE(says(report::sentence(d), "with a chance of 0.98"));
}

TEST(CaseWords, InnovationsThatACauseLeavesColouredAreSaid) {
  diagnosis::Whiteness w;
  w.ljung_box_p_before = 0.66;
  w.ljung_box_p_after = 0.0125;
  const auto remark = diagnosis::left_not_white(w);
  ASSERT_TRUE(remark);
  const std::string words = report::in_words(*remark);
  EXPECT_TRUE(says(words, "p 0.013")) << words;
  EXPECT_TRUE(says(words, "without it 0.66")) << words;
  EXPECT_TRUE(says(words, "takes the place of another")) << words;
  w.ljung_box_p_after = 0.06;
  EXPECT_FALSE(diagnosis::left_not_white(w));
}

}  // namespace
}  // namespace drift::case_words_test
