#include "analysis/diagnosis/held_out/held_out.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <optional>

#include "analysis/diagnosis/held_out/held_out_part.hpp"
#include "analysis/diagnosis/held_out/predictor.hpp"
#include "analysis/inference/thresholds.hpp"
#include "mc/task/campaign.hpp"

namespace drift::diagnosis {
namespace {

/// A fold and what it gained with the cause chosen anew.
struct Outcome {
  Fold fold;
  double nested_gain = 0.0;
  double gain() const { return fold.log_score_after - fold.log_score_before; }
};

class Folder {
 public:
  Folder(const search::Fitted& nominal, const search::Fitted& patched, const MeasuredTest& test,
         const std::vector<std::size_t>& named, double library_threshold, FoldMethod method)
      : nominal_(nominal),
        patched_(patched),
        test_(test),
        named_(named),
        threshold_(library_threshold),
        method_(method),
        noise_(patched.noise.model),
        before_(nominal.problem, noise_),
        after_(patched.problem, noise_) {}

  Outcome run(const HeldOutPart& part) const {
    const Prediction conditioned = before_.predict(part.intervals);
    const bool linear = method_ == FoldMethod::linear;
    Prediction before = linear ? conditioned : refitted(nominal_, part);
    // A model that is grossly wrong may run away without the part: then as the whole fit has it.
    if (!std::isfinite(before.log_score)) before = conditioned;
    const Prediction after = linear ? after_.predict(part.intervals) : refitted(patched_, part);
    Fold fold;
    fold.of = part.of;
    fold.number = part.number;
    fold.positions = part.positions;
    fold.dof = before.rows;
    fold.chi2_before = before.chi2;
    fold.chi2_after = after.chi2;
    fold.log_score_before = before.log_score;
    fold.log_score_after = after.log_score;
    const std::optional<search::Choice> again = chosen_without(part);
    fold.same_choice = again && is_named(*again);
    if (!again) return {fold, 0.0};
    const auto& columns =
        nominal_.set.candidates[again->candidate].variants[again->variant].columns;
    return {fold, before_.predict(part.intervals, columns).log_score - conditioned.log_score};
  }

 private:
  /// Fitted without the part and linearised anew at that fit; only then is the part looked at.
  Prediction refitted(const search::Fitted& e, const HeldOutPart& part) const {
    const Measurements rest = without_intervals(test_.measured, part.intervals);
    // Near the whole fit: a step of a hundredth of a sigma is as good as none.
    BatchResult fit = fit_batch_from(
        e.filter, {test_.timeline, test_.readout, rest}, theta_of(e.filter, e.fit), e.fit.psi0_l,
        {.tolerance = 1e-2, .result = BatchOptions::Result::estimates});
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
    return Predictor(problem, noise_).predict(part.intervals);
  }

  /// The cause that would be chosen without having seen this part; none if nothing is significant.
  std::optional<search::Choice> chosen_without(const HeldOutPart& part) const {
    search::Field field(nominal_.set, before_.candidates_without(part.intervals), {});
    field.discount = nominal_.discount;
    std::optional<search::Choice> best;
    double best_evidence = -1.0;
    for (std::size_t k = 0; k < field.set.candidates.size(); ++k) {
      const search::Score s = search::score(field, k);
      if (s.dof == 0 || s.strength < threshold_ || s.log_bayes <= best_evidence) continue;
      best_evidence = s.log_bayes;
      best = {k, s.variant};
    }
    return best;
  }

  bool is_named(const search::Choice& choice) const {
    const inference::Candidate& b = nominal_.set.candidates[choice.candidate];
    return std::ranges::any_of(named_, [&](std::size_t k) {
      const inference::Candidate& a = nominal_.set.candidates[k];
      return a.term == b.term && (a.params == b.params || a.contains(b) || b.contains(a));
    });
  }

