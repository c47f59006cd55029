// What the short answer and the headlines of a study say, on runs whose numbers are set by hand.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "analysis/inference/thresholds.hpp"
#include "analysis/report/study/sections.hpp"
#include "tests/mc/small_study.hpp"

namespace drift::study_brief_test {
namespace {

using C = mc::StudyColumns;

/// `runs` perfect estimates of every filter at every point, of 1000 scalars each; the first points
/// alone have them. `nis` and `nees`: per degree of freedom.
report::StudyResults results_of(const std::string& text, std::size_t runs, std::size_t points,
                                double nis = 1.0, double nees = 1.0) {
  report::StudyResults results;
  results.study = test::read_text(text);
  results.points = mc::study_points(results.study);
  for (const mc::StudyPoint& point : results.points) {
    mc::PointStatistics& statistics = results.statistics.emplace_back(point.study);
    if (results.statistics.size() > points) continue;
    const C& columns = statistics.columns();
    mc::Block block;
    block.status.assign(runs, mc::RunStatus::ok);
    block.rows.assign(runs * columns.count, 0.0);
    for (std::size_t r = 0; r < runs; ++r)
      for (const C::Filter& f : columns.filters)
        for (std::size_t s = 0; s < f.starts; ++s) {
          double* row = &block.rows[r * columns.count];
          row[f.at(s, C::nis)] = 1000.0 * nis;
          row[f.at(s, C::nis_dof)] = 1000.0;
          row[f.at(s, C::nees)] = 8.0 * nees;
          row[f.at(s, C::nees_dof)] = 8.0;
          row[f.at(s, C::nees_all)] = static_cast<double>(f.layout.size());
          for (std::size_t k = 0; k < f.layout.size(); ++k)
            row[f.sigma(s, k)] = 0.1 * f.layout.sigma[static_cast<Eigen::Index>(k)];
        }
    statistics.add(block);
  }
  return results;
}

/// The only sentence of the short answer that holds this; empty if none does.
std::string said(const report::StudyResults& results, const std::string& part) {
  std::string found;
  for (const std::string& text : report::study_in_brief(results).more.texts())
    if (text.find(part) != std::string::npos) {
      EXPECT_TRUE(found.empty()) << text;
      found = text;
    }
  return found;
}

TEST(StudyBrief, InnovationsThatARightFilterDoesNotExpectAreSaid) {
  const std::string innovations = "The innovations are not those that the filter expects";
  // 40 runs of 1000 scalars: z sigma of NIS/dof, to the order of its skewness (Cornish and Fisher),
  // are z sqrt(2/dof) + 2/3 (z^2 - 1)/dof.
  constexpr double z = inference::FitLimits::misfit, dof = 40000.0;
  const double limit = z * std::sqrt(2.0 / dof) + 2.0 / 3.0 * (z * z - 1.0) / dof;
  EXPECT_EQ(said(results_of(test::small_study, 40, 1), innovations), "");
  EXPECT_EQ(said(results_of(test::small_study, 40, 1, 1.0 + 0.99 * limit), innovations), "");
  EXPECT_NE(said(results_of(test::small_study, 40, 1, 1.0 + 1.01 * limit), innovations), "");
  const report::StudyResults far = results_of(test::small_study, 40, 1, 14.5);
  const std::string text = said(far, innovations);
  EXPECT_NE(text.find("NIS/dof 14.5 (by chance 0.986 to 1.01; truth eq5, filter right), and 0.0 %"),
            std::string::npos)
      << text;
  EXPECT_EQ(report::study_in_brief(far).more.first_wrong(), text);
  EXPECT_EQ(report::study_in_brief(far).tone, report::Tone::bad);
}

TEST(StudyBrief, WhatIsSaidOfTheSigmasOfAPairIsNotSaidOfItsInnovationsAgain) {
  const report::StudyResults results = results_of(test::small_study, 40, 1, 14.5, 9.0);
  EXPECT_EQ(said(results, "The innovations are not"), "");
  EXPECT_FALSE(report::study_in_brief(results).more.first_wrong().empty());
}

TEST(StudyBrief, SigmasNotToBeTrustedAreThoseOfAFilterAndWhetherItsResidualsShowItIsSaid) {
  const report::StudyResults silent = results_of(test::small_study, 40, 1, 1.0, 9.0),
                             seen = results_of(test::small_study, 40, 1, 14.5, 9.0);
  EXPECT_EQ(
      said(silent, "filter wrong ("),
      "Do not trust the sigmas of filter wrong (truth eq5): errors are 3 times as large (root "
      "of NEES/dof). It has the wrong equation; its residuals alarm in 0.0 % of the runs (by "
      "chance 5).");
  EXPECT_NE(said(seen, "filter wrong (").find("its residuals alarm in 100.0 % of the runs"),
            std::string::npos);
  EXPECT_NE(said(silent, "filter right (").find("Its model is the truth's; its residuals alarm"),
            std::string::npos)
      << said(silent, "filter right (");
}

TEST(StudyBrief, WhereTheModelIsTheTruthsTheEstimatorIsBlamed) {
  const auto with = [](const std::string& estimator, const std::string& terms) {
    std::string text = test::small_study;
    const auto put = [&](const std::string& old, const std::string& fresh) {
      for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += fresh.size())
        text.replace(at, old.size(), fresh);
    };
    put("\"K0\"]", "\"K0\"" + terms + "]");
    put("\"iterated\"", "\"" + estimator + "\"");
    return said(results_of(text, 40, 1, 1.0, 9.0), "filter right (");
  };
  const std::string outliers = ", \"outliers\"", batch = "Set monte_carlo.estimator = \"batch\"";
  for (const char* estimator : {"ekf", "iterated"}) {
    const std::string text = with(estimator, outliers);
    EXPECT_NE(text.find("Its model is the truth's; its residuals alarm in 0.0 % of the runs (by "
                        "chance 5). So it is the estimator: it meets the samples one by one, and "
                        "right after a caging cannot tell an outlier from what it does not know "
                        "yet. " +
                        batch),
              std::string::npos)
        << text;
  }
  EXPECT_EQ(with("batch", outliers).find(batch), std::string::npos);
  EXPECT_NE(with("ekf", "").find("Set monte_carlo.estimator = \"iterated\""), std::string::npos);
}

/// A filter that lacks something of the truth is not excused by its estimator.
TEST(StudyBrief, WhereTheModelIsNotTheTruthsNoEstimatorIsBlamed) {
  EXPECT_EQ(said(results_of(test::small_study, 40, 1, 1.0, 9.0), "filter wrong (")
                .find("it is the estimator"),
            std::string::npos);
}

TEST(StudyBrief, WhereNoFilterFailsSilentlyNoPointIsTheWorst) {
  // Wilson's interval of 0 of 40 ends at z^2 / (40 + z^2) = 0.0876.
  EXPECT_EQ(report::study_in_brief(results_of(test::small_study, 40, 1)).verdict,
            "With the wrong equation: no silent failure (95 %: at most 8.8 %).");
  const std::string swept = test::small_study + R"([sweep]
"truth.parameters.eta" = ["20 arcsec", "30 arcsec"]
)";
  EXPECT_NE(said(results_of(swept, 40, 2), "With the right model")
                .find("no silent failure at any point (95 %: at most 8.8 %)."),
            std::string::npos);
}

