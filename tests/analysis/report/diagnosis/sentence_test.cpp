#include "analysis/report/diagnosis/words/sentence.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "analysis/inference/noise/noise_component.hpp"
#include "analysis/report/diagnosis/words/remark_words.hpp"
#include "core/base/number_text.hpp"

namespace drift::sentence_test {
namespace {

using namespace diagnosis;
using namespace inference;
using namespace search;

search::Cause cause(const char* term, const char* axis, const char* key, double value, double sigma,
                    const char* unit, int set = 0) {
  search::Cause c;
  c.term = term;
  c.axis = axis;
  c.set = set;
  if (key) c.parameters = {{key, TermLibrary::find(key).value(), value, sigma, unit, false}};
  return c;
}

diagnosis::Diagnosis with(diagnosis::Verdict verdict, std::vector<search::Cause> causes) {
  diagnosis::Diagnosis d;
  d.verdict = verdict;
  d.p_value = 1e-20;
  d.causes = std::move(causes);
  const auto n = static_cast<Eigen::Index>(d.causes.size());
  d.cosines.cosine = MatX::Identity(n, n);
  d.fit.held_out.folds.resize(6);
  d.fit.held_out.improves = true;
  return d;
}

bool says(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

TEST(Sentence, OfANamedCauseStartsWithWordsAndHasTheKeyInBrackets) {
  const auto d = with(diagnosis::Verdict::named,
                      {cause("magnetic_drift", "y", "M_y", 0.011, 0.0004, "deg/h/gauss")});
  EXPECT_EQ(
      report::sentence(d),
      "The nominal model lacks magnetic sensitivity, gyro y (magnetic_drift.y: M_y = 0.0110±0.0004 "
      "deg/h/gauss); with it, held-out positions are predicted better (chance of a false alarm: "
      "1e-20).");
}

TEST(Sentence, SaysASizeThatNobodyExpects) {
  // The library's sigma of M_y is 0.01 deg/h/gauss.
  const auto text = [](double size) {
    return report::sentence(with(diagnosis::Verdict::named, {cause("magnetic_drift", "y", "M_y",
                                                                   size, 0.0004, "deg/h/gauss")}));
  };
  EXPECT_TRUE(says(text(-0.3), "0.3000±0.0004 deg/h/gauss, 30 times its usual size)"))
      << text(-0.3);
  EXPECT_FALSE(says(text(0.049), "usual size")) << text(0.049);
}

TEST(Sentence, SaysWhatAnAxisBelongsTo) {
  EXPECT_EQ(report::in_words("magnetic_drift", "z"), "magnetic sensitivity, gyro z");
  EXPECT_EQ(report::in_words("torquer_scale", "x"), "torquer scale factor error, gyro x");
  EXPECT_EQ(report::in_words("accelerometer_ramp", "x"),
            "accelerometer bias ramp, accelerometer x");
  EXPECT_EQ(report::in_words("stiction", "middle"), "friction of the gimbals, middle gimbal");
  EXPECT_EQ(report::in_words("servo_lag", "y"), "velocity lag of the servo loop, platform axis y");
  EXPECT_EQ(report::in_words("pier_tilt", ""), "daily tilt of the pier");
  EXPECT_EQ(report::in_words("not_a_term", "y"), "not_a_term.y");
}

TEST(Sentence, OfEveryTermStartsWithWords) {
  for (const TermInfo& term : TermLibrary::terms) {
    const std::string text = report::in_words(term.key, "");
    EXPECT_EQ(text.find('_'), std::string::npos) << text;
  }
}

TEST(Sentence, OfTheEquationHasTheIntervalAndNamesWhatElseIsMissing) {
  auto d = with(diagnosis::Verdict::named, {cause("frame_closure", "", "lambda", -0.17, 0.23, "1"),
                                            cause("sag", "x", "C_sag_x", 7.0, 0.5, "arcsec/g")});
  EXPECT_TRUE(report::sentence(d).starts_with(
      "The nominal model has the wrong drift equation (frame_closure: lambda = -0.17±0.23, 95 % "
      "interval -0.62 to 0.28, where eq. (5) is 0 and eq. (6) is 1) and lacks compliance of "
      "the accelerometer block, accelerometer x (sag.x: C_sag_x = 7.0±0.5 arcsec/g); with them,"))
      << report::sentence(d);
}

TEST(Sentence, OfManyNumbersSaysTheLargestInSigmasOfItsPrior) {
  search::Cause c = cause("g_drift", "", "D_I_x", 4.0, 0.1, "deg/h/g");  // 2 prior sigmas
  for (const char* key : {"D_O_x", "D_O_y", "D_S_x"})                    // 0.3, 0.3 and 2 deg/h/g
    c.parameters.push_back({key, TermLibrary::find(key).value(), 1.5, 0.1, "deg/h/g", false});
  EXPECT_EQ(report::in_words(c),
            "g-sensitive drift (mass unbalance; g_drift: D_O_x = 1.50±0.10 deg/h/g and 3 more)");
}

TEST(Sentence, NumbersAlternativesAndKeepsTogetherWhatBelongsTogether) {
  auto d = with(diagnosis::Verdict::ambiguous, {cause("latitude_error", "", nullptr, 0, 0, "", 0),
                                                cause("magnetic_drift", "y", nullptr, 0, 0, "", 0),
                                                cause("drift_ramp", "z", nullptr, 0, 0, "", 1)});
  EXPECT_EQ(report::sentence(d),
            "Something is missing from the nominal model (chance of a false alarm: 1e-20), and "
            "this plan cannot tell "
            "which: either (1) error of the latitude (latitude_error) together with magnetic "
            "sensitivity, gyro y "
            "(magnetic_drift.y), or (2) linear drift ramp, ageing, gyro z (drift_ramp.z).");
}

TEST(Sentence, OfTwinsSaysThatTheyLeaveTheSameTrace) {
  auto d =
      with(diagnosis::Verdict::ambiguous,
           {cause("sag", "x", nullptr, 0, 0, "", 0), cause("drift_ramp", "z", nullptr, 0, 0, "", 1),
            cause("accelerometer_cross", "y", nullptr, 0, 0, "", 2)});
  EXPECT_FALSE(says(report::sentence(d), "same trace")) << report::sentence(d);
  d.cosines.cosine(0, 2) = d.cosines.cosine(2, 0) = -0.9994;  // cosine^2 below 0.999
  EXPECT_FALSE(says(report::sentence(d), "same trace")) << report::sentence(d);
  d.cosines.cosine(0, 2) = d.cosines.cosine(2, 0) = -0.9996;
  EXPECT_TRUE(says(report::sentence(d),
                   "(3) further cross terms of the accelerometers, accelerometer y "
                   "(accelerometer_cross.y). (1) and "
                   "(3) leave the same trace on this plan."))
      << report::sentence(d);
  // Twins as pairs: each cause of the one has its twin, or itself, in the other.
  auto pairs =
      with(diagnosis::Verdict::ambiguous,
           {cause("sag", "x", nullptr, 0, 0, "", 0), cause("drift_ramp", "z", nullptr, 0, 0, "", 0),
            cause("accelerometer_cross", "y", nullptr, 0, 0, "", 1),
            cause("drift_ramp", "z", nullptr, 0, 0, "", 1)});
  pairs.cosines.cosine(0, 2) = pairs.cosines.cosine(2, 0) = 1.0;
  EXPECT_TRUE(says(report::sentence(pairs), "(1) and (2) leave the same trace"))
      << report::sentence(pairs);
  pairs.causes[3].axis = "x";
  EXPECT_FALSE(says(report::sentence(pairs), "leave the same trace")) << report::sentence(pairs);
}

TEST(Sentence, OfANamedCauseSaysWhatElseLeavesItsTrace) {
  auto d = with(diagnosis::Verdict::named, {cause("sag", "x", nullptr, 0, 0, "")});
  d.causes[0].confusable_with = {{"accelerometer_cross", "y", -1.0}, {"drift_ramp", "z", 0.9}};
  EXPECT_TRUE(
      says(report::sentence(d),
           "On this plan compliance of the accelerometer block, accelerometer x (sag.x) and "
           "further cross terms "
           "of the accelerometers, accelerometer y (accelerometer_cross.y) leave the same trace."))
      << report::sentence(d);
  EXPECT_FALSE(says(report::sentence(d), "drift_ramp"));
  d.causes[0].confusable_with[0].cosine = 0.9994;
  EXPECT_FALSE(says(report::sentence(d), "same trace"));
  d.causes[0].confusable_with[0].cosine = 0.9996;
  EXPECT_TRUE(says(report::sentence(d), "same trace"));
  // Said once: not again of all axes of that term, nor of what the verdict names anyway.
  d.causes[0].confusable_with.push_back({"accelerometer_cross", "", 1.0});
  d.causes[0].confusable_with.push_back({"sag", "", 1.0});
  const std::string text = report::sentence(d);
  EXPECT_EQ(text.find("leave the same trace"), text.rfind("leave the same trace")) << text;
}

TEST(Sentence, OfOneCauseThatLeavesSomethingSaysThatAndNotThatItPredicts) {
  auto d = with(diagnosis::Verdict::ambiguous, {cause("drift_ramp", "z", nullptr, 0, 0, "")});
  d.fit.held_out.improves = true;
  d.remarks.emplace_back(diagnosis::remark::JustSignificantLeft{});
  const std::string text = report::sentence(d);
  EXPECT_TRUE(says(text, "but with it something is left that is just significant"));
  EXPECT_FALSE(says(text, "predicted better"));
}

TEST(Sentence, OfOneCauseThatHeldOutDataDoNotSupportIsNotEitherOr) {
  auto d = with(diagnosis::Verdict::ambiguous, {cause("drift_ramp", "z", nullptr, 0, 0, "")});
  d.fit.held_out.improves = false;
  EXPECT_TRUE(says(report::sentence(d),
                   "; it may be linear drift ramp, ageing, gyro z (drift_ramp.z), but with it, "
                   "held-out positions are "
                   "predicted no better."))
      << report::sentence(d);
  d.fit.held_out.folds.clear();
  EXPECT_TRUE(says(report::sentence(d), "but nothing was held out of the fit to judge it."))
      << report::sentence(d);
}

TEST(Sentence, OfTheUnexplainedHasTheShapeAndSaysTheEquationOnce) {
  auto d = with(diagnosis::Verdict::unexplained, {});
  d.where.equation = "gimbal middle";
  EXPECT_EQ(report::sentence(d),
            "Something is missing from the nominal model (chance of a false alarm: 1e-20) and no "
            "known effect explains "
            "it; it sits in the middle gimbal.");
  d.signals.resize(1);
  d.signals[0].equation = "gimbal middle";
  d.signals[0].shape = {diagnosis::Shape::Kind::period, 0.6 * 3600.0};
  d.signals[0].correlation = 0.8;
  EXPECT_TRUE(report::sentence(d).ends_with(
      "it sits in the middle gimbal: swings with a period of about 36 min (correlation 0.80)."))
      << report::sentence(d);
  d.where.equation = "platform rate x";
  EXPECT_TRUE(report::sentence(d).ends_with(
      "it sits in the platform rate x. As an input to the middle gimbal: "
      "swings with a period of about "
      "36 min (correlation 0.80)."))
      << report::sentence(d);
}

TEST(Sentence, OfChanceThatIsSmallSaysWhyItIsTakenForChance) {
  auto d = with(Verdict::consistent, {});
  d.p_value = 5e-4;
  d.probabilities.consistent = 0.6;
  d.probabilities.noise_only = 0.06;
  d.probabilities.named = {{{{"accelerometer_cross", "y", "accelerometer_cross.y K_pp_y"}}, 0.22}};
  EXPECT_TRUE(says(report::sentence(d),
                   "that nothing is missing has the probability 0.66, the likeliest effect "
                   "(accelerometer_cross.y K_pp_y) 0.22"))
      << report::sentence(d);
  d.p_value = 0.3;  // as noise often shows
  EXPECT_FALSE(says(report::sentence(d), "stands out")) << report::sentence(d);
}

TEST(Sentence, SaysTheNoiseInWords) {
  diagnosis::Diagnosis d;
  d.p_value = 0.34;
  d.noise = {{.component = "gimbal_white", .factor = 1.3, .unit = "arcsec", .significant = true},
             {.component = "drift_random_walk",
              .factor = std::nan(""),
              .value = 0.003,
              .unit = "deg/h/sqrt(h)",
              .tau_s = 0.0,
              .significant = true}};
  EXPECT_EQ(
      report::sentence(d),
      "The recording agrees with the nominal model; no missing physics is found (noise alone shows "
      "as much with a "
      "chance of 0.34). The noise is not as declared: white noise of the gimbal readout "
      "(gimbal_white: 1.30 times "
      "as declared) and random walk of the gyro drift (drift_random_walk: 0.003 deg/h/sqrt(h)).");
}

TEST(NumberText, OfAProbabilityIsScientificOnlyBelowAThousandth) {
  EXPECT_EQ(p_text(1.0), "1");
  EXPECT_EQ(p_text(0.0764), "0.076");
  EXPECT_EQ(p_text(0.00123), "0.0012");
  EXPECT_EQ(p_text(4.2e-4), "4e-4");
  EXPECT_EQ(p_text(1e-20), "1e-20");
  EXPECT_EQ(p_text(3e-299), "3e-299");
  EXPECT_EQ(p_text(0.0), "below 1e-300");
  EXPECT_EQ(p_text(std::nan("")), "-");
}

TEST(Sentence, OfPartOfAPlanBeginsWithThat) {
  auto d = with(diagnosis::Verdict::consistent, {});
  d.p_value = 0.3;
  d.remarks.push_back(remark::OtherEquation{Coupling::eq6, -3.0});
  EXPECT_TRUE(says(report::sentence(d), "This plan cannot tell the nominal eq. (6) from eq. (5)."));
  d.absent_positions = {2, 7, 8, 9, 10};
  const std::string text = report::sentence(d);
  EXPECT_EQ(text.find("Of the plan, positions 2, 7 to 10 were not recorded, what follows is of the "
                      "others alone: The recording agrees"),
            0u)
      << text;
  EXPECT_TRUE(says(text, "These positions cannot tell the nominal eq. (6) from eq. (5).")) << text;
  d.absent_positions = {12};
  EXPECT_EQ(report::sentence(d).find("Of the plan, position 12 was not recorded"), 0u);
  d.verdict = diagnosis::Verdict::ambiguous;
  EXPECT_TRUE(says(report::sentence(d), "and these positions cannot tell what."));
}

TEST(Sentence, OfWhatWandersSaysWhatWasNotRecorded) {
  auto d = with(diagnosis::Verdict::consistent, {});
  d.not_examined.push_back({.term = "accelerometer_temperature",
                            .why = diagnosis::NotExamined::Why::no_covariate,
                            .missing = covariate("temperature").set()});
  EXPECT_FALSE(says(report::sentence(d), "temperature"));
  inference::NoiseFinding wandering;
  wandering.component = inference::acc_markov.name;
  wandering.value = 31.0;
  wandering.unit = "ug";
  wandering.factor = std::numeric_limits<double>::quiet_NaN();
  d.noise.push_back(wandering);
  EXPECT_FALSE(says(report::sentence(d), "temperature"));  // no more than chance
  d.noise.back().significant = true;
  EXPECT_TRUE(says(report::sentence(d),
                   "What wanders may follow the temperature, which was not recorded: record it to "
                   "tell it from noise."))
      << report::sentence(d);
  d.noise.back().component = inference::acc_white.name;
  EXPECT_FALSE(says(report::sentence(d), "temperature"));
}

TEST(Sentence, AnEquationThatIsLessLikelyIsNotSaidToDoAsWell) {
  const auto of = [](double gain) {
    return report::in_words(remark::OtherEquation{Coupling::eq6, gain});
  };
  EXPECT_TRUE(says(of(-1.0), "the test is explained as well"));
  // exp(7 / 2) = 33.1
  EXPECT_TRUE(says(of(-7.0), "the odds are 33 to 1 for the nominal one, less than 3 sigma"));
  EXPECT_TRUE(says(of(7.0), "33 to 1 for the other one"));
}

}  // namespace
}  // namespace drift::sentence_test
