// The report of a Monte Carlo study, on a small one.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "analysis/report/study/sections.hpp"
#include "tests/analysis/report/figures_of.hpp"
#include "tests/analysis/report/own_script.hpp"
#include "tests/analysis/report/xml_check.hpp"
#include "tests/mc/small_study.hpp"

namespace drift::study_report_test {
namespace {

using namespace drift::test;

const std::set<std::string> void_tags = {"meta", "br", "hr"};

report::StudyResults results_of(const std::string& text, std::size_t runs) {
  report::StudyResults results;
  results.study = read_text(text);
  results.points = mc::study_points(results.study);
  for (std::size_t p = 0; p < results.points.size(); ++p) {
    const mc::StudyTask task(results.points[p].study);
    const auto worker = task.worker();
    results.statistics.emplace_back(task.study());
    results.statistics.back().add(run_block(task, *worker, 0, runs));
  }
  for (const auto& [point, run] : report::runs_to_trace(results))
    results.traces.push_back({point, run, mc::trace_run(results.points[point].study, run)});
  results.provenance = {{"program", "driftscope <test> & more"}, {"seed", "5"}};
  return results;
}

const report::StudyResults& swept() {
  static const report::StudyResults results =
      results_of(small_study +
                     "[sweep]\n\"truth.coupling\" = [\"eq5\", \"eq6\"]\n\"truth.parameters.eta\" = "
                     "[\"20 arcsec\", \"200 arcsec\"]\n",
                 30);
  return results;
}

TEST(StudyReport, IsOneValidPageThatNeedsNothingElse) {
  const std::string html = report::to_html(report::study_report(swept()));
  const auto problem = test::xml_problem(html, void_tags);
  EXPECT_FALSE(problem) << *problem;
  EXPECT_EQ(html.find("http://"), std::string::npos);
  EXPECT_EQ(test::without_own_script(html).find("https://"), std::string::npos);
  EXPECT_EQ(test::without_own_script(html).find("<script"), std::string::npos);
  EXPECT_NE(html.find("driftscope &lt;test&gt; &amp; more"), std::string::npos);
  for (const char* heading :
       {"Truth against filter", "Sweep", "Ranking by Monte Carlo", "Error against sigma",
        "Convergence of sample runs", "Every parameter", "Failures", "Provenance",
        "Does a filter know how well it does?", "Are these runs enough?"})
    EXPECT_NE(html.find(fmt::format(">{}</", heading)), std::string::npos) << heading;
  EXPECT_EQ(html.find(">nan"), std::string::npos);
  EXPECT_EQ(html.find("inf<"), std::string::npos);
}

TEST(StudyReport, TakesSectionsOfOthers) {
  report::StudyResults results = results_of(small_study, 8);
  results.information = {"Ranking by information", {report::Paragraph{"from elsewhere"}}};
  const std::string html = report::to_html(report::study_report(results));
  EXPECT_NE(html.find(">Ranking by information</"), std::string::npos);
  EXPECT_EQ(html.find(">Sweep</"), std::string::npos);
}

/// Innovations that look healthy do not make sigmas right: the short answer says by how much they
/// are wrong.
TEST(StudyReport, TheShortAnswerSaysThatSigmasAreWrong) {
  double worst = 1.0;
  for (const auto& point : swept().statistics)
    for (const auto& filter : point.filters())
      worst = std::max(worst, report::sigmas_off(filter.starts().front()));
  ASSERT_GT(worst, report::much_too_small);
  const report::InBrief brief = report::study_in_brief(swept());
  ASSERT_FALSE(brief.more.empty());
  EXPECT_NE(brief.more.texts().front().find(
                fmt::format("errors are {} times as large", number_text(worst, 2))),
            std::string::npos)
      << brief.more.texts().front();
  EXPECT_EQ(brief.tone, report::Tone::bad);
}

TEST(StudyReport, SaysTheSilentFailureRateInWords) {
  const auto lines = report::headlines(swept());
  ASSERT_EQ(lines.size(), 8u);
  EXPECT_NE(lines[0].find("the wrong equation"), std::string::npos);
  EXPECT_NE(lines[0].find("silent failures"), std::string::npos);
  EXPECT_NE(lines[7].find("the right model"), std::string::npos);
  const std::string text = to_text(report::study_report(swept()));
  EXPECT_NE(text.find("Truth against filter"), std::string::npos);
  EXPECT_NE(text.find("truth.parameters.eta = 20 arcsec"), std::string::npos);
}

TEST(StudyReport, RefusesAHeadlineOverTooManyFailures) {
  report::StudyResults results = results_of(small_study, 8);
  mc::Block failed;
  failed.first = 8;
  failed.status.assign(1, mc::RunStatus::integrator_failed);
  failed.rows.assign(results.statistics[0].columns().count, std::nan(""));
  results.statistics[0].add(failed);
  const auto lines = report::headlines(results);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("No headline"), std::string::npos);
  EXPECT_EQ(std::get<report::Table>(report::failures(results).blocks[0].content).rows.size(), 1u);
  EXPECT_NE(to_text(report::study_report(results)).find("Lost runs have no data"),
            std::string::npos);
}

TEST(StudyReport, ALoopThatCompensatesNothingIsEquation5) {
  std::string text = small_study;
  const std::string wrong = "coupling = \"eq6\"";
  const auto at = text.rfind(wrong);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, wrong.size(), "coupling = \"compensated\"");
  const report::StudyResults results = results_of(text, 2);
  EXPECT_EQ(results.study.truth.coupling, Coupling::eq5);
  ASSERT_EQ(results.statistics[0].filters()[1].columns().coupling, Coupling::compensated);
  EXPECT_TRUE(report::matched(results, {0, 1}));
}

