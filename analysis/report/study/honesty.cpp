#include <cmath>

#include "analysis/report/study/sections.hpp"
#include "analysis/report/svg/curve.hpp"
#include "analysis/report/svg/svg_canvas.hpp"
#include "analysis/report/svg/zoomable.hpp"

namespace drift::report {
namespace {

using mc::DistributionBins;

constexpr double bin_percent = 100.0 / static_cast<double>(DistributionBins::size);

/// Shares of runs in bins of equal probability, as steps, with where 95 % of the bins of an honest
/// filter are.
Panel histogram_panel(const DistributionBins& bins, std::string title) {
  Panel panel;
  panel.title = std::move(title);
  panel.x_label = "place in its chi-square [%]";
  panel.y_label = "runs [%]";
  if (bins.total() == 0) {
    panel.note = "no estimates";
    return panel;
  }
  Series steps = curve("runs in a bin", 2);
  double most = 2.5 * bin_percent;
  for (std::size_t b = 0; b < DistributionBins::size; ++b)
    for (const std::size_t edge : {b, b + 1}) {
      steps.x.push_back(bin_percent * static_cast<double>(edge));
      steps.y.push_back(100.0 * bins.in(b).value());
      steps.low.push_back(0.0);
      steps.high.push_back(steps.y.back());
      most = std::max(most, 1.1 * steps.y.back());
    }
  const double share = 0.01 * bin_percent;
  const double half = 100.0 * stats::half_width_95 *
                      std::sqrt(share * (1.0 - share) / static_cast<double>(bins.total()));
  const double low = std::max(0.0, bin_percent - half), high = bin_percent + half;
  panel.expected.push_back({"95 % of an honest filter", {0.0, 100.0}, {low, low}, {high, high}});
  panel.y_range = Range{0.0, std::min(most, 100.0)};
  panel.series.push_back(std::move(steps));
  return panel;
}

/// Share of the errors within as many sigmas as should hold that share.
Series coverage_curve(const mc::FilterStatistics& f, const std::vector<std::size_t>& states,
                      Series s) {
  s.x.push_back(0.0);
  s.y.push_back(0.0);
  for (std::size_t b = 0; b < DistributionBins::size; ++b) {
    double sum = 0.0;
    for (const std::size_t k : states) sum += f.errors()[k].magnitudes().up_to(b).value();
    s.x.push_back(bin_percent * static_cast<double>(b + 1));
    s.y.push_back(100.0 * sum / static_cast<double>(states.size()));
  }
  return s;
}

Panel coverage_panel(const mc::FilterStatistics& f, double claims) {
  std::vector<std::size_t> states;
  for (std::size_t k = 0; k < f.errors().size(); ++k)
    if (f.errors()[k].learning() < claims && f.errors()[k].magnitudes().total() > 0)
      states.push_back(k);
  Panel panel;
  panel.x_label = "expected within an interval [%]";
  panel.y_label = "found [%]";
  if (states.empty()) {
    panel.title = "Coverage";
    panel.note = "claims to know no parameter";
    return panel;
  }
  const std::size_t found = worst_parameter(f, claims);  // none where no error is above zero
  const std::size_t worst = found < f.errors().size() ? found : states.front();
  panel.title = fmt::format("Coverage; worst {}", key_at(f, worst));
  ExpectedBand band{"95 % of an honest filter", {}, {}, {}};
  const double n = static_cast<double>(f.errors()[worst].magnitudes().total());
  for (double p = 0.0; p <= 1.0001; p += 0.01) {
    const double half = stats::half_width_95 * std::sqrt(std::max(0.0, p * (1.0 - p)) / n);
    band.x.push_back(100.0 * p);
    band.low.push_back(100.0 * (p - half));
    band.high.push_back(100.0 * (p + half));
  }
  panel.expected.push_back(std::move(band));
  panel.series.push_back(
      coverage_curve(f, states, curve("mean of what it claims to know", 0, Stroke::solid)));
  panel.series.push_back(coverage_curve(f, {worst}, curve("worst parameter", 1, Stroke::dashed)));
  panel.y_range = Range{0.0, 100.0};
  return panel;
}

/// What is seen of one filter, in words.
std::string said_of(const StudyResults& results, const Pair& pair) {
  const mc::FilterStatistics& f = statistics_of(results, pair);
  const mc::StartStatistics& s = f.starts().front();
  const auto ends = [](const DistributionBins& bins) {
    return fmt::format("{} % lowest, {} % highest", percent_cell(bins.in(0).value()).text,
                       percent_cell(bins.in(DistributionBins::size - 1).value()).text);
  };
  if (s.nis.place.total() == 0) return fmt::format("{}: no estimates.", f.columns().name);
  return fmt::format(
      "{}, filter {}: NIS in the outermost bins {}; NEES {}; within 2 sigma {} % of the errors "
      "(95.4 expected).",
      name_of(results, pair.point), f.columns().name, ends(s.nis.place), ends(s.nees.place),
      percent_cell(coverage_of_claims(f, claims_of(results))).text);
}

constexpr const char* how_to_read =
    "Left and middle: every run's NIS (of the data) and NEES (of what is observed of the "
    "parameters) by its place in the chi-square of its degrees of freedom: level at 5 % of the "
    "runs if the filter is honest, piled up at the right if its sigmas are too small, at the left "
    "if too large. Right: how many errors an interval holds against how many it should; below the "
    "band sigmas are too small.";

}  // namespace

/// NIS and NEES of the runs in their chi-square, and how often intervals hold the truth.
Section honesty(const StudyResults& results) {
  Section section{"Does a filter know how well it does?", {}, On::page};
  for (const std::size_t p : pictured_points(results)) {
    Chart chart{name_of(results, p), {}, 3};
    Sentences said;
    for (std::size_t f = 0; f < results.statistics[p].filters().size(); ++f) {
      const mc::FilterStatistics& filter = results.statistics[p].filters()[f];
      const mc::StartStatistics& s = filter.starts().front();
      const std::string& name = filter.columns().name;
      chart.panels.push_back(histogram_panel(s.nis.place, name + ": NIS of a run"));
      chart.panels.push_back(histogram_panel(s.nees.place, name + ": NEES of a run"));
      chart.panels.push_back(coverage_panel(filter, claims_of(results)));
      said.items.push_back(said_of(results, {p, f}));
    }
    section.add({figure_of(chart, section.blocks.empty() ? how_to_read : ""), std::move(said)});
  }
  return section;
}

/// The silent failure rate as more and more runs came in.
Section rate_course(const StudyResults& results) {
  Chart chart{"Silent failures against the number of runs", {}, 2, half_sheet, 250.0};
  Sentences said;
  for (const std::size_t p : pictured_points(results)) {
    Panel panel;
    panel.title = name_of(results, p);
    panel.x_label = "runs (logarithmic)";
    panel.y_label = "silent failures [%]";
    panel.x_spacing = Spacing::logarithmic;
    for (const mc::FilterStatistics& f : results.statistics[p].filters()) {
      const mc::StartStatistics& start = f.starts().front();
      const Stroke stroke = panel.series.size() % 2 == 0 ? Stroke::solid : Stroke::dashed;
      Series s = curve(f.columns().name, panel.series.size(), stroke);
      const auto add = [&](const stats::Rate& rate) {
        if (rate.of == 0 || (!s.x.empty() && s.x.back() == static_cast<double>(rate.of))) return;
        s.x.push_back(static_cast<double>(rate.of));
        s.y.push_back(100.0 * rate.value());
        s.low.push_back(100.0 * rate.low());
        s.high.push_back(100.0 * rate.high());
      };
      for (const stats::Rate& rate : start.silent_course.steps()) add(rate);
      add(start.silent);
      panel.series.push_back(std::move(s));
      said.items.push_back(fmt::format("{}, filter {}: {} after {} run{}.", name_of(results, p),
                                       f.columns().name, rate_cell(start.silent).text,
                                       start.silent.of, plural(start.silent.of)));
    }
    chart.panels.push_back(std::move(panel));
  }
  if (chart.panels.empty()) return {};
  if (const std::string rest = not_pictured_text(results); !rest.empty())
    said.items.push_back(rest);
  return {
      "Are these runs enough?",
      {figure_of(chart,
                 "The silent failure rate of the first 1, 2, 3, ... runs with its 95 % interval, "
                 "start 1 of every filter. It is known when the interval is as narrow as asked "
                 "for and later rates stay inside earlier intervals."),
       std::move(said)},
      On::page};
}

}  // namespace drift::report
