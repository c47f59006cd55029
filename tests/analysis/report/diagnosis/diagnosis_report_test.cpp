#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "analysis/report/diagnosis/sections.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "analysis/report/svg/svg_chart.hpp"
#include "tests/analysis/report/diagnosis/diagnosis_fixture.hpp"
#include "tests/analysis/report/figures_of.hpp"
#include "tests/analysis/report/own_script.hpp"
#include "tests/analysis/report/xml_check.hpp"

namespace drift::diagnosis_report_test {
namespace {

using namespace diagnosis;
using namespace inference;
using namespace search;
using nlohmann::json;
using test::nominal;
using test::nominal_study;

const std::set<std::string> void_tags{"meta", "br", "img", "link", "hr"};

std::vector<report::Figure> all_figures(const diagnosis::Diagnosis& d) {
  return test::figures_of(report::sections_of(d, report::diagnosis_sections));
}

TEST(DiagnosisJson, HasEveryKeyOfTheInterfaceWithTheTypeThatStandsThere) {
  const json j = json::parse(report::to_json(test::diagnosis(nominal())));
  EXPECT_EQ(j["schema"], 1);
  EXPECT_EQ(j["verdict"], "named");
  EXPECT_EQ(j["p_value"], 1e-30);
  EXPECT_EQ(j["where"]["channels"][0],
            (json{{"name", "acc_y"}, {"share", 0.7}, {"sigma", 0.1}, {"chi2_per_dof", 1.0}}));
  EXPECT_EQ(j["where"]["positions"][0]["position"], 3);
  EXPECT_EQ(j["where"]["windows"][0]["start_s"], 1200.0);
  EXPECT_EQ(j["where"]["windows"][0]["end_s"], 1800.0);
  EXPECT_EQ(j["where"]["equation"], "platform rate y");
  const json& cause = j["causes"][0];
  EXPECT_EQ(cause["term"], "g_drift");
  EXPECT_EQ(cause["axis"], "y");
  EXPECT_EQ(cause["probability"], 0.97);
  EXPECT_EQ(cause["parameters"][0]["key"], "D_S_y");
  EXPECT_EQ(cause["parameters"][0]["value"], 0.25);
  EXPECT_EQ(cause["parameters"][0]["sigma"], 0.01);
  EXPECT_EQ(cause["parameters"][0]["unit"], "deg/h/g");
  EXPECT_EQ(cause["confusable_with"][0]["cosine"], 0.85);
  for (const char* key : {"term", "score", "p_value", "absorbed"})
    EXPECT_TRUE(j["candidates"][0].contains(key)) << key;
  EXPECT_EQ(j["fit"]["in_sample"]["chi2_per_dof_before"], 1.02);
  EXPECT_EQ(j["fit"]["in_sample"]["chi2_per_dof_after"], 1.0);
  EXPECT_EQ(j["fit"]["held_out"]["log_score_gain"], 812.0);
  EXPECT_EQ(j["fit"]["held_out"]["folds"], 6);
  EXPECT_EQ(j["fit"]["start_spread_before"], 10.6);
  EXPECT_EQ(j["fit"]["shifted_parameters"][0]["before"], 268.0);
  EXPECT_EQ(j["fit"]["shifted_parameters"][0]["sigma_after"], 5.0);
  EXPECT_EQ(j["advice"][0]["plan"]["position"][0]["axes"], "x=U y=N z=W");
  EXPECT_EQ(j["advice"][0]["separates"], (json{"g_drift.y", "g_drift.z"}));
  EXPECT_EQ(j["advice"][0]["expected_sigma"], 6.2);
  EXPECT_EQ(j["noise"][0]["component"], "gimbal_white");
  EXPECT_EQ(j["noise"][0]["factor"], 1.3);
  EXPECT_EQ(j["noise"][0]["factor_sigma"], 0.02);
  EXPECT_EQ(j["noise"][0]["value"], 6.5);
  EXPECT_EQ(j["noise"][0]["unit"], "arcsec");
  EXPECT_EQ(j["noise"][0]["p_value"], 1.0);
  EXPECT_EQ(j["noise"][0]["significant"], true);
  EXPECT_EQ(j["model"], "patched.toml");
}

TEST(DiagnosisJson, WhatIsNoNumberIsNull) {
  const json j = json::parse(report::to_json(test::diagnosis(nominal())));
  EXPECT_TRUE(j["candidates"][1]["score"].is_null());
  EXPECT_TRUE(j["causes"][0]["size_sigma"].is_null());
  EXPECT_TRUE(j["fit"]["start_spread_after"].is_null());
  EXPECT_TRUE(j["advice"][0]["verified_sigma"].is_null());
  const json empty = json::parse(report::to_json(diagnosis::Diagnosis{}));
  EXPECT_EQ(empty["verdict"], "consistent");
  EXPECT_TRUE(empty["model"].is_null());
  EXPECT_TRUE(empty["causes"].is_array() && empty["causes"].empty());
}

TEST(DiagnosisJson, WhatWasNotComputedIsNullAndNotZero) {
  diagnosis::Diagnosis d = test::diagnosis(nominal());
  d.fit.band_low = 0.9;
  d.fit.band_high = 1.1;
  d.fit.log_likelihood_ratio = 140.0;
  d.fit.linear_T = 144.0;
  d.where.scan_p_value = 1e-9;
  d.where.windows_tried = 300;
  json j = json::parse(report::to_json(d));
  EXPECT_EQ(j["fit"]["in_sample"]["chi2_per_dof_95"], (json{0.9, 1.1}));
  EXPECT_EQ(j["fit"]["in_sample"]["log_likelihood_ratio"], 140.0);
  EXPECT_EQ(j["fit"]["in_sample"]["predicted_by_score"], 144.0);
  EXPECT_EQ(j["fit"]["in_sample"]["sign_agrees"], true);
  EXPECT_EQ(j["where"]["p_value"], 1e-9);
  EXPECT_EQ(j["where"]["windows_tried"], 300);
  // No cause in the model, nothing held out: no second fit, no gain.
  d.has_patch = false;
  d.fit.held_out = {};
  j = json::parse(report::to_json(d));
  for (const char* key : {"log_likelihood_ratio", "predicted_by_score", "sign_agrees"})
    EXPECT_TRUE(j["fit"]["in_sample"].at(key).is_null()) << key;
  for (const char* key :
       {"log_score_gain", "log_score_gain_sigma", "nested_gain", "chi2_per_dof_before"})
    EXPECT_TRUE(j["fit"]["held_out"].at(key).is_null()) << key;
  // A recording on a case: no declared noise, no scan.
  d.has_patch = true;
  d.fit.band_low = d.fit.band_high = d.fit.log_likelihood_ratio = d.where.scan_p_value =
      std::nan("");
  j = json::parse(report::to_json(d));
  for (const char* key : {"chi2_per_dof_95", "log_likelihood_ratio", "sign_agrees"})
    EXPECT_TRUE(j["fit"]["in_sample"].at(key).is_null()) << key;
  for (const char* key : {"p_value", "windows_tried"})
    EXPECT_TRUE(j["where"].at(key).is_null()) << key;
}

TEST(DiagnosisPage, IsWellFormedOfflineAndEscaped) {
  const test::ScratchFolder folder;
  const mc::Study study = test::read_text(folder, "s.toml", nominal_study);
  const diagnosis::Diagnosis d = test::diagnosis(study.filters.front());
  const std::string page =
      report::to_html(report::diagnosis_report(study, d, {{"rec <1>.csv"}, "details <&>", {}}));
  EXPECT_EQ(test::xml_problem(page, void_tags), std::nullopt);
  EXPECT_EQ(test::without_own_script(page).find("://"), std::string::npos);
  EXPECT_EQ(test::without_own_script(page).find("<script"), std::string::npos);
  for (const char* text :
       {"six &amp; &lt;positions&gt;", "rec &lt;1&gt;.csv", "a &lt;remark&gt; &amp; more",
        "g_drift D_S_y &lt;&amp;&gt;", "[[plan.position]]"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  const auto figures = all_figures(d);
  EXPECT_EQ(figures.size(), 10u);
  for (const report::Figure& f : figures)
    EXPECT_EQ(test::xml_problem(f.svg), std::nullopt) << f.file;
}

TEST(DiagnosisPage, HoldsOfAnyVerdictAndOfNothing) {
  const test::ScratchFolder folder;
  const mc::Study study = test::read_text(folder, "s.toml", nominal_study);
  for (const diagnosis::Verdict v :
       {diagnosis::Verdict::consistent, diagnosis::Verdict::named, diagnosis::Verdict::ambiguous,
        diagnosis::Verdict::unexplained})
    for (diagnosis::Diagnosis d :
         {diagnosis::Diagnosis{}, test::diagnosis(study.filters.front())}) {
      d.verdict = v;
      const std::string page = report::to_html(report::diagnosis_report(study, d, {}));
      EXPECT_EQ(test::xml_problem(page, void_tags), std::nullopt) << diagnosis::text(v);
      EXPECT_FALSE(report::to_text(d).empty());
    }
}

TEST(DiagnosisFigures, TheLocatedWindowAndTheGapOfTheRecoveredSignalAreSeen) {
  const auto figures = all_figures(test::diagnosis(nominal()));
  const auto signal = std::find_if(figures.begin(), figures.end(),
                                   [](const report::Figure& f) { return f.file == "signal.svg"; });
  ASSERT_NE(signal, figures.end());
  EXPECT_NE(signal->svg.find("located window"), std::string::npos);
  EXPECT_NE(signal->svg.find("signature of the cause"), std::string::npos);
  const auto residuals = std::ranges::find(figures, "residuals.svg", &report::Figure::file);
  ASSERT_NE(residuals, figures.end());
  for (const report::Shade shade : {report::Shade::expected, report::Shade::located})
    EXPECT_NE(residuals->svg.find(report::fill_of(shade)), std::string::npos);
}

TEST(DiagnosisFigures, TheSignatureOfACauseIsSpokenOfWhereOneIsDrawn) {
  diagnosis::Diagnosis d = test::diagnosis(nominal());
  const auto caption = [&] {
    for (const report::Figure& f : all_figures(d))
      if (f.file == "signal.svg") return f.caption;
    return std::string();
  };
  EXPECT_NE(caption().find("The signature of the cause is"), std::string::npos) << caption();
  for (diagnosis::RecoveredSignal& s : d.signals) s.explained.clear();
  EXPECT_NE(caption().find("The input that would explain"), std::string::npos) << caption();
  EXPECT_EQ(caption().find("signature"), std::string::npos) << caption();
}

TEST(DiagnosisPage, SaysThePriorOfWhatTheRecordingMayBe) {
  diagnosis::Diagnosis d = test::diagnosis(nominal());
  d.probabilities.consistent = 0.75;
  d.probabilities.outside = 0.25;
  const std::string said = report::text_of({report::odds(d)}, 400);
  EXPECT_NE(said.find("nothing missing 0.5, an effect of the library 0.45, something else 0.05"),
            std::string::npos)
      << said;
}

/// Two that cancel were found as a pair, beside a single alternative: each of the pair looks weak
/// alone.
diagnosis::Diagnosis cancelling_pair() {
  diagnosis::Diagnosis d = test::diagnosis(nominal());
  d.verdict = diagnosis::Verdict::ambiguous;
  const auto line = [](const char* term, const char* axis, double score) {
    search::CandidateScore s;
    s.term = term;
    s.axis = axis;
    s.label = fmt::format("{}.{}", term, axis);
    s.score = score;
    return s;
  };
  d.candidates.clear();
  for (int k = 0; k < 60; ++k) d.candidates.push_back(line("g2_drift", "x", 100.0 - k));
  for (std::size_t k = 0; k < 60; ++k) d.candidates[k].label += fmt::format(" {}", k);
  d.candidates.push_back(line("sag", "x", 1.5));
  d.candidates.push_back(line("magnetic_drift", "y", 0.5));
  d.causes.assign(3, search::Cause{});
  d.causes[0].term = "sag";
  d.causes[1].term = "magnetic_drift";
  d.causes[2].term = "g2_drift";
  d.causes[0].axis = d.causes[2].axis = "x";
  d.causes[1].axis = "y";
  d.causes[2].set = 1;
  d.cosines.labels = {"sag.x", "magnetic_drift.y", "g2_drift.x 3"};
  d.cosines.cosine = MatX::Identity(3, 3);
  return d;
}

TEST(DiagnosisCandidates, TheCausesAreShownHoweverWeakEachIsAlone) {
  const diagnosis::Diagnosis d = cancelling_pair();
  const auto shown = report::shown_candidates(d, 20);
  ASSERT_EQ(shown.size(), 22u);
  EXPECT_EQ(shown[3].alternative, 2);
  EXPECT_EQ(shown[0].alternative, 0) << "the same term and axis, but other parameters";
  EXPECT_EQ(shown[20].score->term, "sag");
  EXPECT_EQ(shown[20].alternative, 1);
  EXPECT_EQ(shown[21].score->term, "magnetic_drift");
  const auto figures = test::figures_of({report::rivals(d)});
  ASSERT_EQ(figures.front().file, "candidates.svg");
  for (const char* text : {"magnetic_drift.y", "alternative 1", "alternative 2"})
    EXPECT_NE(figures.front().svg.find(text), std::string::npos) << text;
  EXPECT_EQ(figures.front().svg.find("g2_drift.x 40"), std::string::npos);
  const std::string out = report::to_text(d);
  EXPECT_NE(out.find("magnetic_drift.y"), std::string::npos) << out;
  EXPECT_NE(out.find("54 weaker ones are in diagnosis.json"), std::string::npos) << out;
}

TEST(DiagnosisPage, ComparesNothingWhereNoCauseIsInTheModel) {
  const test::ScratchFolder folder;
  const mc::Study study = test::read_text(folder, "s.toml", nominal_study);
  diagnosis::Diagnosis d = test::diagnosis(study.filters.front());
  d.fit.shifted.clear();
  d.fit.held_out = {};
  for (auto& s : d.signals) s.explained.clear();
  EXPECT_NE(report::to_html(report::diagnosis_report(study, d, {})).find("with the cause"),
            std::string::npos);
  d.verdict = diagnosis::Verdict::unexplained;
  d.has_patch = false;
  d.causes.clear();
  const std::string page = report::to_html(report::diagnosis_report(study, d, {}));
  for (const char* text : {"with the cause", "acc_x, after", "Before and after"})
    EXPECT_EQ(page.find(text), std::string::npos) << text;
  EXPECT_NE(page.find("No cause is in the model."), std::string::npos);
  EXPECT_EQ(report::to_text(d).find("with the cause"), std::string::npos);
}

TEST(DiagnosisFigures, TheNumbersAtTheRightHaveAHead) {
  for (const report::Figure& f : test::figures_of({report::fit(test::diagnosis(nominal()))})) {
    if (f.file == "held_out.svg") {
      EXPECT_NE(f.svg.find(">gain of log density<"), std::string::npos);
    }
    if (f.file == "moved.svg") {
      EXPECT_NE(f.svg.find(">nominal → with the cause<"), std::string::npos);
    }
  }
}

TEST(DiagnosisInBrief, WhereAnotherEquationMayBeAmongWhatIsMissingItsDiagnosisIsNext) {
  const test::ScratchFolder folder;
  const mc::Study study = test::read_text(folder, "study.toml", test::nominal_study);
  diagnosis::Diagnosis d = test::diagnosis(study.filters.front());
  d.verdict = diagnosis::Verdict::ambiguous;
  d.advice.clear();
  d.proposal.reset();
  const auto next = [&d] { return report::diagnosis_in_brief(d).next; };
  EXPECT_EQ(next().find("coupling="), std::string::npos) << next();
  d.causes.front().term = "frame_closure";
  EXPECT_NE(next().find("--set filter.nominal.coupling=eq6."), std::string::npos) << next();
}

}  // namespace
}  // namespace drift::diagnosis_report_test
