#include "analysis/report/identify/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/report/identify/published_table.hpp"
#include "analysis/report/page/degeneracies.hpp"
#include "analysis/report/svg/axis_scale.hpp"
#include "core/base/number_text.hpp"
#include "core/estimate/start_consistency.hpp"
#include "core/physics/coupling_text.hpp"
#include "core/stats/chi_square_band.hpp"

namespace drift::report {
namespace {

constexpr double nothing_learned = 0.95;  // posterior over prior sigma

std::string status_text(EstimateStatus status) {
  switch (status) {
    case EstimateStatus::ok:
      return "ok";
    case EstimateStatus::not_converged:
      return "not converged";
    case EstimateStatus::diverged:
      return "diverged";
  }
  return "";
}

/// Five sigma of chi-square over m, whose variance is 2/m: no right model does that.
bool misfit(const EstimateResult& result) {
  const double m = static_cast<double>(result.measured);
  return result.measured > 0 &&
         std::abs(result.statistic_per_dof() - 1.0) > 5.0 * std::sqrt(2.0 / m);
}

Cell status_cell(const EstimateResult& result) {
  if (result.status != EstimateStatus::ok) return {status_text(result.status), Tone::bad};
  return misfit(result) ? Cell{"misfit", Tone::bad} : Cell{"ok"};
}

Cell statistic_cell(const EstimateResult& result) {
  if (result.measured == 0) return {"-"};
  const double per_dof = result.statistic_per_dof();
  const bool fits = stats::chi_square_band(static_cast<double>(result.measured)).holds(per_dof);
  return {number_text(per_dof, 4), fits ? Tone::good : Tone::bad};
}

std::string band_text(const EstimateResult& result) {
  if (result.measured == 0) return "-";
  const stats::Band band = stats::chi_square_band(static_cast<double>(result.measured));
  return fmt::format("{:.3f} to {:.3f}", band.low, band.high);
}

/// States of a layout in library order: readout parameters may come after those of later terms.
std::vector<std::size_t> library_order(const Layout& layout) {
  std::vector<std::size_t> states(layout.size());
  std::iota(states.begin(), states.end(), std::size_t{0});
  std::ranges::sort(states, {}, [&](std::size_t k) { return layout.params[k]; });
  return states;
}

/// "prior sigma 2", or one for each parameter of the group if they differ.
std::string prior_text(const Layout& layout, const std::string_view group) {
  std::vector<std::string> sigmas;
  for (const std::size_t k : library_order(layout)) {
    const auto& spec = TermLibrary::specs[layout.params[k]];
    if (spec.group.view() == group)
      sigmas.push_back(number_text(layout.sigma[k] / spec.unit.to_si));
  }
  std::string text = "prior sigma " + sigmas.front();
  if (std::ranges::count(sigmas, sigmas.front()) != static_cast<std::ptrdiff_t>(sigmas.size()))
    for (std::size_t i = 1; i < sigmas.size(); ++i) text += ", " + sigmas[i];
  return text;
}

/// Parameters that the two estimators, given the same, see differently: further apart than five of
/// the smaller sigma, or with sigmas that differ threefold. Empty if one failed, or if the model is
/// wrong for both.
std::vector<std::string> disputed(const identification::FilterRun& run) {
  constexpr double apart = 5.0, unlike = 3.0;
  std::vector<std::string> keys;
  if (run.ekf.status != EstimateStatus::ok || run.batch.estimate.status != EstimateStatus::ok ||
      misfit(run.batch.estimate))
    return keys;
  for (std::size_t k = 0; k < run.ekf.parameters.size(); ++k) {
    const ParameterEstimate &e = run.ekf.parameters[k], &b = run.batch.estimate.parameters[k];
    const auto [less, more] = std::minmax(e.sigma, b.sigma);
    if (std::abs(e.value - b.value) > apart * less || more > unlike * less)
      keys.emplace_back(TermLibrary::specs[e.param].key.view());
  }
  return keys;
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const auto& t : texts) all += (all.empty() ? "" : ", ") + t;
  return all;
}

}  // namespace

std::vector<std::string> filter_lines(const FilterSpec& filter) {
  const DriftModel model = filter.model();
  return {fmt::format("Filter {} ({})", filter.name, key_of(filter.coupling)),
          fmt::format("equation: {}", equation_of(filter.coupling)),
          fmt::format("terms: {}", term_keys(model.terms))};
}

