#include "analysis/observability/information.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "analysis/observability/driven_rows.hpp"
#include "core/base/check.hpp"
#include "core/estimate/measurement_equations.hpp"
#include "core/estimate/triangle.hpp"
#include "core/physics/stochastic.hpp"
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

/// What a plan does and where it is done.
Timeline timeline_of(const TestPlan& plan, const RankedModel& model) {
  Timeline timeline = lay_out(plan, model.site);
  set_environment(timeline, model.environment, 0, 0);
  for (Interval& i : timeline.intervals) i.loop = model.loop;
  resolve_own_terms(timeline, model.spec);
  return timeline;
}

Trajectory nominal_path(const Timeline& timeline, const RankedModel& model) {
  Trajectory phi =
      integrate(timeline, model.spec.model(), model.nominal,
                std::vector<Vec3>(static_cast<std::size_t>(timeline.chains), Vec3::Zero()));
  if (const auto lost = std::ranges::find_if_not(phi, &Vec3::allFinite); lost != phi.end())
    throw InputError(
        ExitCode::self_check,
        fmt::format("the platform of the nominal test has no attitude at t = {:.6g} s. The "
                    "nominal parameters may be unphysical: see `driftscope check`",
                    timeline.nodes[static_cast<std::size_t>(lost - phi.begin())].t));
  return phi;
}

/// Rows of a test that nothing random drives: those of one sample know nothing of another.
class StillRows {
 public:
  StillRows(const RankedModel& model, const Timeline& timeline, const Trajectory& phi)
      : timeline_(timeline),
        per_interval_((model.readout.accelerometers ? 3 : 0) + (model.readout.gimbals ? 3 : 0)),
        next_(static_cast<std::size_t>(timeline.chains), 0) {
    // What is measured does not matter, only that it is.
    const auto count = static_cast<Eigen::Index>(timeline.intervals.size());
    const Measurements measured{Mat3X::Zero(3, count), Mat3X::Zero(3, count)};
    const Layout layout = make_layout(model.spec);
    width_ = 3 + static_cast<Eigen::Index>(layout.size());
    chains_ = measurement_equations({timeline, model.readout, measured}, model.spec.model(), layout,
                                    model.nominal, phi, model.spec.initial_attitude);
  }

  /// Of the intervals first to end - 1, which come in order; shape (3 + n, 3 + n).
  MatX take(std::size_t first, std::size_t end, bool measured) {
    const auto chain = static_cast<std::size_t>(timeline_.intervals[first].chain);
    const Eigen::Index rows = per_interval_ * static_cast<Eigen::Index>(end - first),
                       at = next_[chain];
    next_[chain] += rows;
    return measured ? triangle(chains_[chain].rows.block(at, 0, rows, width_))
                    : MatX::Zero(width_, width_);
  }

 private:
  const Timeline& timeline_;
  Eigen::Index per_interval_, width_ = 0;
  std::vector<Eigen::Index> next_;  ///< row of each chain
  std::vector<ChainEquations> chains_;
};

/// Rows over the parameters alone, with zeros for the attitude.
MatX without_attitude(const MatX& rows) {
  MatX all = MatX::Zero(3 + rows.cols(), 3 + rows.cols());
  all.bottomRightCorner(rows.rows(), rows.cols()) = rows;
  return all;
}

}  // namespace

RankedModel ranked_model(const ModelSpec& spec, const TruthSpec* truth, const Site& site,
                         const Readout& readout, const Environment& environment) {
  constexpr auto eta = TermLibrary::index("eta_x");
  RankedModel model{spec,       make_layout(spec).theta, MisalignmentAngles::Zero(), site, readout,
                    environment};
  if (!truth) return model;
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    if (spec.active[i] && truth->active[i] && spec.priors[i].sigma() > 0.0 &&
        TermLibrary::specs[i].kind != ParamKind::noise)
      model.nominal[i] = truth->priors[i].mean();
  if (spec.active[closure_param] && spec.priors[closure_param].sigma() > 0.0)
    model.nominal[closure_param] =
        facts(facts(truth->coupling).settles_to).lambda.value_or(model.nominal[closure_param]);
  if (spec.coupling == Coupling::compensated && truth->coupling == Coupling::compensated &&
      truth->loop == LoopEstimate::given)
    model.loop = truth->theta_loop.segment<6>(eta);
  return model;
}

