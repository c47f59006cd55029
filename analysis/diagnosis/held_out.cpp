#include "analysis/diagnosis/held_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "mc/task/campaign.hpp"

namespace drift::diagnosis {
namespace {

/// Prediction of the rows that `all` has and `rest` has not.
struct Prediction {
  double chi2 = 0.0, log_score = 0.0;
  std::size_t rows = 0;
};

Prediction prediction(const inference::Projected& all, const inference::Projected& rest) {
  Prediction p;
  p.chi2 = all.chi2 - rest.chi2;
  p.rows = static_cast<std::size_t>(all.rows - rest.rows);
  p.log_score = 0.5 * (all.log_likelihood2() - rest.log_likelihood2()) -
                0.5 * static_cast<double>(p.rows) * std::log(2.0 * std::numbers::pi);
  return p;
}

/// A problem whose parameters are the nominal ones and some candidate columns.
inference::LinearProblem with_columns(const inference::LinearProblem& problem,
                                      const std::vector<int>& columns) {
  inference::LinearProblem out;
  out.tags = problem.tags;
  out.drives = problem.drives;
  out.psi = problem.psi;
  out.r0 = problem.r0;
  out.weight = problem.weight;
  out.acc_sigma = problem.acc_sigma;
  out.gimbal_sigma = problem.gimbal_sigma;
  out.attitude_sigma = problem.attitude_sigma;
  const Eigen::Index n = problem.theta.cols();
  out.theta.resize(problem.rows(), n + static_cast<Eigen::Index>(columns.size()));
  out.theta.leftCols(n) = problem.theta;
  for (std::size_t k = 0; k < columns.size(); ++k)
    out.theta.col(n + static_cast<Eigen::Index>(k)) = problem.extra.col(columns[k]);
  out.extra.resize(problem.rows(), 0);
  return out;
}

inference::LinearProblem bare(const inference::LinearProblem& problem) {
  return with_columns(problem, {});
}

inference::Projected marginal(const inference::LinearProblem& problem,
                              const inference::NoiseModel& noise) {
  return inference::Projector(problem, noise).candidates();
}

/// What is held out at once.
struct Part {
  std::string name;
  std::vector<int> positions;   ///< 1-based
  std::vector<bool> intervals;  ///< marked: held out
};

std::vector<Part> positions_of(const inference::LinearProblem& problem) {
  std::vector<int> positions;
  for (const inference::RowTag& t : problem.tags) positions.push_back(t.position);
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  std::vector<Part> parts;
  if (positions.size() < 2) return parts;
  for (const int p : positions) {
    Part part{fmt::format("position {}", p + 1),
              {p + 1},
              std::vector<bool>(problem.drives.size(), false)};
    for (const inference::RowTag& t : problem.tags)
      if (t.position == p) part.intervals[t.interval] = true;
    parts.push_back(std::move(part));
  }
  return parts;
}

std::vector<Part> recordings_of(const inference::LinearProblem& problem,
                                const std::vector<std::size_t>& ends) {
  std::vector<Part> parts;
  if (ends.size() < 2) return parts;
  for (std::size_t r = 0; r < ends.size(); ++r) {
    Part part{
        fmt::format("recording {}", r + 1), {}, std::vector<bool>(problem.drives.size(), false)};
    for (std::size_t i = r == 0 ? 0 : ends[r - 1]; i < ends[r]; ++i) part.intervals[i] = true;
    for (const inference::RowTag& t : problem.tags)
      if (part.intervals[t.interval]) part.positions.push_back(t.position + 1);
    std::sort(part.positions.begin(), part.positions.end());
    part.positions.erase(std::unique(part.positions.begin(), part.positions.end()),
                         part.positions.end());
    if (!part.positions.empty()) parts.push_back(std::move(part));
  }
  return parts.size() < 2 ? std::vector<Part>{} : parts;
}

/// A fold and what it gained with the cause chosen anew.
struct Outcome {
  Fold fold;
  double nested_gain = 0.0;
};

class Folder {
 public:
  Folder(const search::Examination& nominal, const search::Examination& patched,
         const inference::Test& test, const std::vector<std::size_t>& named,
         double library_threshold, const FoldOptions& options)
      : nominal_(nominal),
        patched_(patched),
        test_(test),
        named_(named),
        threshold_(library_threshold),
        options_(options),
        noise_(patched.noise.model),
        before_(bare(nominal.problem)),
        after_(bare(patched.problem)),
        all_before_(marginal(before_, noise_)),
        all_after_(marginal(after_, noise_)) {}

