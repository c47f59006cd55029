// Profiles and quantiles in the report of a diagnosis, and why candidates are no causes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/diagnosis/sections.hpp"
#include "analysis/report/diagnosis/words/effect_words.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "core/physics/closure.hpp"
#include "core/stats/normal.hpp"
#include "tests/analysis/report/diagnosis/diagnosis_fixture.hpp"
#include "tests/analysis/report/figures_of.hpp"
#include "tests/analysis/report/xml_check.hpp"

namespace drift::profile_figures_test {
namespace {

using namespace report;

diagnosis::Profile profile() {
  diagnosis::Profile p{.label = "g_drift.y", .key = "D_S_y", .unit = "deg/h/g"};
  p.value = p.top = 0.25;
  p.sigma = 0.01;
  for (const double x : {-3.0, -1.5, 0.0, 1.5, 3.0}) p.points.push_back({0.25 + 0.01 * x, x * x});
  p.low_95 = 0.25 - 0.01 * stats::half_width_95;
  p.high_95 = 0.25 + 0.01 * stats::half_width_95;
  return p;
}

TEST(ProfileFigure, SaysBothIntervalsAndWhetherTheyAgree) {
  diagnosis::Diagnosis d;
  EXPECT_TRUE(profiles(d).blocks.empty());
  d.profiles = {profile(), profile()};
  d.profiles[1].high_95 = std::nan("");
  const Section section = profiles(d);
  const auto figures = test::figures_of({section});
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_FALSE(test::xml_problem(figures[0].svg, {}));
  const auto& said = std::get<Sentences>(section.blocks[1].content).items;
  EXPECT_EQ(said[0],
            "g_drift.y D_S_y: 0.230 to 0.270 deg/h/g by refits, 0.230 to 0.270 by its sigma: they "
            "agree.");
  EXPECT_NE(said[1].find("beyond the refits"), std::string::npos);
  EXPECT_NE(said[1].find("take the interval by refits"), std::string::npos);
  const Json json = profiles_json(d.profiles);
  EXPECT_EQ(json[0]["refits"].size(), 5u);
  EXPECT_DOUBLE_EQ(json[0]["refits"][1]["loss"], 2.25);
  EXPECT_DOUBLE_EQ(json[0]["interval_95"][0], 0.25 - 0.01 * stats::half_width_95);
}

TEST(Intervals, OfTheSentenceAndOfTheJsonAreOne) {
  diagnosis::Diagnosis d;
  d.verdict = diagnosis::Verdict::named;
  search::Cause cause;
  cause.term = "frame_closure";
  search::CauseParameter lambda;
  lambda.key = "lambda";
  lambda.param = closure_param;
  lambda.unit = "1";
  lambda.value = 0.2;
  lambda.sigma = 0.05;
  cause.parameters.push_back(lambda);
  d.causes.push_back(cause);
  const auto expect = [&](double low, double high, const std::string& text) {
    EXPECT_NE(sentence(d).find(text), std::string::npos) << sentence(d);
    const Json json = Json::parse(to_json(d))["causes"][0]["parameters"][0]["interval_95"];
    EXPECT_DOUBLE_EQ(json[0], low);
    EXPECT_DOUBLE_EQ(json[1], high);
  };
  const double half = 0.05 * stats::half_width_95;
  search::CauseParameter& told = d.causes.front().parameters.front();
  told.low_95 = 0.126;  // by refits, which did not go far enough above: ends of one kind alone
  expect(0.2 - half, 0.2 + half, "lambda = 0.20±0.05, 95 % interval 0.10 to 0.30, where");
  told.high_95 = 0.31;
  expect(0.126, 0.31, "lambda = 0.20, 95 % interval 0.13 to 0.31, where");
}

TEST(Intervals, OfLambdaNoEndReadsAsAnEquationThatItIsNot) {
  const auto said = [](double value, double sigma, double low, double high, double top) {
    search::Cause cause;
    cause.term = "frame_closure";
    cause.parameters = {{"lambda", closure_param, value, sigma, "1"}};
    search::CauseParameter& p = cause.parameters[0];
    p.low_95 = low;
    p.high_95 = high;
    p.top = top;
    return lacking({cause});
  };
  const auto expect = [](const std::string& text, std::string_view part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect(said(0.93966, 0.033716, 0.870265, 1.0000385, 0.93319),
         "lambda = 0.940±0.034, 95 % interval 0.870 to 1.00004, where eq. (5) is 0");
  expect(said(1.002, 0.006, 0.991, 1.014, 1.002),
         "lambda = 1.002±0.006, 95 % interval 0.991 to 1.014, where");
  // Of a sigma whose lower end lies outside the interval nothing is said.
  expect(said(-0.16893, 0.22962, -0.366868, 0.235982, -0.034094),
         "lambda = -0.03, 95 % interval -0.37 to 0.24, where");
  EXPECT_EQ(lambda_in_words(1.0, 0.034), "1.000");
  EXPECT_EQ(lambda_in_words(0.99996, 0.034), "0.99996");
  EXPECT_EQ(lambda_in_words(-0.0004, 0.05), "-0.0004");
  EXPECT_EQ(lambda_in_words(1.0 + 1e-13, 0.05), "1.00");
  EXPECT_EQ(lambda_in_words(12.3, 5.0), "12");
}

TEST(Intervals, ASizeHasItsIntervalWhereItsSigmaSaysAnother) {
  diagnosis::Diagnosis d;
  d.verdict = diagnosis::Verdict::named;
  search::Cause cause;
  cause.term = "warmup_drift";
  cause.axis = "x";
  cause.parameters.push_back({"W_x", TermLibrary::index("W_x"), 0.056, 0.011, "deg/h"});
  d.causes.push_back(cause);
  search::CauseParameter& told = d.causes.front().parameters.front();
  const auto expect = [&](double low, double high, const std::string& text) {
    told.low_95 = low;
    told.high_95 = high;
    EXPECT_NE(sentence(d).find(text), std::string::npos) << sentence(d);
  };
  const double none = std::nan("");
  expect(none, none, "W_x = 0.056±0.011 deg/h");
  expect(0.035, 0.078, "W_x = 0.056±0.011 deg/h");
  expect(0.037, 0.218, "W_x = 0.056 (95 %: 0.037 to 0.218) deg/h");
  expect(0.037, none, "W_x = 0.056 (95 %: at least 0.037) deg/h");
  expect(none, 0.218, "W_x = 0.06 (95 %: at most 0.22) deg/h");
  told.value = 4.26;
  expect(4.252, 4.2701, "W_x = 4.260 (95 %: 4.252 to 4.270) deg/h");
}

/// A size whose profile is skew, and a setting beside it.
diagnosis::Diagnosis skew() {
  diagnosis::Diagnosis d;
  d.verdict = diagnosis::Verdict::named;
  search::Cause cause;
  cause.term = "warmup_drift";
  cause.axis = "x";
  cause.parameters = {{"W_x", TermLibrary::index("W_x"), 0.056, 0.011, "deg/h"},
                      {"W_tau", TermLibrary::index("W_tau"), 40.0, 0.7, "min", true}};
  cause.parameters[0].low_95 = 0.037;
  cause.parameters[0].high_95 = 0.218;
  cause.parameters[0].top = 0.08;
  d.causes.push_back(cause);
  return d;
}

TEST(Intervals, OfTheSentenceTheTableAndTheFigureAreOneWithTheMostProbableValue) {
  diagnosis::Diagnosis d = skew();
  constexpr const char* told = "0.080 (95 %: 0.037 to 0.218)";
  EXPECT_NE(sentence(d).find(told), std::string::npos) << sentence(d);
  const std::string table = text_of({what(d)});
  EXPECT_NE(table.find(told), std::string::npos) << table;
  const Blocks figure = cause_figure(d);
  const std::string& svg = std::get<Figure>(figure.at(0).content).svg;
  EXPECT_NE(svg.find(told), std::string::npos) << svg;
  EXPECT_NE(svg.find(">3.0<"), std::string::npos) << svg;  // sigmas; the interval reaches 3.1
  EXPECT_EQ(svg.find(">10<"), std::string::npos) << svg;
  const Json json = Json::parse(to_json(d))["causes"][0]["parameters"];
  EXPECT_EQ(json[0]["value"], 0.08);
  EXPECT_EQ(json[0]["top"], 0.08);
  EXPECT_NEAR(json[0]["sigma"].get<double>(), (0.218 - 0.08) / stats::half_width_95, 1e-12);
  EXPECT_EQ(json[1]["value"], 40.0);
  EXPECT_EQ(json[1]["sigma"], 0.7);
  EXPECT_TRUE(json[1]["top"].is_null());
  // Where the sigma says as much, and where the top lies outside: the value.
  search::CauseParameter& size = d.causes[0].parameters[0];
  EXPECT_EQ(size.told(), 0.08);
  size.top = 0.3;
  EXPECT_EQ(size.told(), 0.056);
  size.top = 0.06;
  size.low_95 = 0.035;
  size.high_95 = 0.078;
  EXPECT_EQ(size.told(), 0.056);
  EXPECT_EQ(size.told_sigma(), 0.011);
}

/// Of a time constant of which refits found one end, beyond the library's grid, which had held it.
TEST(Intervals, ASettingBeyondItsGridHasOneValueInWordsAndInTheJson) {
  diagnosis::Diagnosis d = skew();
  search::CauseParameter& setting = d.causes[0].parameters[1];
  setting.value = 42.6;
  setting.sigma = 18.6;
  setting.top = 3650.0;
  setting.low_95 = 39.4;
  setting.without_grid = true;
  EXPECT_NE(sentence(d).find("W_tau = 3650 (95 %: at least 39) min"), std::string::npos)
      << sentence(d);
  const Json json = Json::parse(to_json(d))["causes"][0]["parameters"][1];
  EXPECT_EQ(json["value"], 3650.0);
  EXPECT_NEAR(json["sigma"].get<double>(), (3650.0 - 39.4) / stats::half_width_95, 1e-9);
  EXPECT_EQ(json["interval_95"], (Json{39.4, nullptr}));
}

TEST(CauseFigure, LeavesSettingsOutAndSaysSo) {
  diagnosis::Diagnosis d = skew();
  Blocks figure = cause_figure(d);
  EXPECT_EQ(std::get<Figure>(figure.at(0).content).svg.find("W_tau"), std::string::npos);
  EXPECT_NE(std::get<Figure>(figure[0].content).caption.find("Settings"), std::string::npos);
  d.causes[0].parameters.pop_back();
  figure = cause_figure(d);
  EXPECT_EQ(std::get<Figure>(figure.at(0).content).caption.find("Settings"), std::string::npos);
}

TEST(Causes, ASizeSaysWhatElseOfTheEffectItTakesAsZero) {
  const test::ScratchFolder folder;
  const mc::Study study = test::read_text(folder, "study.toml", test::nominal_study);
  diagnosis::Diagnosis d = test::diagnosis(study.filters.front());
  const auto said = [&d] {
    std::string all;
    for (const Block& b : what(d).blocks)
      if (const auto* sentences = std::get_if<Sentences>(&b.content))
        for (const std::string& item : sentences->items) all += item + "\n";
    return all;
  };
  EXPECT_NE(said().find("its size is that with D_I_y and D_O_y at zero"), std::string::npos)
      << said();
  for (const char* key : {"D_I_y", "D_O_y"}) d.nominal.active.set(TermLibrary::find(key).value());
  EXPECT_EQ(said().find("at zero"), std::string::npos) << said();
}

TEST(NormalQuantiles, OfNumbersThatAreQuantilesLieOnTheLine) {
  MatX residual(1, 1001);
  for (Eigen::Index i = 0; i < 1000; ++i)  // in no order
    residual(0, i) = stats::normal_quantile((static_cast<double>((7 * i) % 1000) + 0.5) / 1000.0);
  residual(0, 1000) = std::nan("");
  const auto all = normal_quantiles(residual, 0);
  EXPECT_GT(all.size(), 100u);
  EXPECT_LE(all.size(), 150u);
  for (const auto& [normal, found] : all) EXPECT_NEAR(normal, found, 1e-9);
  EXPECT_NEAR(all.front().second, -all.back().second, 1e-9);  // both ends are there
  EXPECT_NEAR(all.back().first, stats::normal_quantile(0.9995), 1e-9);
}

TEST(Candidates, SayWhyTheyAreNoCauses) {
  const test::ScratchFolder folder;
  const mc::Study study = test::read_text(folder, "study.toml", test::nominal_study);
  diagnosis::Diagnosis d = test::diagnosis(study.filters.front());
  search::CandidateScore c = d.candidates[0];
  d.candidates[0].log_bayes = 12.0;
  const auto why = [&](search::CandidateScore other) {
    d.candidates[1] = other;
    d.candidates[1].label = d.candidates[1].term = "other";
    const Table table = candidate_table(d);
    return table.rows[1].cells.back().text;
  };
  c.leaves_nothing = true;
  c.log_bayes = 10.0;
  EXPECT_EQ(why(c), "less likely by a factor of 7.4");  // exp(2)
  c.leaves_nothing = false;
  EXPECT_EQ(why(c), "with it, others stay significant");
  c.size_sigma = 12.0;
  EXPECT_EQ(why(c), "would be 12 times its usual size");
  c.p_value = 0.2;
  EXPECT_EQ(why(c), "no stronger than chance");
  c.observable = false;
  EXPECT_EQ(why(c), "not observable on this plan");
  EXPECT_EQ(candidate_table(d).rows[0].cells.back().text, "named");
}

}  // namespace
}  // namespace drift::profile_figures_test
