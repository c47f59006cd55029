#include "analysis/observability/information.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/estimate/measurement_equations.hpp"
#include "core/estimate/triangle.hpp"
#include "core/sim/own_term_steps.hpp"
#include "core/sim/path_in_lanes.hpp"

namespace drift::observability {
namespace {

/// Which stretch each interval belongs to: 0 on the way, 1 .. bins in the dwell.
std::vector<int> stretches(const Timeline& timeline, int bins_per_dwell) {
  std::vector<int> all(timeline.intervals.size(), 0);
  for (std::size_t first = 0; first < all.size();) {
    std::size_t end = first;
    const auto same = [&](const Interval& i) {
      return i.position == timeline.intervals[first].position &&
             i.slew == timeline.intervals[first].slew;
    };
    while (end < all.size() && same(timeline.intervals[end])) ++end;
    const std::size_t count = end - first;
    for (std::size_t i = first; i < end && !timeline.intervals[first].slew; ++i)
      all[i] = 1 + static_cast<int>((i - first) * static_cast<std::size_t>(bins_per_dwell) / count);
    first = end;
  }
  return all;
}

}  // namespace

RankedModel ranked_model(const ModelSpec& spec, const TruthSpec* truth, const Site& site,
                         const Readout& readout, const Environment& environment) {
  constexpr auto eta = TermLibrary::index("eta_x");
  RankedModel model{spec,       make_layout(spec).theta, MisalignmentAngles::Zero(), site, readout,
                    environment};
  model.spec.noise = {};
  if (!truth) return model;
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    if (spec.active[i] && truth->active[i] && spec.priors[i].sigma() > 0.0)
      model.nominal[i] = truth->priors[i].mean();
  if (spec.active[closure_param] && spec.priors[closure_param].sigma() > 0.0)
    model.nominal[closure_param] =
        facts(facts(truth->coupling).settles_to).lambda.value_or(model.nominal[closure_param]);
  if (spec.coupling == Coupling::compensated && truth->coupling == Coupling::compensated &&
      truth->loop == LoopEstimate::given)
    model.loop = truth->theta_loop.segment<6>(eta);
  return model;
}

LinearisedPlan linearise(const TestPlan& plan, const RankedModel& model, int bins_per_dwell) {
  Timeline timeline = lay_out(plan, model.site);
  set_environment(timeline, model.environment, 0, 0);
  for (Interval& i : timeline.intervals) i.loop = model.loop;
  const ModelSpec& spec = model.spec;
  resolve_own_terms(timeline, spec);
  const Trajectory phi =
      integrate(timeline, spec.model(), model.nominal,
                std::vector<Vec3>(static_cast<std::size_t>(timeline.chains), Vec3::Zero()));
  if (const auto lost = std::ranges::find_if_not(phi, &Vec3::allFinite); lost != phi.end())
    throw InputError(
        ExitCode::self_check,
        fmt::format("the platform of the nominal test has no attitude at t = {:.6g} s. The "
                    "nominal parameters may be unphysical: see `driftscope check`",
                    timeline.nodes[static_cast<std::size_t>(lost - phi.begin())].t));
  // What is measured does not matter, only that it is.
  const auto count = static_cast<Eigen::Index>(timeline.intervals.size());
  const Measurements measured{Mat3X::Zero(3, count), Mat3X::Zero(3, count)};

  LinearisedPlan out;
  out.layout = make_layout(spec);
  out.chains = timeline.chains;
  out.positions = timeline.positions;
  out.excitation = excitation_of(timeline);
  out.duration = timeline.intervals.back().t1 - timeline.intervals.front().t0;
  const auto chains = measurement_equations({timeline, model.readout, measured}, spec.model(),
                                            out.layout, model.nominal, phi, spec.initial_attitude);
  const Eigen::Index width = 3 + out.size();
  const Eigen::Index per_interval =
      (model.readout.accelerometers ? 3 : 0) + (model.readout.gimbals ? 3 : 0);
  const std::vector<int> stretch = stretches(timeline, bins_per_dwell);
  std::vector<Eigen::Index> next(timeline.chains, 0);
  for (std::size_t first = 0; first < timeline.intervals.size();) {
    const Interval& start = timeline.intervals[first];
    std::size_t end = first;
    while (end < timeline.intervals.size() && timeline.intervals[end].position == start.position &&
           stretch[end] == stretch[first])
      ++end;
    const Eigen::Index rows = per_interval * static_cast<Eigen::Index>(end - first);
    Eigen::Index& at = next[start.chain];
    out.bins.push_back({start.position, start.chain, start.slew, start.t0,
                        timeline.intervals[end - 1].t1,
                        triangle(chains[start.chain].rows.block(at, 0, rows, width))});
    at += rows;
    first = end;
  }
  return out;
}

InformationSum::InformationSum(Eigen::Index parameters, double attitude_weight)
    : n_(parameters),
      weight_(attitude_weight),
      finished_(MatX::Zero(parameters, parameters)),
      chain_(MatX::Zero(3 + parameters, 3 + parameters)) {}

void InformationSum::add(int chain, const MatX& rows) {
  if (chain != present_) {
    finished_ = root();
    chain_.setZero();
    chain_.topLeftCorner<3, 3>() = weight_ * Mat3::Identity();
    present_ = chain;
  }
  chain_ = triangle(stacked(chain_, rows));
}

MatX InformationSum::root() const {
  // Below the attitude's three rows, the triangle no longer contains the attitude.
  return triangle(stacked(finished_, chain_.bottomRightCorner(n_, n_)));
}

Posterior posterior_of(const MatX& information_root) {
  const Eigen::Index n = information_root.cols();
  const MatX R = triangle(stacked(information_root, MatX::Identity(n, n)));
  Posterior out;
  out.S = R.triangularView<Eigen::Upper>().solve(MatX::Identity(n, n));
  out.sigma = out.S.rowwise().norm();
  out.conditional = R.colwise().norm().cwiseInverse();
  out.bits = R.diagonal().cwiseAbs().array().log2().sum();
  return out;
}

}  // namespace drift::observability