TEST(StudyBrief, AnUnfinishedStudySaysSoFirst) {
  const std::string text = test::small_study + R"([sweep]
"truth.parameters.eta" = ["20 arcsec", "30 arcsec", "40 arcsec"]
)";
  report::StudyResults results = results_of(text, 40, 1);
  results.asked = 40;
  results.unfinished = {1, 2};
  const report::Report page = report::study_report(results);
  EXPECT_EQ(page.subtitle, "40 of 120 runs at 3 study points, seed 5");
  EXPECT_EQ(page.brief.more.texts().front(),
            "The study is not finished: 40 of 120 runs are there; 2 of 3 study points have none. "
            "What is said is of these runs.");
  EXPECT_NE(page.brief.tone, report::Tone::good);
  for (const std::string& line : page.headlines)
    EXPECT_NE(line.find("eta = 20 arcsec"), std::string::npos) << "of no runs nothing is said";
  const auto json = nlohmann::json::parse(page.document.second);
  EXPECT_EQ(json["runs"], 40);
  EXPECT_EQ(json["runs_planned"], 120);
  EXPECT_EQ(json["finished"], false);
  report::StudyResults whole = results_of(text, 40, 3);
  whole.asked = 40;
  EXPECT_EQ(report::study_report(whole).subtitle, "120 runs at 3 study points, seed 5");
  EXPECT_EQ(said(whole, "not finished"), "");
  EXPECT_EQ(nlohmann::json::parse(report::study_report(whole).document.second)["finished"], true);
}

TEST(StudyBrief, HeadlinesThatHaveNoRoomAreCounted) {
  const report::StudyResults results = results_of(test::small_study + R"([sweep]
"truth.parameters.eta" = ["1 arcsec", "2 arcsec", "3 arcsec", "4 arcsec", "5 arcsec", "6 arcsec", "7 arcsec"]
)",
                                                  2, 7);
  const report::Report page = report::study_report(results);
  ASSERT_EQ(page.headlines.size(), report::most_headlines + 1);
  EXPECT_EQ(page.headlines.back(), "And 2 more pairs of point and filter: see the tables.");
  const auto json = nlohmann::json::parse(page.document.second);
  EXPECT_EQ(json["headlines"].size(), 14u);
}

TEST(StudyBrief, AFilterThatKnowsLessNoiseThanThereIsIsNotTheRightModel) {
  report::StudyResults results = results_of(test::small_study, 4, 1);
  results.points[0].study.truth.noise.drift_random_walk = 1e-9;
  for (FilterSpec& filter : results.points[0].study.filters) filter.noise.drift_random_walk = 1e-11;
  results.points[0].study.filters[0].priors[*TermLibrary::find("D_F_x")] = normal(0.0, 1e-12);
  EXPECT_EQ(report::model_in_words(report::left_out(results, {0, 0})),
            "with drift_random_walk smaller than the truth's, with prior of D_F_x that excludes "
            "the truth");
  const auto json = nlohmann::json::parse(report::study_report(results).document.second);
  const auto& pair = json["points"][0]["filters"][0];
  EXPECT_EQ(pair["matched"], false);
  EXPECT_EQ(pair["left_out"]["smaller"], nlohmann::json::array({"drift_random_walk"}));
  EXPECT_EQ(pair["left_out"]["excluded"], nlohmann::json::array({"D_F_x"}));
}

}  // namespace
}  // namespace drift::study_brief_test