LinearisedPlan linearise(const TestPlan& plan, const RankedModel& model, int bins_per_dwell,
                         std::optional<int> unread) {
  const Timeline timeline = timeline_of(plan, model);
  const Trajectory phi = nominal_path(timeline, model);
  LinearisedPlan out;
  out.layout = make_layout(model.spec);
  out.chains = timeline.chains;
  out.positions = timeline.positions;
  out.excitation = excitation_of(timeline);
  out.duration = timeline.intervals.back().t1 - timeline.intervals.front().t0;
  std::optional<StillRows> still;
  std::optional<DrivenRows> driven;
  if (has_process_noise(model.spec)) {
    driven.emplace(model, timeline, phi);
    out.again = [plan, model](double attitude_weight, std::optional<int> without) {
      RankedModel other = model;
      other.spec.initial_attitude /= attitude_weight;
      return linearise(plan, other, 1, without);
    };
  } else {
    still.emplace(model, timeline, phi);
  }
  const std::vector<int> stretch = stretches(timeline, bins_per_dwell);
  for (std::size_t first = 0; first < timeline.intervals.size();) {
    const Interval& start = timeline.intervals[first];
    std::size_t end = first;
    while (end < timeline.intervals.size() && timeline.intervals[end].position == start.position &&
           stretch[end] == stretch[first])
      ++end;
    TimeBin bin{
        start.position, start.chain, start.slew, start.t0, timeline.intervals[end - 1].t1, {}, {}};
    const bool measured = unread != start.position;
    bin.rows = driven ? without_attitude(driven->take(first, end, measured))
                      : still->take(first, end, measured);
    if (driven) bin.walked = driven->walked();
    out.bins.push_back(std::move(bin));
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

MatX whole_root(const LinearisedPlan& plan, double attitude_weight) {
  if (plan.again && attitude_weight != 1.0) return whole_root(plan.again(attitude_weight, {}));
  InformationSum sum(plan.size(), attitude_weight);
  for (const TimeBin& bin : plan.bins) sum.add(bin.chain, bin.rows);
  return sum.root();
}

MatX by_the_beginning(const Walked& walked, Eigen::Index n) {
  MatX J = MatX::Identity(n, n);
  for (std::size_t k = 0; k < walked.states.size(); ++k)
    J.row(static_cast<Eigen::Index>(walked.states[k])) +=
        walked.by.row(static_cast<Eigen::Index>(k));
  return J;
}

Posterior posterior_of(const MatX& information_root, const Walked& walked) {
  const Eigen::Index n = information_root.cols();
  MatX R = triangle(stacked(information_root, MatX::Identity(n, n)));
  Posterior out;
  out.S = R.triangularView<Eigen::Upper>().solve(MatX::Identity(n, n));
  if (!walked.states.empty()) {
    // P = J P(beginning) J^T + the rest, by square roots.
    const auto m = static_cast<Eigen::Index>(walked.states.size());
    const Eigen::SelfAdjointEigenSolver<MatX> rest(walked.variance);
    const MatX root =
        rest.eigenvectors() * rest.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
    MatX S = MatX::Zero(n, n + m);
    S.leftCols(n) = by_the_beginning(walked, n) * out.S;
    for (Eigen::Index k = 0; k < m; ++k)
      S.row(static_cast<Eigen::Index>(walked.states[static_cast<std::size_t>(k)])).tail(m) =
          root.row(k);
    out.S = std::move(S);
    const MatX T = triangle(out.S.transpose());
    R = T.triangularView<Eigen::Upper>().solve(MatX::Identity(n, n)).transpose();
  }
  out.sigma = out.S.rowwise().norm();
  out.conditional = R.colwise().norm().cwiseInverse();
  out.bits = R.diagonal().cwiseAbs().array().log2().sum();
  return out;
}

Posterior posterior_of(const LinearisedPlan& plan, double attitude_weight) {
  if (plan.again && attitude_weight != 1.0) return posterior_of(plan.again(attitude_weight, {}));
  return posterior_of(whole_root(plan, attitude_weight), plan.bins.back().walked);
}

}  // namespace drift::observability