  const search::Fitted &nominal_, &patched_;
  const MeasuredTest& test_;
  const std::vector<std::size_t>& named_;
  double threshold_;
  FoldMethod method_;
  // One noise for both, else the one that doubts its instruments more would be favoured: the
  // patched model's, which has no misfit in it.
  const inference::NoiseModel& noise_;
  Predictor before_, after_;
};

/// Chi-squares of folds together.
struct Total {
  double before = 0.0, after = 0.0, rows = 0.0;
  void add(const Fold& fold) {
    before += fold.chi2_before;
    after += fold.chi2_after;
    rows += static_cast<double>(fold.dof);
  }
};

/// Positions together. Those of which the nominal model predicts nothing at all are in no sum.
HeldOut over_positions(std::vector<Outcome> outcomes) {
  HeldOut out;
  Total total;
  double square = 0.0;
  bool beyond = false;
  for (Outcome& o : outcomes) {
    const double gain = o.gain();
    if (std::isfinite(gain) || !std::isfinite(o.fold.log_score_after)) {
      total.add(o.fold);
      out.log_score_gain += gain;
      out.nested_gain += o.nested_gain;
      square += gain * gain;
    } else {
      beyond = true;
    }
    out.folds.push_back(std::move(o.fold));
  }
  if (total.rows > 0.0) {
    out.chi2_per_dof_before = total.before / total.rows;
    out.chi2_per_dof_after = total.after / total.rows;
    const double n = static_cast<double>(out.folds.size()), mean = out.log_score_gain / n;
    if (n > 1.0)
      out.log_score_gain_sigma =
          std::sqrt(std::max(0.0, (square / n - mean * mean) * n * n / (n - 1.0)));
  }
  out.improves = out.folds.empty() || out.log_score_gain > inference::WeighLimits::held_out ||
                 (beyond && out.log_score_gain >= 0.0);
  return out;
}

/// And recordings, if there are several: they must be predicted better too.
HeldOut with_recordings(HeldOut out, std::vector<Outcome> outcomes) {
  if (outcomes.empty()) return out;
  Total total;
  for (Outcome& o : outcomes) {
    total.add(o.fold);
    out.recording_gain += o.gain();
    out.recordings.push_back(std::move(o.fold));
  }
  if (total.rows > 0.0) {
    out.recording_chi2_per_dof_before = total.before / total.rows;
    out.recording_chi2_per_dof_after = total.after / total.rows;
  }
  out.recordings_disagree = out.improves && !(out.recording_gain > 0.0);
  out.improves = out.improves && !out.recordings_disagree;
  return out;
}

}  // namespace

double held_out_gain(const search::Fitted& before, const search::Fitted& after) {
  const Predictor with(after.problem, after.noise.model),
      without(before.problem, after.noise.model);
  const std::vector<HeldOutPart> parts = positions_of(before.problem);
  const auto gains = mc::run_campaign(parts.size(), [&](std::size_t k) {
    return with.predict(parts[k].intervals).log_score -
           without.predict(parts[k].intervals).log_score;
  });
  return std::accumulate(gains.begin(), gains.end(), 0.0);
}

HeldOut held_out(const search::Fitted& nominal, const search::Fitted& patched,
                 const MeasuredTest& test, const std::vector<std::size_t>& named,
                 double library_threshold, const FoldOptions& options) {
  std::vector<HeldOutPart> parts = positions_of(nominal.problem);
  const auto positions = static_cast<std::ptrdiff_t>(parts.size());
  for (HeldOutPart& p : recordings_of(nominal.problem, options.recording_ends))
    parts.push_back(std::move(p));
  HeldOut out;
  if (!parts.empty()) {
    const Folder folder(nominal, patched, test, named, library_threshold, options.method);
    std::atomic<std::size_t> done{0};
    std::vector<Outcome> outcomes = mc::run_campaign(parts.size(), [&](std::size_t k) {
      Outcome o = folder.run(parts[k]);
      const std::size_t count = ++done;
      if (options.progress) options.progress(count, parts.size());
      return o;
    });
    const auto middle = outcomes.begin() + positions;
    out = with_recordings(over_positions({outcomes.begin(), middle}), {middle, outcomes.end()});
  }
  out.method = options.method == FoldMethod::linear ? "linear" : "refitted";
  return out;
}

}  // namespace drift::diagnosis