Table fit_table(const mc::Study& study, const identification::Identification& id,
                std::size_t filter) {
  Table table;
  table.title = fmt::format("Fit of filter {}", study.filters[filter].name);
  table.columns = {{"start", Align::left}, {"EKF", Align::left}, {"NIS/m"},     {"95 % band"},
                   {"batch", Align::left}, {"cost/m"},           {"95 % band"}, {"iterations"}};
  for (const identification::FilterRun* run : id.runs_of(filter)) {
    const EstimateResult& batch = run->batch.estimate;
    table.add({fmt::format("{}", run->start + 1), status_cell(run->ekf), statistic_cell(run->ekf),
               band_text(run->ekf), status_cell(batch), statistic_cell(batch), band_text(batch),
               fmt::format("{}", batch.iterations)});
    for (const EstimateResult* result : {&run->ekf, &batch})
      if (!result->cause.empty())
        table.add_heading(fmt::format("start {}: {}", run->start + 1, result->cause));
  }
  table.note =
      "NIS/m and cost/m: chi-square over its m degrees of freedom, 1 if model, noise and priors "
      "are "
      "right; 95 % band by Wilson-Hilferty.";
  return table;
}

Table estimate_table(const mc::Study& study, const identification::Identification& id,
                     std::size_t filter, const EstimateLayout& how) {
  const identification::FilterSummary& summary = id.summaries[filter];
  const auto runs = id.runs_of(filter);
  const std::size_t starts = std::min(how.starts, runs.size());
  Table table;
  table.title = fmt::format("Estimates of filter {}", study.filters[filter].name);
  table.columns = {{"", Align::left}};
  if (how.unit_columns)
    table.columns.insert(table.columns.end(), {{"unit", Align::left}, {"prior sigma"}});
  if (id.truth) table.columns.push_back({"truth"});
  for (std::size_t s = 0; s < starts; ++s) table.columns.push_back({fmt::format("EKF {}", s + 1)});
  for (const char* name : {"batch", "left", "ratio"}) table.columns.push_back({name});
  table.columns.push_back({"verdict", Align::left});

  std::string_view term, group;
  for (const std::size_t k : library_order(summary.layout)) {
    const std::size_t param = summary.layout.params[k];
    const auto& spec = TermLibrary::specs[param];
    const auto& owner = TermLibrary::owner(param);
    const double unit = spec.unit.to_si;
    if (how.unit_columns && owner.key != term)
      table.add_heading(fmt::format("{}: {}", owner.key, owner.equation));
    if (!how.unit_columns && spec.group.view() != group)
      table.add_heading(fmt::format("{}{} [{}], {}",
                                    owner.key != term ? fmt::format("{}: ", owner.key) : "",
                                    spec.group.view(), spec.unit.symbol.view(),
                                    prior_text(summary.layout, spec.group.view())));
    term = owner.key;
    group = spec.group.view();

    std::vector<Cell> cells{Cell(std::string(spec.key.view()))};
    if (how.unit_columns) {
      cells.emplace_back(std::string(spec.unit.symbol.view()));
      cells.emplace_back(number_text(summary.layout.sigma[k] / unit));
    }
    const ParameterEstimate& batch = runs.front()->batch.estimate.parameters[k];
    if (id.truth) cells.emplace_back(to_match(id.truth->theta[param] / unit, batch.sigma / unit));
    for (std::size_t s = 0; s < starts; ++s) {
      const ParameterEstimate& p = runs[s]->ekf.parameters[k];
      cells.emplace_back(with_sigma(p.value / unit, p.sigma / unit));
    }
    cells.emplace_back(with_sigma(batch.value / unit, batch.sigma / unit));
    const double left = batch.learning_ratio();
    cells.emplace_back(left < 0.0005 ? "<.001" : decimal_text(left, 3));
    cells.emplace_back(decimal_text(summary.spread[k].ekf, 2));
    const Cell verdict = verdict_cell(summary.spread[k].ekf);
    cells.push_back(left > nothing_learned && verdict.tone == Tone::good ? Cell("prior only")
                                                                         : verdict);
    table.add(std::move(cells));
  }
  table.note = fmt::format(
      "Values ± 1 sigma{}; batch: from start 1. left: posterior / prior sigma of the batch fit, 1 "
      "= nothing "
      "learned (prior only: agreeing starts mean nothing there). ratio: standard deviation between "
      "the EKF's "
      "{} starts / RMS of their sigmas.",
      starts < runs.size() ? fmt::format(", {} of {} starts shown", starts, runs.size()) : "",
      runs.size());
  return table;
}

