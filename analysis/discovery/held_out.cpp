#include "analysis/discovery/held_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace drift::discovery {
namespace {

bool among(const std::vector<int>& positions, int p) {
  return std::find(positions.begin(), positions.end(), p) != positions.end();
}

/// Prediction of the rows that `all` has and `rest` has not.
struct Prediction {
  double chi2 = 0.0, log_score = 0.0;
  std::size_t rows = 0;
};

Prediction prediction(const Projected& all, const Projected& rest) {
  Prediction p;
  p.chi2 = all.chi2 - rest.chi2;
  p.rows = static_cast<std::size_t>(all.rows - rest.rows);
  p.log_score = 0.5 * (all.log_likelihood2() - rest.log_likelihood2()) -
                0.5 * static_cast<double>(p.rows) * std::log(2.0 * std::numbers::pi);
  return p;
}

/// A problem whose parameters are the nominal ones and some candidate columns.
LinearProblem with_columns(const LinearProblem& problem, const std::vector<int>& columns) {
  LinearProblem out = problem;
  const Eigen::Index n = problem.theta.cols();
  out.theta.conservativeResize(Eigen::NoChange, n + columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k) out.theta.col(n + k) = problem.extra.col(columns[k]);
  out.extra.resize(problem.rows(), 0);
  return out;
}

LinearProblem bare(const LinearProblem& problem) { return with_columns(problem, {}); }

Projected marginal(const LinearProblem& problem, const NoiseModel& noise) {
  return Projector(problem, noise).candidates();
}

}  // namespace

LinearProblem without_positions(const LinearProblem& problem, const std::vector<int>& positions) {
  std::vector<Eigen::Index> keep;
  for (Eigen::Index k = 0; k < problem.rows(); ++k)
    if (!among(positions, problem.tags[k].position)) keep.push_back(k);
  LinearProblem out;
  out.drives = problem.drives;
  out.acc_sigma = problem.acc_sigma;
  out.gimbal_sigma = problem.gimbal_sigma;
  out.attitude_sigma = problem.attitude_sigma;
  for (const Eigen::Index k : keep) out.tags.push_back(problem.tags[k]);
  out.psi = problem.psi(keep, Eigen::all);
  out.theta = problem.theta(keep, Eigen::all);
  out.extra = problem.extra(keep, Eigen::all);
  out.r0 = problem.r0(keep);
  out.weight = problem.weight(keep);
  return out;
}

Measurements without_positions(const Measurements& measured, const Timeline& timeline, const std::vector<int>& positions) {
  Measurements out = measured;
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i)
    if (among(positions, timeline.intervals[i].position)) {
      out.acc.col(i).setConstant(std::numeric_limits<double>::quiet_NaN());
      out.gimbal.col(i).setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  return out;
}

HeldOut held_out(const Examination& nominal, const Examination& patched, const Test& test,
                 const std::vector<std::size_t>& named, double library_threshold, FoldMethod method) {
  HeldOut out;
  out.method = method == FoldMethod::linear ? "linear" : "refitted";
  std::vector<int> positions;
  for (const RowTag& t : nominal.problem.tags)
    if (!among(positions, t.position)) positions.push_back(t.position);
  std::sort(positions.begin(), positions.end());

  // One noise for both, else the one that doubts its instruments more would be favoured: the patched
  // model's, which has no misfit in it.
  const NoiseModel& noise = patched.noise.model;
  const LinearProblem before = bare(nominal.problem), after = bare(patched.problem);
  const Projected all_before = marginal(before, noise), all_after = marginal(after, noise);
  double chi2_before = 0.0, chi2_after = 0.0, square = 0.0;
  std::size_t rows = 0;
  for (const int position : positions) {
    if (positions.size() < 2) break;
    Fold fold;
    fold.name = fmt::format("position {}", position + 1);
    fold.positions = {position + 1};
    Prediction p, q;
    if (method == FoldMethod::linear) {
      p = prediction(all_before, marginal(without_positions(before, {position}), noise));
      q = prediction(all_after, marginal(without_positions(after, {position}), noise));
    } else {
      const Measurements rest = without_positions(test.measured, test.timeline, {position});
      const auto refitted = [&](const Examination& e) {
        const BatchResult fit = fit_batch(e.filter, test.timeline, test.readout, rest, theta_of(e.filter, e.fit));
        // Linearised anew at that fit, with all rows; only then is the position looked at.
        BatchResult at = fit;
        LinearProblem problem = linear_problem(e.filter, test, at, {});
        problem.weight = e.problem.weight;
        return prediction(marginal(problem, noise), marginal(without_positions(problem, {position}), noise));
      };
      p = refitted(nominal);
      q = refitted(patched);
    }
    fold.dof = p.rows;
    fold.chi2_before = p.chi2;
    fold.chi2_after = q.chi2;
    fold.log_score_before = p.log_score;
    fold.log_score_after = q.log_score;
    chi2_before += p.chi2;
    chi2_after += q.chi2;
    rows += p.rows;
    const double gain = q.log_score - p.log_score;
    out.log_score_gain += gain;
    square += gain * gain;

    // The choice again, without having seen this position.
    const LinearProblem seen = without_positions(nominal.problem, {position});
    const Projector projector(seen, noise);
    const std::vector<PositionScan> no_scans;
    const Field field(nominal.set, projector.candidates(), no_scans);
    std::size_t best = 0;
    double best_evidence = -1.0;
    bool significant = false;
    Choice choice;
    for (std::size_t k = 0; k < nominal.set.candidates.size(); ++k) {
      const Score s = score(field, k);
      if (s.dof == 0 || s.strength < library_threshold || s.log_bayes <= best_evidence) continue;
      significant = true;
      best_evidence = s.log_bayes;
      best = k;
      choice = {k, s.variant};
    }
    fold.same_choice = significant && std::any_of(named.begin(), named.end(), [&](std::size_t k) {
      const Candidate &a = nominal.set.candidates[k], &b = nominal.set.candidates[best];
      return a.term == b.term && (a.params == b.params || a.contains(b) || b.contains(a));
    });
    if (significant) {
      const auto& columns = nominal.set.candidates[choice.candidate].variants[choice.variant].columns;
      const LinearProblem chosen = with_columns(nominal.problem, columns);
      out.nested_gain += prediction(marginal(chosen, noise), marginal(without_positions(chosen, {position}), noise)).log_score -
                         p.log_score;
    }
    out.folds.push_back(std::move(fold));
  }
  if (rows > 0) {
    out.chi2_per_dof_before = chi2_before / static_cast<double>(rows);
    out.chi2_per_dof_after = chi2_after / static_cast<double>(rows);
    const double n = static_cast<double>(out.folds.size()), mean = out.log_score_gain / n;
    if (n > 1.0) out.log_score_gain_sigma = std::sqrt(std::max(0.0, (square / n - mean * mean) * n * n / (n - 1.0)));
  }
  out.improves = out.log_score_gain > 0.0;
  return out;
}

}  // namespace drift::discovery
