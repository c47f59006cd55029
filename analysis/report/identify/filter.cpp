#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/report/identify/sections.hpp"
#include "core/estimate/start_consistency.hpp"
#include "core/physics/parameters_config.hpp"
#include "core/physics/stochastic.hpp"
#include "core/stats/chi_square_band.hpp"

namespace drift::report {
namespace {

Cell status_cell(const EstimateResult& result) {
  switch (result.status) {
    case EstimateStatus::not_converged:
      return {"not converged", Tone::bad};
    case EstimateStatus::diverged:
      return {"diverged", Tone::bad};
    case EstimateStatus::ok:
      break;
  }
  return fit_cell(result);
}

Cell statistic_cell(const EstimateResult& result) {
  if (result.measured == 0) return "-";
  const double per_dof = result.statistic_per_dof();
  const bool fits = stats::chi_square_band(static_cast<double>(result.measured)).holds(per_dof);
  return digits(per_dof, 4, fits ? Tone::good : per_dof < 1.0 ? Tone::doubtful : Tone::bad);
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
std::string prior_text(const Layout& layout, std::string_view group) {
  std::vector<std::string> sigmas;
  for (const std::size_t k : library_order(layout)) {
    const auto& spec = TermLibrary::specs[layout.params[k]];
    if (spec.group.view() == group)
      sigmas.push_back(number_text(layout.sigma[k] / spec.unit.to_si));
  }
  if (std::ranges::count(sigmas, sigmas.front()) == std::ssize(sigmas)) sigmas.resize(1);
  return fmt::format("prior sigma {}", fmt::join(sigmas, ", "));
}

/// Term and group of parameters as headings: with the equation on a page, where units and priors
/// have columns of their own; with unit and prior on a terminal.
void add_headings(Table& table, const FilterView& v, std::size_t param, std::size_t before,
                  On where) {
  const auto& spec = TermLibrary::specs[param];
  const auto& owner = TermLibrary::owner(param);
  const bool first = before == TermLibrary::num_params,
             next_term = first || owner.key != TermLibrary::owner(before).key,
             next_group = first || spec.group.view() != TermLibrary::specs[before].group.view();
  if (where == On::page && next_term)
    table.add_heading(fmt::format("{}: {}", owner.key, owner.equation));
  if (where == On::terminal && next_group)
    table.add_heading(fmt::format("{}{} [{}], {}", next_term ? fmt::format("{}: ", owner.key) : "",
                                  spec.group.view(), spec.unit.symbol.view(),
                                  prior_text(v.summary.layout, spec.group.view())));
}

/// In which parameter EKF and batch fit of the start that counts differ most, by how much, and
/// which counts; empty if a sigma is 0 everywhere.
std::string furthest_apart(const FilterView& v) {
  const identification::FilterRun& counted = v.id.counted(v.summary);
  std::size_t param = TermLibrary::num_params;
  double most = 0.0;  // [batch sigma]
  for (std::size_t k = 0; k < v.summary.layout.size(); ++k) {
    const ParameterEstimate &ekf = counted.ekf.parameters[k],
                            &batch = counted.batch.estimate.parameters[k];
    const double apart = std::abs(ekf.value - batch.value) / batch.sigma;
    if (!(apart > most) || !std::isfinite(apart)) continue;
    most = apart;
    param = v.summary.layout.params[k];
  }
  if (param == TermLibrary::num_params) return "";
  return fmt::format(" EKF {} and batch are furthest apart in {}, by {:.2g} sigma; {}.",
                     counted.start + 1, parameter_key(param), most,
                     drift_varies(v.spec())
                         ? "the EKF counts: the batch fit knows no drift that varies"
                         : "the batch fit counts: it is iterated, the EKF passes once");
}

/// Truth, prior, EKF (of so many starts) and batch estimates, learning ratio and start consistency
/// of every parameter, grouped by term.
Table estimate_table(const FilterView& v, On where, std::size_t starts) {
  auto runs = v.id.runs_of(v.summary.filter);
  const std::size_t all = runs.size();
  const identification::FilterRun& counted = v.id.counted(v.summary);
  if (v.summary.counted_start >= starts) runs[starts - 1] = &counted;  // shown beside the first
  runs.resize(std::min(starts, all));
  Table table(
      fmt::format("Estimates of filter {}", v.spec().name),
      where == On::page ? "< | <unit | prior sigma" : "<",
      fmt::format(
          "Values ± 1 sigma{}; batch: from start {}. left: posterior / prior sigma of {}, 1 = "
          "nothing learned. {}wrong: by more than 5 sigma of the truth.{}",
          runs.size() < all ? fmt::format(", {} of {} starts shown", runs.size(), all) : "",
          counted.start + 1,
          drift_varies(v.spec()) ? fmt::format("EKF {}", counted.start + 1) : "the batch fit",
          all < 2 ? ""
                  : fmt::format("ratio: standard deviation between the EKF's {} starts / "
                                "RMS of their sigmas. ",
                                all),
          furthest_apart(v)));
  if (v.id.truth) table.add_columns("truth");
  for (const identification::FilterRun* run : runs)
    table.add_columns(fmt::format("EKF {}", run->start + 1));
  table.add_columns("batch | left | ratio | <verdict");
  std::size_t before = TermLibrary::num_params;
  for (const std::size_t k : library_order(v.summary.layout)) {
    const std::size_t param = v.summary.layout.params[k];
    const double unit = unit_of(param), ratio = v.summary.spread[k].ekf;
    add_headings(table, v, param, before, where);
    before = param;
    std::vector<Cell> cells{parameter_key(param)};
    if (where == On::page)
      cells.insert(cells.end(), {parameter_unit(param), v.summary.layout.sigma[k] / unit});
    const ParameterEstimate& batch = counted.batch.estimate.parameters[k];
    if (v.id.truth)
      cells.emplace_back(to_match(v.id.truth->theta[param] / unit, batch.sigma / unit));
    for (const identification::FilterRun* run : runs) {
      const ParameterEstimate& p = run->ekf.parameters[k];
      cells.push_back(plus_minus(p.value / unit, p.sigma / unit));
    }
    const double left = judged(v).parameters[k].learning_ratio();
    cells.insert(cells.end(), {plus_minus(batch.value / unit, batch.sigma / unit),
                               Cell(left, left < 0.0005 ? "<.001" : decimal_text(left, 3)),
                               decimals(ratio, 2), verdict_cell(verdict_of(v, k))});
    table.add(std::move(cells));
  }
  return table;
}

}  // namespace

Cell fit_cell(const EstimateResult& result) {
  if (misfit(result)) return {"misfit", Tone::bad};
  if (less_noise(result)) return {"less noise", Tone::doubtful};
  if (result.measured == 0 || stats::chi_square_band(static_cast<double>(result.measured))
                                  .holds(result.statistic_per_dof()))
    return {"ok"};
  return {"outside the band", Tone::doubtful};
}

Cell verdict_cell(double ratio) {
  if (!std::isfinite(ratio)) return "-";
  switch (start_verdict(ratio)) {
    case StartVerdict::consistent:
      return "starts agree";
    case StartVerdict::doubtful:
      return {"doubtful", Tone::doubtful};
    case StartVerdict::depends_on_start:
      break;
  }
  return {"depends on start", Tone::bad};
}

Section filter_model(const FilterView& v) {
  const std::string title = "Filter " + v.name(),
                    equation = fmt::format("equation: {}", equation_of(v.spec().coupling)),
                    terms = fmt::format("terms: {}", term_keys(v.spec().model().terms));
  return {title,
          {{Sentences{{equation, terms}}, On::page},
           {Sentences{{title, equation, terms}, ""}, On::terminal}}};
}

/// Of every start: status, and EKF NIS per degree of freedom and batch cost per degree of freedom
/// with the 95 % band a right model would be in.
Section fits(const FilterView& v) {
  Table table(
      fmt::format("Fit of filter {}", v.spec().name),
      "<start | <EKF | NIS/m | 95 % band | <batch | cost/m | 95 % band | iterations",
      "NIS/m and cost/m: chi-square over its m degrees of freedom, 1 if model, noise and "
      "priors are right; 95 % band by Wilson-Hilferty, which one right model in 20 is "
      "outside; misfit: above 1 by more than 5 sigma; less noise: below 1 by as much (either: "
      "one in 1.7 million), so that the estimates stand and their sigmas are too wide.");
  for (const identification::FilterRun* run : v.id.runs_of(v.summary.filter)) {
    const EstimateResult& batch = run->batch.estimate;
    table.add({run->start + 1, status_cell(run->ekf), statistic_cell(run->ekf), band_text(run->ekf),
               status_cell(batch), statistic_cell(batch), band_text(batch), batch.iterations});
    for (const EstimateResult* result : {&run->ekf, &batch})
      if (!result->cause.empty())
        table.add_heading(fmt::format("start {}: {}", run->start + 1, result->cause));
  }
  return {"", {table}};
}

/// On a terminal with as many starts as fit.
Section estimates(const FilterView& v) {
  std::size_t starts = 3;
  while (starts > 1 && text_width(estimate_table(v, On::terminal, starts)) > 100) --starts;
  return {"",
          {{estimate_table(v, On::terminal, starts), On::terminal},
           {estimate_table(v, On::page, 6), On::page}}};
}

/// What the test does not see under this filter.
Section unseen(const FilterView& v) {
  const identification::FilterSummary& s = v.summary;
  const std::string title = fmt::format("Directions in parameter space that filter {} does not see",
                                        v.spec().name),
                    better = fmt::format("{} known better from the prior than from the data",
                                         s.weak == 1 ? "is" : "are");
  if (s.unseen.empty())
    return {"",
            {Paragraph{fmt::format("{}: none of {}.{}", title, s.layout.size(),
                                   s.weak == 0 ? "" : fmt::format(" {} {}.", s.weak, better))}}};
  Table table =
      direction_table(fmt::format("{}: of {}, {}. {} (with these) {}", title, s.layout.size(),
                                  unseen_text(s.unseen, root_of(v)), s.weak, better));
  add_directions(table, unseen_directions(v));
  return {"", {table}};
}

}  // namespace drift::report
