#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "analysis/report/identify/sections.hpp"
#include "analysis/report/page/escape.hpp"
#include "core/base/check.hpp"
#include "core/base/results/folder.hpp"
#include "tests/analysis/report/figures_of.hpp"
#include "tests/analysis/report/identify/identification_fixture.hpp"
#include "tests/analysis/report/own_script.hpp"
#include "tests/analysis/report/xml_check.hpp"

namespace drift::identification_report_test {
namespace {

const std::string hostile = "\"><script>alert('x')</script>\xff";

TEST(IdentificationText, FitsOnAPageAndSaysWhatMatters) {
  mc::Study study = test::study();
  study.published = test::table_1();
  identification::Identification id = test::identification(study);
  const auto n = static_cast<Eigen::Index>(id.summaries[1].layout.size());
  id.runs[3].batch.information_root = (VecX::Ones(n) - VecX::Unit(n, 4)).asDiagonal();
  id.summaries[1].unseen = {{0.0, VecX::Unit(n, 4)}};
  id.runs[4].ekf.status = EstimateStatus::diverged;
  id.runs[4].ekf.cause = "filter diverged at t = 60 s";
  const std::string text = to_text(report::identification_report(study, id));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    EXPECT_LE(report::display_width(line), 100u) << line;
  for (const char* part :
       {"Filter corrected (eq5)", "w_cp = -w_ic - C^-1 (w_l + w_md)",
        "g_drift: D_I [deg/h/g], prior sigma 2", "eta_x", "1.010", "0.914 to 1.090",
        "Wilson-Hilferty", "diverged", "filter diverged at t = 60 s", "EKF 3", "depends on start",
        "Table 1 beside this run, filter legacy", "no signal",
        "directions of its parameters 1 is not seen at all",
        "Filter corrected (eq5): no parameter depends on the start."})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST(IdentificationText, SaysHowFarTheEstimatorsAreApart) {
  const mc::Study study = test::study();
  std::string text = to_text(report::identification_report(study, test::identification(study)));
  std::ranges::replace(text, '\n', ' ');
  for (const char* part :
       {"by 0.2 sigma; the batch fit counts", "by 30 sigma; the batch fit counts"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST(IdentificationText, SaysWhereTheEstimatorsDisagree) {
  const mc::Study study = test::study();
  identification::Identification id = test::identification(study);
  const auto said = [&] {
    std::string all;
    for (const std::string& line : report::headlines(study, id)) all += line + "\n";
    return all;
  };
  // Start 1 of filter 1 is 3 prior sigmas, 30 of its own, off; that of filter 0 a fifth of its
  // sigma.
  const std::string text = said();
  EXPECT_NE(
      text.find(
          "Filter legacy (eq6): from start 1, EKF and batch fit are outside each other's 95 %"),
      std::string::npos)
      << text;
  EXPECT_EQ(text.find("Filter corrected (eq5): from start 1, EKF"), std::string::npos) << text;
  for (identification::FilterRun& run : id.runs)
    run.ekf.status = EstimateStatus::diverged;  // said elsewhere
  EXPECT_EQ(said().find("outside each other's"), std::string::npos);
}

TEST(IdentificationText, SaysThatTheBatchFitCountsWhereTheEkfAloneIsOff) {
  const mc::Study study = test::study();
  identification::Identification id = test::identification(study);
  const auto short_answer = [&] {
    return report::brief_text(report::identification_in_brief(study, id), 400);
  };
  // Filter 0: start 1 a fifth of a sigma from the batch fit; filter 1: 30 sigma.
  EXPECT_EQ(short_answer().find("Filter corrected: the batch fit counts"), std::string::npos);
  EXPECT_NE(short_answer().find("Filter legacy: the batch fit counts, and it is what a right model "
                                "gives; the EKF, which linearises once, is off beyond"),
            std::string::npos)
      << short_answer();
  for (double off : {0.19, 0.21}) {  // of 0.1 prior sigmas each: 1.9 and 2.1 sigma
    EstimateResult& ekf = id.runs[0].ekf;
    ekf.parameters[3].value =
        id.runs[0].batch.estimate.parameters[3].value + off * ekf.parameters[3].prior_sigma;
    for (std::size_t k = 0; k < ekf.parameters.size(); ++k)
      if (k != 3) ekf.parameters[k].value = id.runs[0].batch.estimate.parameters[k].value;
    EXPECT_EQ(short_answer().find("Filter corrected: the batch fit counts") != std::string::npos,
              off > 0.196)
        << off;
  }
  // What the EKF owes to its start is no error of its: of a parameter of which nothing is learned
  // it keeps the start.
  const auto n = static_cast<Eigen::Index>(id.runs[0].ekf.parameters.size());
  id.runs[0].batch.estimate.covariance = MatX::Zero(n, n);
  id.runs[0].batch.estimate.covariance(3, 3) = 0.1;
  id.runs[0].ekf.parameters[3].start =
      id.runs[0].ekf.parameters[3].prior_mean + 2.1 * id.runs[0].ekf.parameters[3].prior_sigma;
  EXPECT_EQ(short_answer().find("Filter corrected: the batch fit counts"), std::string::npos);
  // Innovations alone, and the sentence of the page.
  id = test::identification(study);
  id.runs[0].ekf.statistic = 1150.0;  // 95 % of right models are within 0.914 to 1.090
  EXPECT_NE(short_answer().find("Filter corrected: the batch fit counts"), std::string::npos);
  EXPECT_EQ(short_answer().find("Misfit"), std::string::npos);
  std::string page;
  for (const std::string& line : report::headlines(study, id)) page += line + "\n";
  EXPECT_NE(page.find("from 1 of 3 starts; the batch fit, which counts, is inside"),
            std::string::npos)
      << page;
  id.runs[0].batch.estimate.statistic = 1150.0;  // then it is the model
  EXPECT_EQ(short_answer().find("Filter corrected: the batch fit counts"), std::string::npos);
}

TEST(IdentificationJson, HoldsEveryResultInItsUnitAndNoNan) {
  mc::Study study = test::study();
  study.published = test::table_1();
  study.title = hostile;
  identification::Identification id = test::identification(study);
  id.runs[0].ekf.parameters[0].sigma = std::nan("");
  id.runs[0].ekf.parameters[1].value = HUGE_VAL;
  id.summaries[0].spread[0].ekf = std::nan("");
  id.runs[1].ekf.measured = 0;
  id.remarks = {"temperature has no reading in 5 of 120 rows"};
  const std::string text = report::identification_report(study, id).document.second;
  const auto json = nlohmann::json::parse(text);  // NaN would not parse
  EXPECT_EQ(json["schema"], 1);
  EXPECT_EQ(json["remarks"], id.remarks);
  EXPECT_EQ(json["filters"].size(), 2u);
  const auto& filter = json["filters"][0];
  EXPECT_EQ(filter["name"], "corrected");
  EXPECT_EQ(filter["coupling"], "eq5");
  EXPECT_EQ(filter["starts"].size(), 3u);
  const auto& ekf = filter["starts"][0]["ekf"];
  EXPECT_TRUE(ekf["parameters"]["D_F_x"]["sigma"].is_null());
  EXPECT_TRUE(ekf["parameters"]["D_F_y"]["estimate"].is_null());
  EXPECT_EQ(ekf["parameters"]["eta_x"]["unit"], "arcsec");
  EXPECT_NEAR(ekf["parameters"]["eta_x"]["estimate"].get<double>(), 0.5 * 200.0 - 0.02 * 200.0,
              1e-9);
  EXPECT_NEAR(ekf["parameters"]["eta_x"]["learning_ratio"].get<double>(), 0.1, 1e-12);
  EXPECT_NEAR(ekf["chi2_per_dof"].get<double>(), 1.01, 1e-12);
  EXPECT_TRUE(filter["starts"][1]["ekf"]["chi2_per_dof"].is_null());
  EXPECT_TRUE(filter["parameters"]["D_F_x"]["start_consistency"]["ekf"].is_null());
  EXPECT_EQ(json["filters"][1]["parameters"]["eta_x"]["start_consistency"]["verdict"],
            "depends_on_start");
  EXPECT_EQ(json["published"][1]["parameters"]["eta_x"]["verdict"], "depends_on_start");
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

TEST(IdentificationFigures, ShowThePublishedParametersOfEveryFilter) {
  mc::Study study = test::study();
  study.published = test::table_1();
  const identification::Identification id = test::identification(study);
  const auto figures = test::figures_of({report::estimate_figures(study, id)});
  std::vector<std::string> files;
  for (const report::Figure& f : figures) {
    files.push_back(f.file);
    EXPECT_EQ(test::xml_problem(f.svg).value_or(""), "") << f.file;
  }
  EXPECT_EQ(files, (std::vector<std::string>{"estimates.svg", "figure_corrected.svg",
                                             "figure_legacy.svg", "nis.svg"}));
  for (const char* text :
       {"corrected (eq5): D_I_z", "legacy (eq6): eta_x", "truth", "component test"})
    EXPECT_NE(figures[0].svg.find(text), std::string::npos) << text;
}

TEST(IdentificationFigures, HighlightWhatIsPublishedElseGivenElseDoubtful) {
  mc::Study study = test::study();
  identification::Identification id = test::identification(study);
  id.summaries[0].spread[5].ekf = 99.0;
  EXPECT_EQ(report::highlighted_parameters(study, id).front(), id.summaries[0].spread[5].param);
  EXPECT_EQ(report::highlighted_parameters(study, id).size(), 3u);
  study.resolved = {{"truth.parameters.eta_y", "1 arcsec", "default prior"},
                    {"truth.parameters.eta_x", "112 arcsec", "study.toml:12"},
                    {"truth.parameters.s_x", "1 ppm", "--set"}};  // no state of either filter
  EXPECT_EQ(report::highlighted_parameters(study, id),
            (std::vector<std::size_t>{TermLibrary::index("eta_x")}));
  study.published = {test::published("p", "", {{"D_I_z", {1.0}, {}}})};
  EXPECT_EQ(report::highlighted_parameters(study, id),
            (std::vector<std::size_t>{TermLibrary::index("D_I_z")}));
}

TEST(IdentificationFigures, StopWhereTheFilterStopped) {
  mc::Study study = test::study();
  study.published = {test::published("p", "", {{"D_I_z", {1.0}, {}}})};
  identification::Identification id = test::identification(study);
  for (identification::FilterRun& run : id.runs) {
    run.history.estimate.rightCols(200).setZero();
    run.history.sigma.rightCols(200).setZero();
    std::fill(run.history.scalars.begin() + 100, run.history.scalars.end(), 0);
  }
  for (const report::Figure& f : test::figures_of({report::estimate_figures(study, id)})) {
    EXPECT_EQ(test::xml_problem(f.svg).value_or(""), "");
    EXPECT_EQ(f.svg.find("nan"), std::string::npos);
  }
}

TEST(IdentificationHtml, IsSafeWithHostileNames) {
  mc::Study study = test::study();
  study.published = test::table_1();
  study.title = study.filters[0].name = study.published[0].name = hostile;
  study.resolved = {{"title", hostile, hostile}};
  identification::Identification id = test::identification(study);
  id.runs[0].ekf.cause = hostile;
  id.remarks = {hostile};
  const std::string html = report::to_html(report::identification_report(study, id));
  EXPECT_EQ(test::xml_problem(html, {"meta"}).value_or(""), "");
  EXPECT_EQ(test::without_own_script(html).find("<script"), std::string::npos);
  EXPECT_EQ(test::without_own_script(html).find("://"), std::string::npos);
  EXPECT_NE(html.find("depends on start"), std::string::npos);
  EXPECT_NE(html.find("To be kept in mind"), std::string::npos);
  EXPECT_LT(html.size(), 1500000u);
}

class ResultsFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("driftscope_results_") + std::to_string(::getpid()) +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST_F(ResultsFolder, HoldsEveryFileAndNothingElse) {
  mc::Study study = test::study();
  study.filters[0].name = "../up/and out";
  study.path = (folder_ / "in.toml").string();
  study.text = "schema = 1\n# text\n";
  identification::Identification id = test::identification(study);
  id.recordings.resize(1);
  id.recordings.front().channels = {{"time", unit::s, {60.0, 120.0}},
                                    {"position", unit::one, {1.0, 1.0}},
                                    {"acc_x", unit::g, {0.5, 0.25}}};
  const auto names = report::write_identification(report::identification_report(study, id), id,
                                                  (folder_ / "a/b").string());
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "a/b"))
    found.insert(entry.path().filename().string());
  EXPECT_EQ(found.erase(".driftscope"), 1u) << "the register of what was written";
  EXPECT_EQ(found, std::set<std::string>(names.begin(), names.end()));
  EXPECT_EQ(found, (std::set<std::string>{
                       "identification.json", "estimates.svg", "figure__._up_and_out.svg",
                       "figure_legacy.svg", "nis.svg", "report.html", "recording.csv", "study.toml",
                       "estimates.csv", "covariance.csv", "residuals.csv", "identification.nc"}));
  EXPECT_EQ(read(folder_ / "a/b/study.toml"), "schema = 1\n# text\n");
  EXPECT_EQ(nlohmann::json::parse(read(folder_ / "a/b/identification.json"))["schema"], 1);
  EXPECT_NE(read(folder_ / "a/b/recording.csv").find("acc_x [g]"), std::string::npos);
}

void expect_io_error(const std::function<void()>& action, const std::string& path,
                     const std::string& reason) {
  try {
    action();
    FAIL() << "no error for " << path;
  } catch (const InputError& e) {
    EXPECT_EQ(e.code(), ExitCode::io);
    EXPECT_NE(std::string(e.what()).find(path), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find(reason), std::string::npos) << e.what();
  }
}

TEST_F(ResultsFolder, SaysWhyItCannotBeWritten) {
  const mc::Study study = test::study();
  const identification::Identification id = test::identification(study);
  std::ofstream(folder_) << "a file where the folder should be";
  expect_io_error(
      [&] { report::write_report(report::identification_report(study, id), folder_.string()); },
      folder_.string(), "cannot be written");
  expect_io_error([&] { write_text_atomically("/proc/none/x", "text"); }, "/proc/none/x",
                  "No such file");
}

TEST_F(ResultsFolder, AWrittenTextReplacesTheOldOneWhole) {
  std::filesystem::create_directories(folder_);
  const std::string path = (folder_ / "x.txt").string();
  write_text_atomically(path, std::string(100000, 'a'));
  write_text_atomically(path, "short");
  EXPECT_EQ(read(path), "short");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
}

}  // namespace
}  // namespace drift::identification_report_test
