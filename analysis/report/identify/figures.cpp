#include <algorithm>
#include <cmath>

#include "analysis/report/identify/sections.hpp"
#include "analysis/report/page/escape.hpp"
#include "analysis/report/svg/curve.hpp"
#include "analysis/report/svg/svg_canvas.hpp"
#include "analysis/report/svg/zoomable.hpp"
#include "core/base/units.hpp"
#include "core/stats/chi_square_band.hpp"

namespace drift::report {
namespace {

constexpr std::size_t most_highlighted = 6;

template <class T>
void add_once(std::vector<T>& all, const T& value) {
  if (std::ranges::find(all, value) == all.end()) all.push_back(value);
}

bool estimated(const identification::Identification& id, std::size_t param) {
  return std::ranges::any_of(id.summaries, [&](const identification::FilterSummary& s) {
    return std::ranges::find(s.layout.params, param) != s.layout.params.end();
  });
}

std::string start_label(std::size_t start) {
  return fmt::format("start {}", start + 1);
}

/// One parameter from one start. Where the filter has stopped, its history is empty: a gap.
Series estimate_series(const identification::FilterRun& run, std::size_t k, double unit) {
  Series s =
      curve(start_label(run.start), run.start, run.start < 7 ? Stroke::solid : Stroke::dashed);
  for (std::size_t i = 0; i < run.history.t.size(); ++i) {
    const double sigma = run.history.sigma(k, i);
    const bool there = sigma > 0.0;
    s.x.push_back(run.history.t[i] / unit::hour.to_si);
    s.y.push_back(there ? run.history.estimate(k, i) / unit : std::nan(""));
    s.sigma.push_back(there ? sigma / unit : std::nan(""));
  }
  return s;
}

/// Truth and independent tests; equal values share a line.
std::vector<ReferenceLine> references(const mc::Study& study,
                                      const identification::Identification& id, std::size_t param) {
  const double unit = unit_of(param);
  std::vector<ReferenceLine> lines;
  const auto add = [&](double value, const std::string& label) {
    for (ReferenceLine& line : lines)
      if (std::abs(line.y - value) <= 1e-9 * std::abs(value)) {
        line.label += ", " + label;
        return;
      }
    lines.push_back({value, label, lines.empty() ? Stroke::dashed : Stroke::dotted});
  };
  if (id.truth && !std::isnan(id.truth->theta[param])) add(id.truth->theta[param] / unit, "truth");
  for (const mc::Published& p : study.published)
    for (const auto& v : p.values)
      if (p.filter.empty() && v.param == param && !v.values.empty())
        add(v.values.front() / unit, p.name);
  return lines;
}

/// The whole range, unless the first swing would press everything after it into a line.
Range shown_range(const Panel& panel) {
  Range all, late;
  for (const Series& s : panel.series) {
    all.include(s.y);
    if (s.y.empty()) continue;
    for (std::size_t i = s.y.size() / 10; i < s.y.size(); ++i) late.include(s.y[i]);
    late.include(s.y.back() - s.sigma.back());
    late.include(s.y.back() + s.sigma.back());
  }
  for (const ReferenceLine& r : panel.references)
    if (!all.empty()) late.include(r.y);
  if (late.empty()) return all;
  const double room = 0.25 * late.width();
  const Range wide{late.low - room, late.high + room};
  all.include(late.low);
  all.include(late.high);
  return all.width() <= 2.5 * late.width() ? all : wide;
}

Panel estimate_panel(const FilterView& v, std::size_t param) {
  Panel panel;
  panel.title = fmt::format("{}: {}", v.name(), parameter_key(param));
  panel.x_label = "time [h]";
  panel.y_label = parameter_cell(param).text;
  const auto at = std::ranges::find(v.summary.layout.params, param);
  if (at == v.summary.layout.params.end()) {
    panel.note = "not estimated by this filter";
    return panel;
  }
  const auto k = static_cast<std::size_t>(at - v.summary.layout.params.begin());
  for (const identification::FilterRun* run : v.id.runs_of(v.summary.filter))
    panel.series.push_back(estimate_series(*run, k, unit_of(param)));
  panel.references = references(v.study, v.id, param);
  if (const Range r = shown_range(panel); !r.empty()) panel.y_range = r;
  return panel;
}

/// When the positions of one recording begin, but for the first [h].
std::vector<double> position_begins(const identification::Identification& id) {
  if (id.recordings.empty()) return {};
  const Recording& recording = id.recordings.front();
  const Channel *position = recording.find("position"), *time = recording.find("time");
  std::vector<double> begins;
  if (position == nullptr || time == nullptr || id.sources.size() > 1) return begins;
  for (std::size_t i = 1; i < position->values.size(); ++i)
    if (position->values[i] != position->values[i - 1])
      begins.push_back(time->values[i - 1] / unit::hour.to_si);
  return begins;
}

/// NIS per scalar, averaged over stretches so that at most about 100 points stay readable.
Panel nis_panel(const FilterView& v) {
  Panel panel;
  panel.title = v.name();
  panel.x_label = "time [h]";
  panel.y_label = "NIS per measured scalar";
  panel.marks = position_begins(v.id);
  for (const identification::FilterRun* run : v.id.runs_of(v.summary.filter)) {
    const EkfHistory& h = run->history;
    const std::size_t stretch = std::max<std::size_t>(1, h.t.size() / 100);
    Series s = curve(start_label(run->start), run->start);
    ExpectedBand band{"95 % band of a right model", {}, {}, {}};
    for (std::size_t begin = 0; begin < h.t.size(); begin += stretch) {
      const std::size_t end = std::min(begin + stretch, h.t.size());
      double nis = 0.0, scalars = 0.0;
      for (std::size_t i = begin; i < end; ++i) {
        nis += h.nis[i];
        scalars += h.scalars[i];
      }
      const stats::Band expected =
          scalars > 0.0 ? stats::chi_square_band(scalars) : stats::Band{std::nan(""), std::nan("")};
      s.x.push_back(0.5 * (h.t[begin] + h.t[end - 1]) / unit::hour.to_si);
      s.y.push_back(scalars > 0.0 ? nis / scalars : std::nan(""));
      band.x.push_back(s.x.back());
      band.low.push_back(expected.low);
      band.high.push_back(expected.high);
    }
    panel.series.push_back(std::move(s));
    if (panel.expected.empty()) panel.expected.push_back(std::move(band));
  }
  return panel;
}

}  // namespace

std::vector<std::size_t> highlighted_parameters(const mc::Study& study,
                                                const identification::Identification& id) {
  std::vector<std::size_t> params;
  for (const mc::Published& p : study.published)
    for (const auto& v : p.values)
      if (estimated(id, v.param)) add_once(params, v.param);
  if (!params.empty()) return params;

  constexpr std::string_view prefix = "truth.parameters.";
  for (const mc::Resolved& r : study.resolved) {
    if (!id.simulated || !r.key.starts_with(prefix) || r.origin.starts_with("default")) continue;
    const auto param = TermLibrary::find(std::string_view(r.key).substr(prefix.size()));
    if (param && estimated(id, *param) && params.size() < most_highlighted)
      add_once(params, *param);
  }
  if (!params.empty()) return params;

  std::vector<identification::StartSpread> spread;
  for (const identification::FilterSummary& s : id.summaries)
    spread.insert(spread.end(), s.spread.begin(), s.spread.end());
  const auto size = [](const identification::StartSpread& s) {
    return std::isfinite(s.ekf) ? s.ekf : -1.0;
  };
  std::ranges::stable_sort(spread, std::greater{}, size);
  for (const identification::StartSpread& s : spread)
    if (params.size() < 3) add_once(params, s.param);
  return params;
}

Section estimate_figures(const mc::Study& study, const identification::Identification& id) {
  const std::vector<std::size_t> params = highlighted_parameters(study, id);
  if (params.empty()) return {};
  Chart combined{"Estimates against time", {}, std::min<std::size_t>(params.size(), 3)};
  Chart nis{"Normalised innovations squared",
            {},
            std::min<std::size_t>(id.summaries.size(), 2),
            half_sheet,
            260.0};
  Blocks alone;
  std::vector<std::string> taken;
  for (const identification::FilterSummary& s : id.summaries) {
    const FilterView view{study, id, s};
    const std::string& name = view.spec().name;
    Chart chart{
        fmt::format("Estimates of filter {}", name), {}, std::min<std::size_t>(params.size(), 3)};
    for (const std::size_t p : params) chart.panels.push_back(estimate_panel(view, p));
    combined.panels.insert(combined.panels.end(), chart.panels.begin(), chart.panels.end());
    nis.panels.push_back(nis_panel(view));
    std::string part = file_name_part(name);
    if (std::ranges::find(taken, part) != taken.end()) part += fmt::format("_{}", s.filter + 1);
    taken.push_back(part);
    alone.push_back({Figure{svg_of(chart), "", fmt::format("figure_{}.svg", part)}, On::neither});
  }
  Section section{"Estimates against time",
                  {zoomable(combined,
                            "Estimates against time, each start with its 1 sigma band. The first "
                            "swing may be cut off.",
                            "estimates.svg")}};
  section.add(std::move(alone));
  section.add({zoomable(nis,
                        "Normalised innovations squared per measured scalar, averaged over short "
                        "stretches: 1 on average, and mostly within the grey band, if model and "
                        "noise are right. Dotted: a position begins.",
                        "nis.svg")});
  return section;
}

}  // namespace drift::report
