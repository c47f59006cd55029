#include "analysis/report/strapdown/results.hpp"

#include <nlohmann/json.hpp>

#include "analysis/report/page/html_report.hpp"
#include "analysis/report/strapdown/report.hpp"
#include "analysis/report/svg/bar_chart.hpp"
#include "core/base/results_folder.hpp"

namespace drift::report {
namespace {

std::string rotations_picture(const strapdown::StrapdownResult& result) {
  BarChart chart;
  chart.title = "Gravity prediction after held-out rotations";
  chart.x_label = "root mean square error [deg], bars: 95 % bootstrap";
  for (const auto& trial : result.gyro_trials)
    if (trial.rotation) {
      const auto& score = *trial.rotation;
      const std::size_t colour = trial.equation == "eq6" ? 1 : (trial.equation == "eq5" ? 0 : 2);
      chart.bars.push_back({trial.name + " (" + trial.equation + ")", score.held_out, score.low,
                            score.high, colour});
    }
  return svg_of(chart);
}

}  // namespace

std::vector<std::string> write_results(const mc::Study& study,
                                       const strapdown::StrapdownResult& result,
                                       const std::string& folder) {
  const std::string picture = rotations_picture(result);
  HtmlReport report;
  report.title = study.title.empty() ? "Strapdown recording" : study.title;
  report.subtitle = result.source;
  for (const auto& contest : result.contest)
    report.headlines.push_back(
        fmt::format("Held-out rotations: eq. (5) {:.3f} deg, eq. (6) {:.3f} deg, difference {:.1f} "
                    "standard errors.",
                    contest.eq5.held_out, contest.eq6.held_out, contest.z));
  report.sections.push_back(
      {"Models tried", {Picture{picture, "Lower is better; held out of the fit."}}});
  report.sections.push_back({"All results", {Preformatted{to_text(result)}}});
  return write_files({{"identification.json", to_json(result).dump(2) + "\n"},
                      {"rotations.svg", picture},
                      {"report.html", to_html(report)},
                      {"study.toml", study.text}},
                     folder);
}

}  // namespace drift::report