/// Accelerometers that drift, and a filter that does not know of it.
const report::StudyResults& without_ramp() {
  static const report::StudyResults results = [] {
    std::string text = small_study;
    const std::string truth = "\"gyro_misalignment\", \"K0\"]\n[[filter]]";
    text.replace(text.find(truth), truth.size(),
                 "\"gyro_misalignment\", \"K0\", \"accelerometer_ramp\"]\n[truth.parameters]\n"
                 "K0_ramp_x = \"300 ug/h\"\nK0_ramp_y = \"0 ug/h\"\nK0_ramp_z = \"0 ug/h\"\n"
                 "[[filter]]");
    return results_of(text, 30);
  }();
  return results;
}

/// No sigma knows of a term that is missing: the errors are those of a wrong model, and linear.
TEST(StudyReport, ATermThatTheFilterLacksIsNamed) {
  const report::StudyResults& results = without_ramp();
  EXPECT_FALSE(report::matched(results, {0, 0}));
  const std::string first = report::pair_in_words(results, {0, 0});
  std::string told;
  for (const std::string& line : report::headlines(results))
    if (line.starts_with(first)) told = line;
  EXPECT_NE(told.find("(without accelerometer_ramp.x of the truth)"), std::string::npos) << told;
  const report::InBrief brief = report::study_in_brief(results);
  const auto said = brief.more.texts();
  EXPECT_TRUE(std::ranges::any_of(said, [](const std::string& text) {
    return text.starts_with("A filter without accelerometer_ramp.x of the truth: 2 sigma hold");
  })) << fmt::format("{}", fmt::join(said, "\n"));
  const auto json = nlohmann::json::parse(report::study_report(results).document.second);
  const auto& pair = json["points"][0]["filters"][0];
  EXPECT_EQ(pair["matched"], false);
  EXPECT_EQ(pair["left_out"]["equation"], false);
  EXPECT_EQ(pair["left_out"]["terms"], nlohmann::json::array({"accelerometer_ramp.x"}));
}

TEST(StudyReport, ErrorsOfATermThatIsMissingAreNotCalledNonlinear) {
  std::size_t wrong = 0, nonlinear = 0;
  for (const report::Block& block : report::information_section(without_ramp(), 1).blocks)
    if (const auto* table = std::get_if<report::Table>(&block.content);
        table &&
        table->title.find("filter right (without accelerometer_ramp.x") != std::string::npos)
      for (const report::TableRow& row : table->rows) {
        wrong += row.cells.back().text == "wrong model" ? 1 : 0;
        nonlinear += row.cells.back().text == "nonlinear" ? 1 : 0;
      }
  EXPECT_GT(wrong, 0u);
  EXPECT_EQ(nonlinear, 0u);
}

/// Points are written one by one: together they are the text of one document.
TEST(StudyReport, SummaryIsOneDocumentWhateverItsNumberOfPoints) {
  const std::string text = report::study_report(swept()).document.second;
  const auto json = nlohmann::ordered_json::parse(text);
  EXPECT_GT(json["points"].size(), 1u);
  EXPECT_EQ(json.dump(1) + "\n", text);
}