Table degeneracy_table(const mc::Study& study, const identification::Identification& id,
                       std::size_t filter) {
  const identification::FilterSummary& summary = id.summaries[filter];
  const FilterSpec& spec = study.filters[filter];
  Table table;
  table.title = fmt::format(
      "Exact degeneracies of filter {}: {} of {} directions in parameter space change nothing that "
      "is "
      "measured. {} directions (with these) are known better from the prior than from the data",
      spec.name, summary.degeneracies.size(), summary.layout.size(), summary.weak);
  table.columns = {{"direction, each parameter in its unit", Align::left}, {"why", Align::left}};
  for (const NamedDirection& d :
       name_degeneracies(summary.layout, spec.mounting, summary.degeneracies))
    table.add({d.combination, d.reason});
  return table;
}

std::vector<std::string> headlines(const mc::Study& study,
                                   const identification::Identification& id) {
  std::vector<std::string> all;
  for (const identification::FilterSummary& s : id.summaries) {
    const std::string name = fmt::format("Filter {} ({})", study.filters[s.filter].name,
                                         key_of(study.filters[s.filter].coupling));
    const auto runs = id.runs_of(s.filter);
    std::size_t failed = 0, outside = 0;
    Range nis;
    for (const identification::FilterRun* run : runs) {
      failed +=
          run->ekf.status != EstimateStatus::ok || run->batch.estimate.status != EstimateStatus::ok;
      if (run->ekf.measured == 0) continue;
      nis.include(run->ekf.statistic_per_dof());
      outside += !stats::chi_square_band(static_cast<double>(run->ekf.measured))
                      .holds(run->ekf.statistic_per_dof());
    }
    std::vector<std::string> dependent;
    for (const identification::StartSpread& p : s.spread)
      if (start_verdict(p.ekf) == StartVerdict::depends_on_start)
        dependent.emplace_back(TermLibrary::specs[p.param].key.view());
    if (study.filters[s.filter].noise.any())
      all.push_back(fmt::format(
          "{}: declares process noise, which the batch fit does not model: its sigmas and "
          "`left` are too small; use the EKF's.",
          name));
    if (failed > 0)
      all.push_back(fmt::format("{}: {} of {} starts failed or did not converge.", name, failed,
                                runs.size()));
    if (runs.size() > 1)
      all.push_back(
          dependent.empty()
              ? fmt::format("{}: no parameter depends on the start.", name)
              : fmt::format("{}: {} of {} parameters depend on the start, their sigmas say nothing "
                            "of their errors: {}.",
                            name, dependent.size(), s.spread.size(), joined(dependent)));
    if (!nis.empty())
      all.push_back(fmt::format(
          "{}: EKF NIS/m {:.3f} to {:.3f}, {}.", name, nis.low, nis.high,
          outside == 0 ? "inside the 95 % band of a right model"
                       : fmt::format("outside the 95 % band of a right model from {} of {} "
                                     "starts",
                                     outside, runs.size())));
    // With process noise the two answer different questions.
    if (auto keys = disputed(*runs.front());
        !keys.empty() && !study.filters[s.filter].noise.any()) {
      constexpr std::size_t most = 8;
      const std::size_t count = keys.size();
      if (count > most) keys.resize(most);
      all.push_back(fmt::format(
          "{}: from start 1, EKF and batch fit are more than five sigma apart, or claim sigmas "
          "that differ "
          "threefold, in {} of {} parameters: {}{}. The EKF linearises once, where it is then; "
          "what is not linear over its prior leads it astray with a "
          "small sigma. Use the batch column.",
          name, count, s.spread.size(), joined(keys), count > most ? " and others" : ""));
    }
    if (!s.degeneracies.empty())
      all.push_back(fmt::format(
          "{}: {} combinations of its {} parameters cannot be seen in this test at all.", name,
          s.degeneracies.size(), s.layout.size()));
  }
  return all;
}

std::string source_line(const mc::Study& study, const identification::Identification& id) {
  if (!id.simulated) return fmt::format("Recording {}", joined(id.sources));
  return fmt::format("Simulated, truth {}: {}", key_of(study.truth.coupling),
                     equation_of(study.truth.coupling));
}

}  // namespace drift::report
