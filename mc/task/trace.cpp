#include "mc/task/trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/estimate/sequential/in_lanes/ekf_lanes.hpp"
#include "core/estimate/starts.hpp"
#include "core/plan/environment.hpp"
#include "core/sim/judged_truth.hpp"
#include "mc/study/design.hpp"
#include "mc/task/study_task.hpp"

namespace drift::mc {

RunTrace trace_run(const Study& point, std::uint64_t run) {
  const StudyTask task(point);
  const MonteCarlo& mc = point.monte_carlo;
  Timeline timeline = task.timeline();
  set_environment(timeline, point.environment, mc.seed, run);
  Design design(point.truth, mc.design, mc.runs, mc.seed);
  const Simulation sim = Simulator(point.truth, point.readout)
                             .run(timeline, design.draw(run, timeline.chains), mc.seed, run);
  RunTrace trace;
  trace.ode = sim.ode;
  trace.truth = judged_truth(point.truth, sim.theta_end);
  if (!sim.ode.ok()) return trace;
  for (std::size_t f = 0; f < point.filters.size(); ++f) {
    const FilterSpec& spec = point.filters[f];
    const std::size_t starts = start_count(spec);
    std::vector<EkfJob> jobs(starts);
    std::vector<EkfHistory> histories(starts);
    for (std::size_t s = 0; s < starts; ++s) {
      jobs[s].measured = &sim.measured;
      jobs[s].start = initial_estimate(spec, mc.seed, run, s);
    }
    if (task.goes_in_lanes(spec))  // as the study has it, to the last bit
      EkfLanes(spec, timeline, point.readout).run(jobs, histories);
    else
      for (std::size_t s = 0; s < starts; ++s)
        run_ekf(spec, {timeline, point.readout, sim.measured}, jobs[s].start, &histories[s]);
    for (std::size_t s = 0; s < starts; ++s)
      trace.filters.push_back({f, s, make_layout(spec), std::move(histories[s])});
  }
  return trace;
}

void send_trace(const RunTrace& trace, TraceSink& sink) {
  ParamMask shown;
  for (const auto& f : trace.filters)
    for (const std::size_t p : f.layout.params) shown.set(p);
  const auto& specs = TermLibrary::specs;
  std::vector<Column> columns{{"filter", unit::one},
                              {"start", unit::one},
                              {"time", unit::s},
                              {"nis", unit::one},
                              {"scalars", unit::one}};
  for (std::size_t p = 0; p < shown.size(); ++p) {
    if (!shown[p]) continue;
    const std::string key(specs[p].key.view());
    columns.push_back({key, specs[p].unit});
    columns.push_back({"sigma_" + key, specs[p].unit});
  }
  sink.columns(columns);
  for (const auto& f : trace.filters)
    for (std::size_t i = 0; i < f.history.t.size(); ++i) {
      std::vector<double> row{static_cast<double>(f.filter), static_cast<double>(f.start + 1),
                              f.history.t[i], f.history.nis[i],
                              static_cast<double>(f.history.scalars[i])};
      for (std::size_t p = 0; p < shown.size(); ++p) {
        if (!shown[p]) continue;
        const auto at = std::ranges::find(f.layout.params, p);
        const auto k = at - f.layout.params.begin();
        const auto column = static_cast<Eigen::Index>(i);
        const bool known = at != f.layout.params.end() && f.history.sigma(k, column) > 0.0;
        row.push_back(known ? f.history.estimate(k, column) : std::nan(""));
        row.push_back(known ? f.history.sigma(k, column) : std::nan(""));
      }
      sink.row(row);
    }
}

}  // namespace drift::mc