TEST(StudyReport, JsonHoldsWhatTheTablesSay) {
  const auto json = nlohmann::json::parse(report::study_report(swept()).document.second);
  ASSERT_EQ(json["points"].size(), 4u);
  const auto& pair = json["points"][0]["filters"][1];
  EXPECT_EQ(pair["name"], "wrong");
  EXPECT_EQ(pair["matched"], false);
  EXPECT_EQ(pair["left_out"]["equation"], true);
  EXPECT_TRUE(pair["left_out"]["terms"].empty());
  const auto& start = swept().statistics[0].filters()[1].starts()[0];
  EXPECT_EQ(pair["starts"][0]["silent_failure_rate"]["hits"], start.silent.hits);
  EXPECT_EQ(pair["starts"][0]["silent_failure_rate"]["of"], 30);
  const auto& parameter = pair["parameters"][0];
  EXPECT_EQ(parameter["key"], "D_F_x");
  const auto& e = swept().statistics[0].filters()[1].errors()[0];
  EXPECT_DOUBLE_EQ(parameter["rmse"]["value"], e.rmse().value / TermLibrary::specs[0].unit.to_si);
  EXPECT_EQ(parameter["coverage"].size(), 3u);
  // Every run once in the pictures, as counted elsewhere.
  const auto sum_of = [](const nlohmann::json& counts) {
    std::uint64_t sum = 0;
    for (const auto& n : counts) sum += n.get<std::uint64_t>();
    return sum;
  };
  EXPECT_EQ(sum_of(parameter["errors_by_normal_bin"]), parameter["runs"]);
  EXPECT_EQ(sum_of(pair["starts"][0]["nis"]["runs_by_chi_square_bin"]), start.nis.in_band.of);
  EXPECT_EQ(pair["starts"][0]["silent_failure_rate_by_runs"][9]["of"], 10);
  EXPECT_EQ(json["provenance"]["seed"], "5");
  EXPECT_TRUE(json["points"][0]["filters"][1]["parameters"][0]["start_consistency"].is_null());
}

/// Of seven points the pictures would be those of 0, 2, 4 and 6. A filter on the wrong equation
/// notices a misalignment of 200 arcsec, and not one of 1 arcsec, that of point 5.
TEST(StudyReport, TheWorstPointIsShownAndHowManyAreNot) {
  const report::StudyResults results =
      results_of(small_study +
                     "[sweep]\n\"truth.parameters.eta\" = [\"200 arcsec\", \"210 arcsec\", \"220 "
                     "arcsec\", \"230 arcsec\", \"240 arcsec\", \"1 arcsec\", \"250 arcsec\"]\n",
                 8);
  for (std::size_t p = 0; p < 7; ++p)
    EXPECT_EQ(report::statistics_of(results, {p, 1}).starts().front().silent.hits > 0, p == 5) << p;
  EXPECT_EQ(report::pictured_points(results), (std::vector<std::size_t>{0, 2, 4, 5, 6}));
  const report::Section course = report::rate_course(results);
  ASSERT_EQ(course.blocks.size(), 2u);
  const auto& said = std::get<report::Sentences>(course.blocks[1].content).items;
  ASSERT_EQ(said.size(), 11u);  // two filters at five points, and what is not shown
  EXPECT_NE(said[7].find("truth.parameters.eta = 1 arcsec, filter wrong: "), std::string::npos)
      << said[7];
  EXPECT_NE(said[10].find("of 5 of the 7 study points"), std::string::npos) << said[10];
  EXPECT_NE(said[10].find("truth.parameters.eta = 1 arcsec). 2 are not shown"), std::string::npos)
      << said[10];
  EXPECT_EQ(report::not_pictured_text(swept()), "");
}

TEST(StudyReport, WritesItsFiles) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("driftscope_report_" + std::to_string(::getpid()));
  const auto names = report::write_report(report::study_report(swept()), folder.string());
  EXPECT_EQ(names, (std::vector<std::string>{"summary.json", "report.html"}));
  for (const auto& name : names) EXPECT_GT(std::filesystem::file_size(folder / name), 1000u);
  std::filesystem::remove_all(folder);
}

TEST(SweepPictures, AreDrawnForAxesOfNumbersAlone) {
  const auto pictures = test::figures_of({report::sweep(swept())});
  ASSERT_EQ(pictures.size(), 1u);
  EXPECT_NE(pictures[0].caption.find("truth.parameters.eta"), std::string::npos);
  EXPECT_NE(pictures[0].svg.find("truth.parameters.eta [arcsec]"), std::string::npos);
  EXPECT_TRUE(report::sweep(results_of(small_study, 2)).blocks.empty());
}

/// A sigma is no value, and that about another mean another one.
TEST(SweepPictures, AreDrawnWhereNumbersMeanTheSameAlone) {
  const auto drawn = [](const std::string& values) {
    const auto pictures = test::figures_of({report::sweep(
        results_of(small_study + "[sweep]\n\"truth.parameters.D_F\" = [" + values + "]\n", 2))});
    return pictures.empty() ? "" : pictures.front().svg;
  };
  const std::string about_zero = R"({ normal = ["0 deg/h", "1 deg/h"] })",
                    wider = R"({ normal = ["0 deg/h", "2 deg/h"] })",
                    elsewhere = R"({ normal = ["3 deg/h", "2 deg/h"] })";
  EXPECT_NE(drawn(about_zero + ", " + wider).find("truth.parameters.D_F, sigma [deg/h]"),
            std::string::npos);
  EXPECT_EQ(drawn(about_zero + ", " + elsewhere), "");
  EXPECT_EQ(drawn(about_zero + ", \"2 deg/h\""), "");
}

}  // namespace
}  // namespace drift::study_report_test