  Outcome run(const Part& part) const {
    Outcome out;
    Fold& fold = out.fold;
    fold.name = part.name;
    fold.positions = part.positions;
    const bool linear = options_.method == FoldMethod::linear;
    const Prediction conditioned =
        prediction(all_before_, marginal(without_intervals(before_, part.intervals), noise_));
    Prediction p = linear ? conditioned : refitted(nominal_, part);
    // A model that is grossly wrong may run away without the part: then as the whole fit has it.
    if (!std::isfinite(p.log_score)) p = conditioned;
    const Prediction q =
        linear ? prediction(all_after_, marginal(without_intervals(after_, part.intervals), noise_))
               : refitted(patched_, part);
    fold.dof = p.rows;
    fold.chi2_before = p.chi2;
    fold.chi2_after = q.chi2;
    fold.log_score_before = p.log_score;
    fold.log_score_after = q.log_score;
    choose_again(part, conditioned, out);
    return out;
  }

 private:
  /// Fitted without the part and linearised anew at that fit; only then is the part looked at.
  Prediction refitted(const search::Examination& e, const Part& part) const {
    const Measurements rest = without_intervals(test_.measured, part.intervals);
    // Near the whole fit: a step of a hundredth of a sigma is as good as none.
    BatchResult fit = fit_batch(e.filter, test_.timeline, test_.readout, rest,
                                inference::theta_of(e.filter, e.fit), {.tolerance = 1e-2});
    // Attitudes of which the fit has seen nothing: linearised where they are, their prior
    // unchanged.
    std::vector<bool> seen(fit.psi0_l.size(), false);
    for (const inference::RowTag& t : e.problem.tags)
      if (!part.intervals[t.interval])
        seen[static_cast<std::size_t>(e.problem.drives[t.interval].chain)] = true;
    for (std::size_t c = 0; c < seen.size(); ++c)
      if (!seen[c]) fit.psi0_l[c] = e.fit.psi0_l[c];
    inference::LinearProblem problem = inference::linear_problem(e.filter, test_, fit, {});
    problem.weight = e.problem.weight;
    return prediction(marginal(problem, noise_),
                      marginal(without_intervals(problem, part.intervals), noise_));
  }

  /// The choice again, without having seen this part, and what it gains.
  void choose_again(const Part& part, const Prediction& nominal, Outcome& out) const {
    const inference::Projector projector(without_intervals(nominal_.problem, part.intervals),
                                         noise_);
    const std::vector<inference::PositionScan> no_scans;
    search::Field field(nominal_.set, projector.candidates(), no_scans);
    field.discount = nominal_.field->discount;
    std::size_t best = 0;
    double best_evidence = -1.0;
    bool significant = false;
    search::Choice choice;
    for (std::size_t k = 0; k < nominal_.set.candidates.size(); ++k) {
      const search::Score s = search::score(field, k);
      if (s.dof == 0 || s.strength < threshold_ || s.log_bayes <= best_evidence) continue;
      significant = true;
      best_evidence = s.log_bayes;
      best = k;
      choice = {k, s.variant};
    }
    out.fold.same_choice =
        significant && std::any_of(named_.begin(), named_.end(), [&](std::size_t k) {
          const inference::Candidate &a = nominal_.set.candidates[k],
                                     &b = nominal_.set.candidates[best];
          return a.term == b.term && (a.params == b.params || a.contains(b) || b.contains(a));
        });
    if (!significant) return;
    const auto& columns =
        nominal_.set.candidates[choice.candidate].variants[choice.variant].columns;
    const inference::LinearProblem chosen = with_columns(nominal_.problem, columns);
    out.nested_gain = prediction(marginal(chosen, noise_),
                                 marginal(without_intervals(chosen, part.intervals), noise_))
                          .log_score -
                      nominal.log_score;
  }

