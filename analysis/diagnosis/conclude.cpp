#include "analysis/diagnosis/conclude.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "analysis/diagnosis/sentence.hpp"
#include "analysis/inference/evidence.hpp"

namespace drift::diagnosis {

void weigh_candidates(const search::Examination& nominal, const search::Search& found,
                      Diagnosis& d) {
  for (search::CandidateScore& line : d.candidates) {
    if (line.term != "frame_closure" || !(found.other_equation > line.score)) continue;
    line.score = found.other_equation;
    line.p_marginal =
        std::exp(-0.5 * found.other_equation);  // two points: P(2 log LR > T) <= exp(-T/2)
    line.p_value = std::min(1.0, found.nulls.library.p_value(0.5 * found.other_equation));
    line.log_bayes = 0.5 * found.other_equation;
    line.dof = 1;
    line.observable = true;
    line.amplitude = line.sigma = line.smallest_detectable = std::nan("");  // no small change
  }
  if (!found.sets.empty()) {
    double held = 0.0, linear = 0.0;
    std::vector<std::pair<std::string, double>> judged;  // label, probability
    for (std::size_t k = 0; k < found.sets.size(); ++k) {
      if (found.sets[k].choices.size() != 1) continue;
      judged.emplace_back(nominal.set.candidates[found.sets[k].choices.front().candidate].label,
                          found.probability[k]);
    }
    for (const double p : found.probability) held += p;
    const auto probability_of = [&](const search::CandidateScore& line) {
      const auto at = std::ranges::find(judged, line.label, &std::pair<std::string, double>::first);
      return at == judged.end() ? -1.0 : at->second;
    };
    for (const search::CandidateScore& line : d.candidates)
      if (probability_of(line) < 0.0) linear += line.probability;
    // What the credible set leaves is shared as the linear scores would have it.
    for (search::CandidateScore& line : d.candidates) {
      const double p = probability_of(line);
      line.adequate = p >= 0.0;
      line.probability = p >= 0.0       ? p
                         : linear > 0.0 ? line.probability * std::max(0.0, 1.0 - held) / linear
                                        : 0.0;
    }
  }
  // What the refits confirmed comes first.
  const auto confirmed = [&](const search::CandidateScore& c) {
    return !found.sets.empty() && c.adequate ? c.probability : -1.0;
  };
  std::ranges::stable_sort(
      d.candidates, [&](const search::CandidateScore& a, const search::CandidateScore& b) {
        if (confirmed(a) != confirmed(b)) return confirmed(a) > confirmed(b);
        return a.p_marginal != b.p_marginal ? a.p_marginal < b.p_marginal : a.score > b.score;
      });
}

void say_partial(const search::Examination& nominal, const search::Search& found, Diagnosis& d) {
  if (d.verdict != Verdict::unexplained || found.rejected.empty()) return;
  const auto chi2 = [](const search::Examination& e) {
    return e.fit.estimate.statistic /
           static_cast<double>(std::max<std::size_t>(1, e.fit.estimate.measured));
  };
  const auto best = std::ranges::min_element(found.rejected, {},
                                             [&](const search::Refit& r) { return chi2(r.after); });
  std::vector<std::string> labels, words;
  for (const search::Choice& choice : best->choices) {
    const inference::Candidate& c = nominal.set.candidates[choice.candidate];
    labels.push_back(c.label);
    words.push_back(fmt::format("{} ({})", in_words(c.term, c.axis), c.label));
  }
  const double before = chi2(nominal), after = chi2(best->after);
  const double excess = before > 1.0 ? (before - std::max(1.0, after)) / (before - 1.0) : 0.0;
  if (excess < 0.05) return;
  d.sentence += fmt::format(
      " The nearest known is {}: chi-square per degree of freedom goes from {:.3g} to {:.3g}, and "
      "something significant is left.",
      fmt::join(words, " together with "), before, after);
  const std::size_t k = best->remainder.strongest;
  if (k < best->after.set.candidates.size() &&
      best->remainder.library > found.nulls.library_threshold)
    d.remarks.push_back(fmt::format(
        "With {} in the model the strongest of what is left is {}: put the first into the nominal "
        "filter and diagnose again",
        fmt::join(labels, " and "), best->after.set.candidates[k].label));
}

void say_beyond_prior(const BatchResult& nominal, Diagnosis& d) {
  if (d.verdict == Verdict::named || d.verdict == Verdict::ambiguous)
    return;                           // the cause has moved them
  constexpr double unphysical = 5.0;  // prior sigmas
  constexpr std::size_t most = 6;
  std::vector<std::string> far;
  double farthest = 0.0;
  for (const ParameterEstimate& p : nominal.estimate.parameters) {
    const double off = p.prior_sigma > 0.0 ? std::abs(p.value - p.prior_mean) / p.prior_sigma : 0.0;
    if (off <= unphysical) continue;
    far.emplace_back(TermLibrary::specs[p.param].key.view());
    farthest = std::max(farthest, off);
  }
  if (far.empty()) return;
  const std::string more = far.size() > most ? fmt::format(" and {} more", far.size() - most) : "";
  far.resize(std::min(most, far.size()));
  d.remarks.push_back(
      fmt::format("The nominal fit takes {}{} up to {:.0f} sigmas from where their priors have "
                  "them. If that is not this "
                  "platform, the study is not of this recording: check [site] latitude, axes and "
                  "commands of the plan, "
                  "and the priors",
                  fmt::join(far, ", "), more, farthest));
}

void say_equation(Diagnosis& d) {
  const bool closure_is_a_cause = std::ranges::any_of(
      d.causes, [](const search::Cause& c) { return c.term == "frame_closure"; });
  if (!std::isfinite(d.other_equation_gain) || closure_is_a_cause ||
      d.other_equation_gain < -equation_told)
    return;
  const bool six = d.nominal.coupling == Coupling::eq6;
  const std::string both = fmt::format("This plan cannot tell the nominal eq. ({}) from eq. ({})",
                                       six ? 6 : 5, six ? 5 : 6);
  if (d.verdict == Verdict::consistent) d.sentence += fmt::format(" {}.", both);
  d.remarks.push_back(fmt::format(
      "{}: fitted with the other, the test is explained as well (twice the log of the odds: "
      "{:+.1f}). "
      "What tells lambda from the misalignments: slews about each platform axis, free drift beside "
      "level positions, or turns of the case. In slews, cross-talk between the torquing channels "
      "(torquer_crosstalk) looks like lambda",
      both, d.other_equation_gain));
}

void say_noise_or_effect(const search::Examination& nominal, Diagnosis& d) {
  constexpr double evident = 25.0, per_degree = 3.0;  // of twice the log likelihood
  if (d.verdict != Verdict::consistent || !nominal.noise.driven) return;
  const inference::NoiseModel declared = search::declared_noise(nominal.filter);
  inference::NoiseModel plain = nominal.noise.model;
  plain.angle_random_walk = declared.angle_random_walk;
  plain.drift_random_walk = declared.drift_random_walk;
  plain.markov_drift = plain.acc_markov = 0.0;
  const inference::Evidence seen =
      inference::evidence_under(nominal.problem, nominal.set, plain, {});
  const auto worth = [&](std::size_t k) {
    return seen.gains[k].ratio - per_degree * (seen.gains[k].dof - 1);
  };
  std::size_t best = 0;
  for (std::size_t k = 1; k < seen.gains.size(); ++k)
    if (worth(k) > worth(best)) best = k;
  if (seen.gains.empty() || worth(best) < evident) return;
  const inference::Candidate& c = nominal.set.candidates[best];
  d.remarks.push_back(fmt::format(
      "Without the noise that was found to drive the platform, {} would explain the test ({:.1f} "
      "sigma): a slow "
      "effect and such noise look alike here. More positions or longer dwells tell them apart",
      in_words(c.term, c.axis), std::sqrt(seen.gains[best].ratio)));
}

}  // namespace drift::diagnosis
