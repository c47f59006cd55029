#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/report/identify/sections.hpp"
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

void add_row(Table& table, std::size_t starts, double unit, const Runs& runs,
             std::string (*text)(double, double)) {
  std::vector<Cell> cells{runs.source};
  const bool with_sigmas = runs.sigmas.size() == runs.values.size() && !runs.sigmas.empty();
  for (std::size_t k = 0; k < starts; ++k) {
    if (k >= runs.values.size())
      cells.emplace_back();
    else if (with_sigmas)
      cells.emplace_back(runs.values[k] / unit, text(runs.values[k] / unit, runs.sigmas[k] / unit));
    else
      cells.push_back(digits(runs.values[k] / unit, 5));
  }
  const bool several = with_sigmas && runs.values.size() > 1;
  const double ratio = several ? start_consistency(runs.values, runs.sigmas) : std::nan("");
  cells.push_back(several ? decimals(ratio, 2) : Cell());
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

  Table table(fmt::format("{} beside this run, filter {}", published.name,
                          filter ? study.filters[*filter].name : published.filter),
              "<source",
              "ratio: standard deviation between all starts / RMS of their sigmas; up to 2 "
              "consistent, above 5 the answer depends on the start and its sigma says nothing of "
              "its error.");
  for (std::size_t k = 0; k < starts; ++k) table.add_columns(fmt::format("start {}", k + 1));
  table.add_columns("ratio | <verdict");
  for (const mc::Published::Value& v : published.values) {
    const auto add = [&](const Runs& runs, std::string (*text)(double, double) = as_given) {
      if (!runs.values.empty()) add_row(table, starts, unit_of(v.param), runs, text);
    };
    table.add_heading(parameter_cell(v.param).text);
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
  return table;
}

}  // namespace

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
