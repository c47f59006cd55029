#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "analysis/report/page/swept_value.hpp"
#include "analysis/report/study/sections.hpp"
#include "analysis/report/svg/curve.hpp"
#include "analysis/report/svg/svg_canvas.hpp"
#include "analysis/report/svg/zoomable.hpp"

namespace drift::report {
namespace {

using mc::FilterStatistics;

/// One statistic as a number with an interval, in the unit of its panel.
struct Statistic {
  std::string title, y_label;
  std::function<mc::Estimated(const FilterStatistics&)> value;
};

mc::Estimated percent(const stats::Rate& r) {
  return {100.0 * r.value(), 100.0 * r.low(), 100.0 * r.high()};
}

std::vector<Statistic> statistics(double claims) {
  return {{"Silent failures", "runs [%]",
           [](const FilterStatistics& f) { return percent(f.starts().front().silent); }},
          {"Wrong runs", "runs [%]",
           [](const FilterStatistics& f) { return percent(f.starts().front().wrong); }},
          {"Runs that look healthy", "runs [%]",
           [](const FilterStatistics& f) { return percent(f.starts().front().healthy); }},
          {"Worst deception", "log10 RMSE / sigma", [claims](const FilterStatistics& f) {
             const std::size_t k = worst_parameter(f, claims);
             if (k == f.errors().size())
               return mc::Estimated{std::nan(""), std::nan(""), std::nan("")};
             const mc::Estimated d = f.errors()[k].deception();
             return mc::Estimated{std::log10(d.value), std::log10(d.low), std::log10(d.high)};
           }}};
}

/// The other axes of a point, and its truth: curves are told apart by these and the filter.
std::string curve_label(const StudyResults& results, const Pair& pair, std::size_t axis) {
  const mc::StudyPoint& point = results.points[pair.point];
  std::string label = fmt::format("{} > {}", key_of(point.study.truth.coupling),
                                  statistics_of(results, pair).columns().name);
  for (std::size_t a = 0; a < point.values.size(); ++a)
    if (a != axis && point.values[a].first != "truth.coupling")
      label += ", " + short_value(point.values[a].second);
  return label;
}

Panel panel_of(const StudyResults& results, const Statistic& statistic, std::size_t axis,
               const std::vector<SweptNumber>& at) {
  struct Sample {
    double x;
    mc::Estimated y;
  };
  std::map<std::string, std::vector<Sample>> curves;
  for (const Pair& pair : pairs_of(results))
    curves[curve_label(results, pair, axis)].push_back(
        {at[pair.point].si / at.front().unit.to_si, statistic.value(statistics_of(results, pair))});
  Panel panel;
  panel.title = statistic.title;
  const auto& [key, value] = results.points.front().values[axis];
  const std::string member = last_member(value), &what = at.front().what;
  panel.x_label = fmt::format("{}{}{}{}{} [{}]", key, member.empty() ? "" : ": ", member,
                              what.empty() ? "" : ", ", what, at.front().unit.symbol.view());
  panel.y_label = statistic.y_label;
  for (auto& [label, samples] : curves) {
    std::ranges::stable_sort(samples, {}, &Sample::x);
    Series s =
        curve(label, panel.series.size(), panel.series.size() < 7 ? Stroke::solid : Stroke::dashed);
    for (const Sample& sample : samples) {
      s.x.push_back(sample.x);
      s.y.push_back(sample.y.value);
      s.low.push_back(sample.y.low);
      s.high.push_back(sample.y.high);
    }
    panel.series.push_back(std::move(s));
  }
  return panel;
}

/// Whether numbers tell the values of an axis apart: they are alike in all but the number, and
/// other values have other ones.
bool stand_for(const std::vector<SweptNumber>& at, const StudyResults& results, std::size_t axis) {
  if (at.size() != results.points.size()) return false;
  std::map<double, std::string> texts;
  bool varies = false;
  for (std::size_t p = 0; p < at.size(); ++p) {
    const SweptNumber& n = at[p];
    if (!n.unit.same_dimension(at.front().unit) || n.kind != at.front().kind) return false;
    varies = varies || n.si != at.front().si;
    const std::string text = short_value(results.points[p].values[axis].second);
    if (texts.emplace(n.si, text).first->second != text) return false;
  }
  return varies;
}

}  // namespace

/// Statistics against the swept value, one picture for each axis whose values are numbers that mean
/// the same.
Section sweep(const StudyResults& results) {
  Section section{"Sweep", {}};
  const std::size_t axes = results.points.empty() ? 0 : results.points.front().values.size();
  for (std::size_t a = 0; a < axes; ++a) {
    std::vector<SweptNumber> at;
    for (const mc::StudyPoint& point : results.points)
      if (const auto number = swept_number(point.values[a].second)) at.push_back(*number);
    if (!stand_for(at, results, a)) continue;
    const std::string& key = results.points.front().values[a].first;
    Chart chart{fmt::format("Against {}", key), {}, 2, half_sheet, 270.0};
    for (const Statistic& s : statistics(claims_of(results)))
      chart.panels.push_back(panel_of(results, s, a, at));
    section.add({figure_of(
        chart, fmt::format("Statistics against {}, truth > filter, with 95 % intervals.", key))});
  }
  return section;
}

}  // namespace drift::report
