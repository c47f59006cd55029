#include "analysis/planning/improve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/planning/candidates.hpp"
#include "core/base/check.hpp"
#include "core/config/nearest.hpp"
#include "core/estimate/triangle.hpp"
#include "core/plan/case_heading.hpp"
#include "mc/task/campaign.hpp"

namespace drift::planning {
namespace {

/// What a candidate adds.
struct Addition {
  bool feasible = false;
  MatX J;                 ///< compressed rows [psi | x]
  double duration = 0.0;  ///< [s]
};

/// Positions from the last caging on.
TestPlan last_chain(const TestPlan& plan) {
  TestPlan chain = plan;
  std::size_t first = plan.positions.size() - 1;
  while (first > 0 && plan.positions[first].entry != Entry::caged) --first;
  chain.positions.erase(chain.positions.begin(),
                        chain.positions.begin() + static_cast<std::ptrdiff_t>(first));
  return chain;
}

/// Integrates a chain and linearises its intervals from `first` on. carried: at the start of
/// `first`; becomes that of the end.
MatX rows_from(const Timeline& timeline, std::size_t first, const observability::RankedModel& model,
               const Layout& layout, ChainSensitivity& carried) {
  const ModelSpec& spec = model.spec;
  TruthSpec truth;
  static_cast<ModelSpec&>(truth) = spec;
  const TruthDraw draw{model.nominal, {Vec3::Zero()}};
  const Simulation sim = Simulator(truth, model.readout).run(timeline, draw, 0, 0);
  if (!sim.ode.ok())
    throw InputError(ExitCode::self_check, fmt::format("integration failed: {}", sim.ode.cause));
  Timeline part = timeline;
  part.intervals.erase(part.intervals.begin(),
                       part.intervals.begin() + static_cast<std::ptrdiff_t>(first));
  const auto n = static_cast<Eigen::Index>(part.intervals.size());
  const Measurements measured{sim.measured.acc.rightCols(n), sim.measured.gimbal.rightCols(n)};
  const auto equations =
      measurement_equations(part, spec.model(), layout, model.readout, measured, model.nominal,
                            sim.phi, spec.initial_attitude, &carried);
  return equations.front().rows.leftCols(3 + static_cast<Eigen::Index>(layout.size()));
}

Timeline chain_timeline(const TestPlan& chain, const observability::RankedModel& model) {
  Timeline timeline = lay_out(chain, model.site);
  set_environment(timeline, model.environment, 0, 0);
  for (Interval& i : timeline.intervals) i.loop = model.loop;
  return timeline;
}

/// A position of its own: its attitude eliminated, rows on the parameters alone.
Addition caged_addition(const TestPlan& plan, const Position& position,
                        const observability::RankedModel& model) {
  TestPlan alone = plan;
  alone.positions = {position};
  Addition out;
  try {
    const observability::LinearisedPlan linear = observability::linearise(alone, model);
    const MatX root = information_root(linear, [](const observability::TimeBin&) { return true; });
    out.J = MatX::Zero(root.rows(), 3 + root.cols());
    out.J.rightCols(root.cols()) = root;
    out.J = compressed(out.J);
    out.duration = linear.duration;
    out.feasible = true;
  } catch (const InputError&) {  // the gimbals do not allow it
  }
  return out;
}

/// The present chain, ready to be carried on.
struct Chain {
  TestPlan plan;
  ChainSensitivity end;
  std::size_t intervals = 0;
  double heading = 0.0;  ///< of the case at the end [rad]
};

Chain present_chain(const TestPlan& plan, const observability::RankedModel& model,
                    const Layout& layout) {
  Chain chain{last_chain(plan), {}, 0, 0.0};
  const Timeline timeline = chain_timeline(chain.plan, model);
  rows_from(timeline, 0, model, layout, chain.end);
  chain.intervals = timeline.intervals.size();
  chain.heading = timeline.intervals.back().heading1;
  return chain;
}

Addition torqued_addition(const Chain& chain, const Position& position,
                          const observability::RankedModel& model, const Layout& layout) {
  TestPlan longer = chain.plan;
  longer.positions.push_back(position);
  Addition out;
  try {
    const Timeline timeline = chain_timeline(longer, model);
    ChainSensitivity carried = chain.end;
    out.J = compressed(rows_from(timeline, chain.intervals, model, layout, carried));
    out.duration = timeline.intervals.back().t1 - timeline.intervals[chain.intervals].t0;
    out.feasible = true;
  } catch (const InputError&) {
  }
  return out;
}

/// "added 3: x=U y=N z=W level", no name of the plan.
std::string free_name(const TestPlan& plan, const Position& position) {
  for (std::size_t number = 1;; ++number) {
    const std::string start = fmt::format("added {}: ", number);
    const bool taken = std::ranges::any_of(
        plan.positions, [&](const Position& p) { return p.name.starts_with(start); });
    if (!taken) return fmt::format("{}{}", start, position.axes);
  }
}

double value_of(const Criterion& criterion, const VecX& sigma, double half_log2_det) {
  switch (criterion.kind) {
    case Criterion::Kind::A:
      return sigma.squaredNorm();
    case Criterion::Kind::D:
      return half_log2_det;
    case Criterion::Kind::parameter:
      break;
  }
  return sigma[static_cast<Eigen::Index>(criterion.state)];
}

}  // namespace

double Improvement::added() const {
  double sum = 0.0;
  for (const ImprovementStep& s : steps) sum += s.duration;
  return sum;
}

Criterion parse_criterion(const std::string& text, const Layout& layout) {
  if (text == "A") return {Criterion::Kind::A, 0, text};
  if (text == "D") return {Criterion::Kind::D, 0, text};
  std::vector<std::string_view> keys{"A", "D"};
  for (std::size_t k = 0; k < layout.size(); ++k) {
    keys.push_back(TermLibrary::specs[layout.params[k]].key.view());
    if (keys.back() == text) return {Criterion::Kind::parameter, k, text};
  }
  throw InputError(ExitCode::usage,
                   fmt::format("--criterion {}: unknown (expected A, D or a parameter that the "
                               "filter estimates). {}",
                               text, config::suggestion(text, keys)));
}

double UpdatedBelief::value(const Criterion& criterion) const {
  return value_of(criterion, sigma, half_log2_det);
}

JointPosterior joint_posterior(const observability::InformationSum& sum) {
  const MatX& chain = sum.chain_triangle();
  const Eigen::Index n = chain.cols() - 3;
  MatX rest = MatX::Zero(2 * n, 3 + n);  // other chains, prior
  rest.topRightCorner(n, n) = sum.finished();
  rest.bottomRightCorner(n, n).setIdentity();
  const MatX R = triangle(stacked(chain, rest));
  return {R.triangularView<Eigen::Upper>().solve(MatX::Identity(3 + n, 3 + n)),
          chain.leftCols<3>().transpose() * chain.leftCols<3>()};
}

MatX compressed(const MatX& rows) {
  constexpr double negligible = 1e-11;  // information in units of the prior's
  const Eigen::ColPivHouseholderQR<MatX> qr(triangle(rows));
  MatX R = qr.matrixQR().triangularView<Eigen::Upper>();
  Eigen::Index r = R.rows();
  double left_out = 0.0;
  while (r > 0 && left_out + R.row(r - 1).squaredNorm() < negligible)
    left_out += R.row(--r).squaredNorm();
  return R.topRows(r) * qr.colsPermutation().transpose();
}

UpdatedBelief updated_belief(const JointPosterior& posterior, const MatX& J) {
  const Eigen::Index m = posterior.S.rows(), n = m - 3, r = J.rows();
  const auto S_x = posterior.S.bottomRows(n);
  UpdatedBelief out;
  VecX variance = S_x.rowwise().squaredNorm();
  Mat3 psi_information = posterior.psi_information;
  double half_log2_det = posterior.S.diagonal().cwiseAbs().array().log2().sum();
  if (r > 0) {
    const Eigen::HouseholderQR<MatX> qr((J * posterior.S).transpose());  // (J S)^T = Q L^T
    const MatX Q = qr.householderQ() * MatX::Identity(m, r);
    const MatX L = qr.matrixQR().topRows(r).triangularView<Eigen::Upper>().transpose();
    const MatX T = triangle(stacked(MatX::Identity(r, r), L));  // T^T T = 1 + L^T L
    const MatX SQ = S_x * Q;
    const MatX SQT = T.transpose().triangularView<Eigen::Lower>().solve(SQ.transpose());
    variance = (S_x - SQ * Q.transpose()).rowwise().squaredNorm() +
               SQT.colwise().squaredNorm().transpose();
    half_log2_det -= T.diagonal().cwiseAbs().array().log2().sum();
    psi_information += J.leftCols<3>().transpose() * J.leftCols<3>();
  }
  out.sigma = variance.cwiseSqrt();
  // det P(psi, x) = det P(x) / det I(psi given x).
  out.half_log2_det = half_log2_det + 0.5 * std::log2(psi_information.determinant());
  return out;
}

Improvement improve_plan(const TestPlan& plan, const observability::RankedModel& model,
                         const Criterion& criterion, std::size_t count, int threads,
                         const ImproveProgress& progress) {
  const observability::LinearisedPlan linear = observability::linearise(plan, model);
  observability::InformationSum sum(linear.size());
  for (const observability::TimeBin& bin : linear.bins) sum.add(bin.chain, bin.rows);
  int chain_number = linear.chains - 1;
  const MatX none(0, 3 + linear.size());

  Improvement out;
  out.criterion = criterion;
  out.plan = plan;
  out.plan.preset.clear();
  JointPosterior posterior = joint_posterior(sum);
  out.before = updated_belief(posterior, none).sigma;
  const std::vector<Position> caged = caged_candidates(plan);
  const std::vector<Addition> caged_additions = mc::run_campaign(
      caged.size(), [&](std::size_t k) { return caged_addition(plan, caged[k], model); }, threads);
  const bool any_torqued = !torqued_candidates(plan, 0.0).empty();
  for (std::size_t step = 0; step < count; ++step) {
    Chain chain;
    std::vector<Position> torqued;
    if (any_torqued) {
      chain = present_chain(out.plan, model, linear.layout);
      torqued = torqued_candidates(plan, chain.heading);
    }
    struct Outcome {
      double value = std::nan("");
      Addition torqued;
    };
    const auto outcomes = mc::run_campaign(
        caged.size() + torqued.size(),
        [&](std::size_t k) {
          Outcome o;
          if (k >= caged.size())
            o.torqued = torqued_addition(chain, torqued[k - caged.size()], model, linear.layout);
          const Addition& a = k < caged.size() ? caged_additions[k] : o.torqued;
          if (a.feasible) o.value = updated_belief(posterior, a.J).value(criterion);
          return o;
        },
        threads);
    ImprovementStep done;
    done.before = updated_belief(posterior, none).value(criterion);
    std::size_t best = outcomes.size();
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
      if (!std::isfinite(outcomes[k].value)) continue;
      ++done.feasible;
      if (best == outcomes.size() || outcomes[k].value < outcomes[best].value) best = k;
    }
    if (best == outcomes.size()) break;
    const bool is_caged = best < caged.size();
    const Addition& addition = is_caged ? caged_additions[best] : outcomes[best].torqued;
    done.position = is_caged ? caged[best] : torqued[best - caged.size()];
    done.position.name = free_name(out.plan, done.position);
    done.duration = addition.duration;
    out.plan.positions.push_back(done.position);
    // The step itself is recomputed from rows that keep the new chain's attitude.
    TestPlan chain_plan = last_chain(out.plan);
    if (is_caged) {
      sum.add(++chain_number, observability::linearise(chain_plan, model).bins.front().rows);
    } else {
      sum.add(chain_number, addition.J);
    }
    posterior = joint_posterior(sum);
    const UpdatedBelief belief = updated_belief(posterior, none);
    done.after = belief.value(criterion);
    done.learning_ratios = belief.sigma;
    out.steps.push_back(std::move(done));
    if (progress) progress(step + 1, count);
  }
  return out;
}

}  // namespace drift::planning
