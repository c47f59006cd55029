#include <algorithm>
#include <cmath>

#include "analysis/inference/thresholds.hpp"
#include "analysis/report/study/sections.hpp"
#include "core/physics/stochastic.hpp"

namespace drift::report {
namespace {

/// What the pairs of one kind (with the right model, a wrong equation, or the right equation and
/// something of the truth left out) have in common.
struct Tally {
  std::size_t pairs = 0;
  std::vector<std::string> models;           ///< in words, each once
  double least_held = 1.0, most_held = 0.0;  ///< share of the errors within 2 sigma
  const Pair* worst = nullptr;               ///< of the most silent failures
  stats::Rate silent = {};
  double silent_at_most = 0.0;  ///< over all pairs, the upper end of the interval
  double sigmas_off = 1.0;      ///< factor between errors and sigmas of the worst pair
  const Pair* overconfident = nullptr;
  const Pair* not_linear = nullptr;  ///< the worst whose truths are those that it believes in
  const Pair* unclaimed = nullptr;   ///< of the parameter that is farthest off
  double times = 0.0;                ///< of its sigma
  const Pair* diverged = nullptr;    ///< of the most runs without an estimate
  std::size_t pairs_diverged = 0;    ///< that have such runs
  const Pair* unlike = nullptr;      ///< the one with the largest innovations, of those too large
};

const mc::StartStatistics& first_start(const StudyResults& results, const Pair& pair) {
  return statistics_of(results, pair).starts().front();
}

/// Whether errors are larger than the sigmas by more than chance where the filter knows all there
/// is to know: what is left is that it is linear about one estimate.
bool not_linear(const StudyResults& results, const Pair& pair) {
  const mc::Study& study = results.points[pair.point].study;
  return mc::drawn_from_beliefs(study.truth, study.filters[pair.filter]) &&
         first_start(results, pair).nees.sigmas_above() > inference::FitLimits::misfit;
}

void add(Tally& tally, const StudyResults& results, const Pair& pair) {
  const mc::FilterStatistics& filter = statistics_of(results, pair);
  const stats::Rate& silent = filter.starts().front().silent;
  ++tally.pairs;
  if (silent.of > 0) tally.silent_at_most = std::max(tally.silent_at_most, silent.high());
  if (std::string model = model_in_words(left_out(results, pair));
      std::ranges::find(tally.models, model) == tally.models.end())
    tally.models.push_back(std::move(model));
  if (const double held = coverage_of_claims(filter, claims_of(results)); std::isfinite(held)) {
    tally.least_held = std::min(tally.least_held, held);
    tally.most_held = std::max(tally.most_held, held);
  }
  if (const double off = sigmas_off(filter.starts().front()); off > tally.sigmas_off) {
    tally.sigmas_off = off;
    tally.overconfident = &pair;
  }
  if (const auto off = far_off(filter); off && off->times > tally.times) {
    tally.unclaimed = &pair;
    tally.times = off->times;
  }
  if (const stats::Rate& diverged = filter.starts().front().diverged; diverged.hits > 0) {
    ++tally.pairs_diverged;
    if (tally.diverged == nullptr ||
        diverged.value() > first_start(results, *tally.diverged).diverged.value())
      tally.diverged = &pair;
  }
  if (not_linear(results, pair) &&
      (tally.not_linear == nullptr ||
       sigmas_off(filter.starts().front()) > sigmas_off(first_start(results, *tally.not_linear))))
    tally.not_linear = &pair;
  if (const mc::ChiSquareSum& nis = filter.starts().front().nis;
      nis.sigmas_above() > inference::FitLimits::misfit &&
      (tally.unlike == nullptr || nis.mean() > first_start(results, *tally.unlike).nis.mean()))
    tally.unlike = &pair;
  if (tally.worst == nullptr || silent.value() > tally.silent.value()) {
    tally.worst = &pair;
    tally.silent = silent;
  }
}

std::string held_text(const Tally& t) {
  if (t.most_held < t.least_held) return "";
  const std::string least = percent_cell(t.least_held).text, most = percent_cell(t.most_held).text;
  return fmt::format("2 sigma hold {} % of the errors (95.4 expected); ",
                     least == most ? least : fmt::format("{} to {}", least, most));
}

/// "without sag of the truth, or without drift_ramp of the truth".
std::string models_text(const Tally& t) {
  constexpr std::size_t most = 3;
  const std::size_t shown = std::min(most, t.models.size());
  return fmt::format("{}{}", fmt::join(t.models.begin(), t.models.begin() + shown, ", or "),
                     shown < t.models.size() ? ", or others" : "");
}

/// Of pairs none of which fails silently none is the worst.
std::string worst_text(const StudyResults& results, const Tally& t) {
  if (t.silent.of > 0 && t.silent.hits == 0)
    return fmt::format("no silent failure{} (95 %: at most {} %)",
                       t.pairs > 1 ? " at any point" : "", percent_cell(t.silent_at_most).text);
  return fmt::format("silent failures in {}{} of the runs ({})", t.pairs > 1 ? "up to " : "",
                     rate_cell(t.silent).text, pair_in_words(results, *t.worst));
}

/// "filter eq6 (plan.preset = slew12: truth eq5)".
std::string filter_in_words(const StudyResults& results, const Pair& pair) {
  const std::string condition = condition_of(results.points[pair.point]);
  return fmt::format("filter {} ({}{}truth {})", statistics_of(results, pair).columns().name,
                     condition, condition.empty() ? "" : ": ",
                     key_of(results.points[pair.point].study.truth.coupling));
}

/// Whether samples that are wrong may be taken in: right after a caging, by what goes sample by
/// sample.
bool takes_outliers_in(const mc::Study& study) {
  return has_outliers(study.truth.model().terms) &&
         study.monte_carlo.estimator != mc::EstimatorKind::batch;
}

/// What makes sigmas too small where truths, noise and filter are alike, and what to do.
std::string estimator_text(const mc::Study& study) {
  if (takes_outliers_in(study))
    return "it meets the samples one by one, and right after a caging cannot tell an outlier from "
           "what it does not know yet. Set monte_carlo.estimator = \"batch\", which weighs all";
  return fmt::format(
      "it is linear about one estimate, and over what stays unknown the model is not (products of "
      "parameters, narrow effects). {}",
      study.monte_carlo.estimator == mc::EstimatorKind::ekf
          ? "Set monte_carlo.estimator = \"iterated\", which linearises anew"
          : "Go by the errors of this study, not by the sigmas");
}

/// Of a filter that is right but for its estimator, that.
std::string blamed_text(const StudyResults& results, const Pair& pair) {
  const mc::Study& study = results.points[pair.point].study;
  const bool blamed =
      matched(results, pair) &&
      (takes_outliers_in(study) || mc::drawn_from_beliefs(study.truth, study.filters[pair.filter]));
  return blamed ? fmt::format(" So it is the estimator: {}.", estimator_text(study)) : "";
}

/// What a filter whose sigmas are not to be trusted lacks, and whether its residuals show it.
std::string shown_text(const StudyResults& results, const Pair& pair) {
  const mc::LeftOut lacks = left_out(results, pair);
  const mc::StartStatistics& start = first_start(results, pair);
  const std::string model = lacks.nothing() ? "Its model is the truth's"
                                            : fmt::format("It {} {}", lacks.equation ? "has" : "is",
                                                          model_in_words(lacks));
  const auto estimated = static_cast<double>(start.healthy.of - start.diverged.hits);
  if (!(estimated > 0.0)) return model + "." + blamed_text(results, pair);
  const double alarms = 1.0 - static_cast<double>(start.healthy.hits) / estimated;
  return fmt::format("{}; its residuals alarm in {} % of the runs (by chance 5).{}", model,
                     percent_cell(alarms).text, blamed_text(results, pair));
}

/// Whatever the innovations say: the sigmas of such a filter are not those of its errors.
std::string sigmas_text(const StudyResults& results, const Tally& t) {
  return fmt::format(
      "Do not trust the sigmas of {}: errors are {} times as large (root of NEES/dof). {}",
      filter_in_words(results, *t.overconfident), number_text(t.sigmas_off, 2),
      shown_text(results, *t.overconfident));
}

std::string unclaimed_text(const StudyResults& results, const Pair& pair) {
  const mc::FilterStatistics& filter = statistics_of(results, pair);
  const FarOff off = far_off(filter).value();
  return fmt::format("Do not trust the sigma of {} in {}: its errors are {} times as large. {}",
                     far_off_text(filter, off), filter_in_words(results, pair),
                     number_text(off.times, 3), shown_text(results, pair));
}

std::string diverged_text(const StudyResults& results, const Tally& t) {
  return fmt::format("{}{} of the runs diverged ({}): errors, coverage and NEES are of the others.",
                     t.pairs_diverged > 1 ? "Up to " : "",
                     rate_cell(first_start(results, *t.diverged).diverged).text,
                     pair_in_words(results, *t.diverged));
}

std::string not_linear_text(const StudyResults& results, const Pair& pair) {
  const mc::StartStatistics& start = first_start(results, pair);
  const double off = sigmas_off(start), chance = std::sqrt(start.nees.high());
  // Many runs show what nobody would mind.
  const std::string how_much =
      off < 1.1
          ? fmt::format("{} % larger (root of NEES/dof, by chance up to {} %",
                        number_text(100.0 * (off - 1.0), 2), number_text(100.0 * (chance - 1.0), 2))
          : fmt::format("{} times as large (root of NEES/dof, by chance up to {}",
                        number_text(off, 3), number_text(chance, 3));
  return fmt::format(
      "The sigmas are too small: errors are {}; {}). Truths, noise and filter are alike, so it is "
      "the estimator: {}.",
      how_much, pair_in_words(results, pair), estimator_text(results.points[pair.point].study));
}

/// A filter may have all of the truth and not follow its data: linear about a place far off, say.
std::string unlike_text(const StudyResults& results, const Pair& pair) {
  const mc::StartStatistics& start = first_start(results, pair);
  const int digits = start.nis.mean() < 1.1 ? 5 : 3;  // many runs show what is hardly there
  return fmt::format(
      "The innovations are not those that the filter expects: NIS/dof {} (by chance {} to {}; {}), "
      "and {} % of its runs look healthy.",
      number_text(start.nis.mean(), digits), number_text(start.nis.low(), digits),
      number_text(start.nis.high(), digits), pair_in_words(results, pair),
      percent_cell(start.healthy.value()).text);
}

/// What the sigmas and innovations of right filters are not; of one pair the graver of them.
void add_doubts(InBrief& brief, const StudyResults& results, const Tally& right) {
  const bool far_off = right.sigmas_off > much_too_small;
  if (right.not_linear != nullptr && !far_off)
    brief.more.add(Weight::doubtful, not_linear_text(results, *right.not_linear));
  const Pair* said = far_off ? right.overconfident : right.not_linear;
  if (right.unlike == nullptr || right.unlike == said) return;
  const bool evident = !(first_start(results, *right.unlike).nis.mean() < evident_misfit);
  brief.more.add(evident ? Weight::wrong : Weight::doubtful, unlike_text(results, *right.unlike));
  if (evident) brief.tone = Tone::bad;
}

}  // namespace

InBrief study_in_brief(const StudyResults& results) {
  const std::vector<Pair> pairs = pairs_of(results);
  Tally right, incomplete, wrong;
  std::size_t lost = 0;
  for (const Pair& pair : pairs) {
    if (results.statistics[pair.point].runs() == 0) continue;
    if (results.statistics[pair.point].failures().too_many()) {
      ++lost;
      continue;
    }
    const mc::LeftOut lacks = left_out(results, pair);
    add(lacks.equation ? wrong : lacks.nothing() ? right : incomplete, results, pair);
  }
  InBrief brief;
  brief.tone = Tone::good;
  if (const std::string unfinished = unfinished_text(results); !unfinished.empty()) {
    brief.more.add(Weight::wrong, unfinished);
    brief.tone = Tone::plain;
  }
  const auto say = [&](const Tally& t, const std::string& said) {
    if (brief.verdict.empty())
      brief.verdict = said;
    else
      brief.more.add(Weight::note, said);
    if (t.silent.low() > 0.01) brief.tone = Tone::bad;
  };
  if (wrong.pairs > 0)
    say(wrong, fmt::format("With the wrong equation: {}.", worst_text(results, wrong)));
  if (incomplete.pairs > 0)
    say(incomplete, fmt::format("A filter {}: {}{}.", models_text(incomplete),
                                held_text(incomplete), worst_text(results, incomplete)));
  if (right.pairs > 0)
    say(right, fmt::format("With {}: {}{}.", models_text(right), held_text(right),
                           worst_text(results, right)));
  for (const Tally* t : {&wrong, &incomplete, &right})
    if (t->sigmas_off > much_too_small) {
      brief.more.add(Weight::wrong, sigmas_text(results, *t));
      brief.tone = Tone::bad;
    } else if (t->unclaimed != nullptr) {
      brief.more.add(Weight::wrong, unclaimed_text(results, *t->unclaimed));
      brief.tone = Tone::bad;
    }
  for (const Tally* t : {&wrong, &incomplete, &right})
    if (t->diverged != nullptr) brief.more.add(Weight::doubtful, diverged_text(results, *t));
  add_doubts(brief, results, right);
  if (lost > 0) {
    brief.more.add(
        Weight::wrong,
        fmt::format(
            "Of {} pairs of point and filter nothing is said: too many of their runs were lost.",
            lost));
    if (brief.verdict.empty()) brief.verdict = "No result: too many runs were lost. See Failures.";
    brief.tone = Tone::bad;
  }
  if (brief.verdict.empty()) brief.verdict = "No result: there are no runs yet.";
  for (const std::string& term : broken_terms(results)) {
    brief.more.add(Weight::wrong, fmt::format("Failed runs: {}.", term));
    brief.tone = Tone::bad;
  }
  brief.more.add(
      Weight::note,
      "A silent failure: some parameter that the filter claims to know is more than 5 sigma off, "
      "and nothing in the run shows it.");
  return brief;
}

}  // namespace drift::report