  const search::Examination &nominal_, &patched_;
  const inference::Test& test_;
  const std::vector<std::size_t>& named_;
  double threshold_;
  const FoldOptions& options_;
  // One noise for both, else the one that doubts its instruments more would be favoured: the
  // patched model's, which has no misfit in it.
  const inference::NoiseModel& noise_;
  inference::LinearProblem before_, after_;
  inference::Projected all_before_, all_after_;
};

}  // namespace

double held_out_gain(const search::Examination& before, const search::Examination& after) {
  const inference::LinearProblem with = bare(after.problem), without = bare(before.problem);
  const inference::NoiseModel& noise = after.noise.model;
  const inference::Projected all_with = marginal(with, noise),
                             all_without = marginal(without, noise);
  const std::vector<Part> parts = positions_of(without);
  const auto gains = mc::run_campaign(parts.size(), [&](std::size_t k) {
    return prediction(all_with, marginal(without_intervals(with, parts[k].intervals), noise))
               .log_score -
           prediction(all_without, marginal(without_intervals(without, parts[k].intervals), noise))
               .log_score;
  });
  return std::accumulate(gains.begin(), gains.end(), 0.0);
}

inference::LinearProblem without_intervals(const inference::LinearProblem& problem,
                                           const std::vector<bool>& left_out) {
  std::vector<Eigen::Index> keep;
  for (Eigen::Index k = 0; k < problem.rows(); ++k)
    if (!left_out[problem.tags[k].interval]) keep.push_back(k);
  inference::LinearProblem out;
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

Measurements without_intervals(const Measurements& measured, const std::vector<bool>& left_out) {
  Measurements out = measured;
  for (std::size_t i = 0; i < left_out.size(); ++i)
    if (left_out[i]) {
      out.acc.col(static_cast<Eigen::Index>(i))
          .setConstant(std::numeric_limits<double>::quiet_NaN());
      out.gimbal.col(static_cast<Eigen::Index>(i))
          .setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  return out;
}

HeldOut held_out(const search::Examination& nominal, const search::Examination& patched,
                 const inference::Test& test, const std::vector<std::size_t>& named,
                 double library_threshold, const FoldOptions& options) {
  HeldOut out;
  out.method = options.method == FoldMethod::linear ? "linear" : "refitted";
  std::vector<Part> parts = positions_of(nominal.problem);
  const std::size_t positions = parts.size();
  for (Part& p : recordings_of(nominal.problem, options.recording_ends))
    parts.push_back(std::move(p));
  if (parts.empty()) return out;
  const Folder folder(nominal, patched, test, named, library_threshold, options);
  std::atomic<std::size_t> done{0};
  auto outcomes = mc::run_campaign(parts.size(), [&](std::size_t k) {
    Outcome o = folder.run(parts[k]);
    const std::size_t count = ++done;
    if (options.progress) options.progress(count, parts.size());
    return o;
  });

  double chi2_before = 0.0, chi2_after = 0.0, square = 0.0, rows = 0.0;
  double whole_before = 0.0, whole_after = 0.0, whole_rows = 0.0;
  std::size_t beyond = 0;
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    Fold& fold = outcomes[k].fold;
    const double gain = fold.log_score_after - fold.log_score_before;
    if (k >= positions) {
      whole_before += fold.chi2_before;
      whole_after += fold.chi2_after;
      whole_rows += static_cast<double>(fold.dof);
      out.recording_gain += gain;
      out.recordings.push_back(std::move(fold));
      continue;
    }
    if (!std::isfinite(gain) && std::isfinite(fold.log_score_after)) {
      ++beyond;  // the nominal model predicts nothing at all
      out.folds.push_back(std::move(fold));
      continue;
    }
    chi2_before += fold.chi2_before;
    chi2_after += fold.chi2_after;
    rows += static_cast<double>(fold.dof);
    out.log_score_gain += gain;
    out.nested_gain += outcomes[k].nested_gain;
    square += gain * gain;
    out.folds.push_back(std::move(fold));
  }
  if (rows > 0.0) {
    out.chi2_per_dof_before = chi2_before / rows;
    out.chi2_per_dof_after = chi2_after / rows;
    const double n = static_cast<double>(out.folds.size()), mean = out.log_score_gain / n;
    if (n > 1.0)
      out.log_score_gain_sigma =
          std::sqrt(std::max(0.0, (square / n - mean * mean) * n * n / (n - 1.0)));
  }
  if (whole_rows > 0.0) {
    out.recording_chi2_per_dof_before = whole_before / whole_rows;
    out.recording_chi2_per_dof_after = whole_after / whole_rows;
  }
  out.improves = !(out.folds.empty() && out.recordings.empty()) &&
                 (out.folds.empty() || out.log_score_gain > least_held_out_gain ||
                  (beyond > 0 && out.log_score_gain >= 0.0)) &&
                 (out.recordings.empty() || out.recording_gain > 0.0);
  return out;
}

}  // namespace drift::diagnosis
