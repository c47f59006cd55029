#include "analysis/report/identify/published_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/number_text.hpp"
#include "core/estimate/start_consistency.hpp"

namespace drift::report {
namespace {

/// One row: the same parameter from several starts, in SI.
struct Runs {
  std::string source;
  std::vector<double> values, sigmas;
};

Runs our_runs(const identification::Identification& id, std::size_t filter, std::size_t param,
              const EstimateResult& (*result)(const identification::FilterRun&),
              std::string source) {
  Runs runs{std::move(source), {}, {}};
  for (const identification::FilterRun* run : id.runs_of(filter))
    if (const ParameterEstimate* p = result(*run).find(param)) {
      runs.values.push_back(p->value);
      runs.sigmas.push_back(p->sigma);
    }
  return runs;
}

void add_row(Table& table, std::size_t starts, const Unit& unit, const Runs& runs,
             std::string (*text)(double, double)) {
  std::vector<Cell> cells{Cell(runs.source)};
  const bool with_sigmas = runs.sigmas.size() == runs.values.size() && !runs.sigmas.empty();
  for (std::size_t k = 0; k < starts; ++k)
    cells.emplace_back(k >= runs.values.size() ? ""
                       : with_sigmas
                           ? text(runs.values[k] / unit.to_si, runs.sigmas[k] / unit.to_si)
                           : number_text(runs.values[k] / unit.to_si, 5));
  const bool several = with_sigmas && runs.values.size() > 1;
  const double ratio = several ? start_consistency(runs.values, runs.sigmas) : std::nan("");
  cells.emplace_back(several ? decimal_text(ratio, 2) : "");
  cells.push_back(several ? verdict_cell(ratio) : Cell());
  table.add(std::move(cells));
}

/// Names are free text; a long one would push the numbers off the page.
std::string short_name(const mc::Published& published) {
  return published.name.size() <= 24 ? published.name
         : published.filter.empty()  ? "independent test"
                                     : "published";
}

const EstimateResult& ekf_of(const identification::FilterRun& run) {
  return run.ekf;
}
const EstimateResult& batch_of(const identification::FilterRun& run) {
  return run.batch.estimate;
}

/// A published set beside the runs of a filter; no filter: beside nothing of ours.
Table compare(const mc::Study& study, const identification::Identification& id,
              const mc::Published& published, std::optional<std::size_t> filter) {
  std::size_t starts = filter ? id.runs_of(*filter).size() : 0;
  for (const auto& v : published.values) starts = std::max(starts, v.values.size());
  starts = std::min<std::size_t>(starts, 3);

  Table table;
  table.title = fmt::format("{} beside this run, filter {}", published.name,
                            filter ? study.filters[*filter].name : published.filter);
  table.columns = {{"source", Align::left}};
  for (std::size_t k = 0; k < starts; ++k)
    table.columns.push_back({fmt::format("start {}", k + 1)});
  table.columns.push_back({"ratio"});
  table.columns.push_back({"verdict", Align::left});
  for (const mc::Published::Value& v : published.values) {
    const auto& spec = TermLibrary::specs[v.param];
    const auto add = [&](const Runs& runs, std::string (*text)(double, double) = as_given) {
      if (!runs.values.empty()) add_row(table, starts, spec.unit, runs, text);
    };
    table.add_heading(fmt::format("{} [{}]", spec.key.view(), spec.unit.symbol.view()));
    add({short_name(published), v.values, v.sigmas});
    if (filter) {
      add(our_runs(id, *filter, v.param, ekf_of, "this run, EKF"), with_sigma);
      add(our_runs(id, *filter, v.param, batch_of, "this run, batch"), with_sigma);
    }
    if (id.truth) add({"truth of this run", {id.truth->theta[v.param]}, {}});
    for (const mc::Published& test : study.published)
      if (test.filter.empty() && &test != &published)
        for (const mc::Published::Value& other : test.values)
          if (other.param == v.param) add({short_name(test), other.values, other.sigmas});
  }
  table.note =
      "ratio: standard deviation between all starts / RMS of their sigmas; up to 2 consistent, "
      "above 5 "
      "the answer depends on the start and its sigma says nothing of its error.";
  return table;
}

}  // namespace

Cell verdict_cell(double ratio) {
  if (!std::isfinite(ratio)) return {"-"};
  switch (start_verdict(ratio)) {
    case StartVerdict::consistent:
      return {"starts agree", Tone::plain};
    case StartVerdict::doubtful:
      return {"doubtful", Tone::doubtful};
    case StartVerdict::depends_on_start:
      break;
  }
  return {"depends on start", Tone::bad};
}

std::vector<Table> published_comparison(const mc::Study& study,
                                        const identification::Identification& id) {
  std::vector<Table> tables;
  std::vector<bool> compared(study.filters.size(), false);
  for (const mc::Published& p : study.published) {
    if (p.filter.empty()) continue;
    std::optional<std::size_t> filter;
    for (std::size_t f = 0; f < study.filters.size(); ++f)
      if (study.filters[f].name == p.filter) filter = f;
    if (filter) compared[*filter] = true;
    tables.push_back(compare(study, id, p, filter));
  }
  for (const mc::Published& p : study.published)
    for (std::size_t f = 0; f < study.filters.size(); ++f)
      if (p.filter.empty() && !compared[f]) tables.push_back(compare(study, id, p, f));
  return tables;
}

}  // namespace drift::report
