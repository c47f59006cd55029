#include "analysis/report/blind/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/report/blind/tables.hpp"
#include "analysis/report/page/html_report.hpp"
#include "analysis/report/svg/heat_map.hpp"
#include "analysis/report/svg/svg_chart.hpp"
#include "core/base/number_text.hpp"
#include "core/base/results_folder.hpp"

namespace drift::report {
namespace {

std::string standing_text(const std::vector<blind::Target>& targets) {
  const auto count = [&](blind::Standing standing) {
    return std::count_if(targets.begin(), targets.end(),
                         [=](const blind::Target& t) { return t.standing() == standing; });
  };
  return fmt::format(
      "Of {} targets {} are met and {} missed with their whole intervals, {} met and {} missed "
      "within their "
      "intervals, {} not decided.",
      targets.size(), count(blind::Standing::met), count(blind::Standing::missed),
      count(blind::Standing::met_within), count(blind::Standing::missed_within),
      count(blind::Standing::not_decided));
}

std::vector<std::string> headlines(const blind::Summary& s, const Hashes& hashes) {
  return {fmt::format("{} trials, {} of them without an answer. {}", s.trials, s.failed,
                      standing_text(s.targets)),
          fmt::format("The nominal fit looks healthy (chi-square inside its 95 % band) in {} "
                      "effect trials, and its "
                      "worst parameter is off by {} of its sigmas (median).",
                      text_of(s.concealed), number_text(s.largest_bias_median, 3)),
          fmt::format(
              "Key sealed before any diagnosis: SHA-256 {}; answers before the key was opened: {}.",
              hashes.key, hashes.answers)};
}

std::string times_text(const blind::Summary& s) {
  return fmt::format(
      "A diagnosis took {} s on average, the longest {} s. Pulls of the recovered parameters have "
      "a "
      "robust rms of {} (1 if their sigmas are right).",
      number_text(s.mean_seconds, 3), number_text(s.longest_seconds, 3),
      number_text(s.pull_rms, 3));
}

Series curve(std::string label, std::size_t colour, Stroke stroke = Stroke::solid) {
  Series s;
  s.label = std::move(label);
  s.colour = colour;
  s.stroke = stroke;
  return s;
}

Chart chart_of(std::string title, double height, Panel panel) {
  Chart chart;
  chart.title = std::move(title);
  chart.panels = {std::move(panel)};
  chart.panel_width = 640.0;
  chart.panel_height = height;
  return chart;
}

std::string power_svg(const blind::Summary& s) {
  Panel panel;
  panel.x_label = "size, not absorbed by the nominal fit [sigma]";
  panel.y_label = "share of trials";
  panel.y_range = Range{0.0, 1.02};
  Series power = curve("detected", 0), theory = curve("theory", 6, Stroke::dashed);
  Series exact = curve("named exactly", 2), set = curve("in a set of at most 3", 1, Stroke::dashed);
  ExpectedBand band;
  band.label = "95 % interval of detection";
  for (const blind::PowerPoint& p : s.power) {
    for (Series* c : {&power, &theory, &exact, &set}) c->x.push_back(p.mean);
    power.y.push_back(p.detected.share());
    theory.y.push_back(p.theory);
    exact.y.push_back(p.exact.share());
    set.y.push_back(p.in_set.share());
    band.x.push_back(p.mean);
    band.low.push_back(p.detected.low);
    band.high.push_back(p.detected.high);
  }
  if (s.power.empty()) panel.note = "no single effects";
  panel.expected = {band};
  panel.series = {power, theory, exact, set};
  return svg_of(chart_of("Detection and naming of single effects", 320.0, panel));
}

/// Shares of each row of the confusion table.
std::string confusion_svg(const blind::Confusion& c) {
  HeatMap map;
  map.title = "What was hidden (rows) and what it was called (columns)";
  map.value_label = "share of the row";
  map.columns = c.columns;
  map.most = 1.0;
  map.value = MatX::Zero(static_cast<Eigen::Index>(c.rows.size()),
                         static_cast<Eigen::Index>(c.columns.size()));
  for (std::size_t r = 0; r < c.rows.size(); ++r) {
    const auto& called = c.rows[r].called;
    map.rows.push_back(c.rows[r].hidden);
    const auto total =
        static_cast<double>(std::accumulate(called.begin(), called.end(), std::size_t{0}));
    for (std::size_t k = 0; k < called.size(); ++k)
      map.value(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(k)) =
          static_cast<double>(called[k]) / total;
  }
  return svg_of(map);
}

/// Sorted values against the share of them that is smaller.
Series distribution(std::string label, std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  std::sort(values.begin(), values.end());
  Series s = curve(std::move(label), 0);
  for (std::size_t k = 0; k < values.size(); ++k) {
    s.x.push_back(values[k]);
    s.y.push_back((static_cast<double>(k) + 0.5) / static_cast<double>(values.size()));
  }
  return s;
}

std::string pulls_svg(const blind::Summary& s) {
  Panel panel;
  panel.x_label = "(estimate - truth) / sigma";
  panel.y_label = "share below";
  panel.series = {distribution("recovered", s.pulls)};
  Series normal = curve("normal distribution", 6, Stroke::dashed);
  for (double x = -3.5; x <= 3.5; x += 0.1) {
    normal.x.push_back(x);
    normal.y.push_back(0.5 * std::erfc(-x / std::sqrt(2.0)));
  }
  panel.series.push_back(normal);
  if (s.pulls.empty()) panel.note = "nothing was named exactly";
  return svg_of(chart_of("Recovered parameters against the truth", 300.0, panel));
}

std::string time_svg(const std::vector<blind::TrialScore>& scores) {
  Panel panel;
  panel.x_label = "time [s]";
  panel.y_label = "share below";
  std::vector<double> seconds;
  for (const blind::TrialScore& t : scores) seconds.push_back(t.answer.seconds);
  panel.series = {distribution("trials", seconds)};
  return svg_of(chart_of("Time of a diagnosis", 260.0, panel));
}

}  // namespace

std::string to_text(const blind::Summary& summary, const std::vector<blind::TrialScore>& scores,
                    const Hashes& hashes) {
  std::string out;
  for (const Table& t : tables_of(summary)) out += text_of(t) + "\n";
  out +=
      text_of(misses_table(scores), 160) + "\n" + wrapped(times_text(summary), 100) + "\n";
  for (const std::string& line : headlines(summary, hashes)) out += wrapped(line, 100) + "\n";
  return out;
}

std::vector<std::string> write_report(const std::string& title, const blind::Summary& summary,
                                      const std::vector<blind::TrialScore>& scores,
                                      const Hashes& hashes, const std::string& folder) {
  const std::string power = power_svg(summary), confusion = confusion_svg(summary.confusion),
                    pulls = pulls_svg(summary), time = time_svg(scores);
  const std::vector<Table> tables = tables_of(summary);
  HtmlReport page{.title = title.empty() ? "Blind study" : title,
                  .subtitle = "Recordings with concealed effects, diagnosed without the key",
                  .headlines = headlines(summary, hashes),
                  .sections = {},
                  .footer = "driftscope blind"};
  page.sections = {
      {"Targets", {tables[0]}},
      {"Power and naming", {Picture{power, "Shares of single effects by size."}, tables[1]}},
      {"Groups", {tables[2]}},
      {"Further scores",
       {tables[3], Paragraph{times_text(summary)},
        Picture{pulls,
                "Distribution of the recovered parameters where the cause was named exactly."},
        Picture{time, "Distribution of the time of a diagnosis."}}},
      {"Confusion",
       {Picture{confusion, "Of all trials with this thing hidden, the share that got this answer."},
        tables[4]}},
      {"Trials that were answered wrong", {misses_table(scores)}}};
  return write_files({{"blind.json", to_json(summary, scores, hashes)},
                      {"power.svg", power},
                      {"confusion.svg", confusion},
                      {"pulls.svg", pulls},
                      {"time.svg", time},
                      {"report.html", to_html(page)}},
                     folder);
}

}  // namespace drift::report
