#include "analysis/diagnosis/judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/diagnosis/held_out/held_out.hpp"
#include "analysis/diagnosis/noise_found.hpp"
#include "analysis/inference/thresholds.hpp"

namespace drift::diagnosis {
namespace {

/// How much likelier (log) the rows are with a factor of noise more than was found, less what one
/// more number costs. Of n rows with a chi-square of n x the best factor is x, and gains
/// n (x - 1 - log x) / 2. Infinite where the likelihood is not a number.
double log_gain_of_more_noise(const inference::Marginal& m) {
  if (m.rows == 0) return 0.0;
  if (!std::isfinite(m.log_likelihood2())) return std::numeric_limits<double>::infinity();
  const auto n = static_cast<double>(m.rows);
  const double x = m.chi2 / n;
  if (x < inference::NoiseLimits::far_off) return 0.0;
  return 0.5 * n * (x - 1.0 - std::log(x)) + inference::NoisePrior::log_not_as_declared() -
         0.5 * std::log(n);
}

/// White noise of more than the prior of its factor has with NoiseLimits::significant_p; 180 times
/// what is declared.
std::optional<remark::IncredibleNoise> incredible_noise(const search::Fitted& nominal) {
  std::optional<remark::IncredibleNoise> worst;
  for (const inference::NoiseFinding& f : nominal.noise.findings) {
    if (!f.component.ends_with("_white") || !(f.factor > 1.0)) continue;
    const double chance = inference::NoisePrior::chance_of_factor(f.factor);
    if (chance < inference::NoiseLimits::significant_p && (!worst || f.factor > worst->factor))
      worst = remark::IncredibleNoise{f.component, f.factor, chance};
  }
  return worst;
}

/// Nothing is missing, but for noise that nobody has.
Judged consistent_unless_noise(Judged out, const search::Fitted& nominal) {
  const auto noise = incredible_noise(nominal);
  if (out.verdict != Verdict::consistent || !noise) return out;
  out.verdict = Verdict::unexplained;
  out.of_no_noise = noise->chance;
  out.remarks.emplace_back(*noise);
  return out;
}

}  // namespace

std::vector<double> judge_members(const search::Fitted& nominal, const MeasuredTest& test,
                                  const search::Refit& best, const search::Search& found) {
  std::vector<double> gains;
  if (best.choices.size() < 2) return gains;
  for (std::size_t k = 0; k < best.choices.size(); ++k) {
    std::vector<search::Choice> others = best.choices;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    const search::Refit* known = nullptr;
    for (const auto* all : {&found.sets, &found.rejected, &found.beside})
      for (const search::Refit& r : *all)
        if (same(r.choices, others)) known = &r;
    gains.push_back(
        held_out_gain(known ? known->after
                            : search::refit(nominal, test, others, found.thresholds,
                                            search::noise_beside(nominal), search::Sizes::as_found)
                                  .after,
                      best.after));
  }
  return gains;
}

Judged judge(const search::Fitted& nominal, const search::Search& found,
             const search::Posterior& posterior, const HeldOut& held_out,
             const std::vector<double>& member_gains, NamedBy by) {
  Judged out;
  constexpr double credible = inference::SearchLimits::credible;
  const double noise = posterior.consistent + posterior.noise_only;
  const bool or_priors = posterior.wrong_priors + posterior.other_priors > 1.0 - credible;
  if (!found.significant) {
    out.one_gyro = noise_of_one_axis(nominal);
    if (const double gain = log_gain_of_more_noise(nominal.projector->marginal());
        gain > inference::NoiseLimits::far_likelier)
      out.of_no_noise = std::exp(-gain);
    if (out.one_gyro || out.of_no_noise) {
      out.verdict = Verdict::unexplained;
    } else if (const double nothing = noise + posterior.wrong_priors; nothing < 1.0 - credible) {
      out.verdict = Verdict::ambiguous;
      out.likelier_missing = {nothing};
    }
    return consistent_unless_noise(std::move(out), nominal);
  }
  const search::Refit* best = found.sets.empty() ? nullptr : &found.sets.front();
  // Chance is what is more probable; noise or priors that explain the same as an effect must be
  // credible.
  if (noise > (best && found.noise_alone ? credible : inference::SearchLimits::chance) ||
      noise + posterior.wrong_priors > credible)
    return consistent_unless_noise(std::move(out), nominal);
  const bool one = found.sets.size() == 1, or_noise = noise > 1.0 - credible;
  const bool members = std::all_of(member_gains.begin(), member_gains.end(), [](double gain) {
    return gain >= inference::WeighLimits::held_out;
  });
  const bool judged =
      by == NamedBy::fit_alone || held_out.folds.empty() || (held_out.improves && members);
  const bool nameable = !best || (best->nameable && !found.just_not);
  const bool alone = one && !or_noise && !or_priors;
  out.verdict = !best && posterior.wrong_priors <= 1.0 - credible ? Verdict::unexplained
                : !best                                           ? Verdict::ambiguous
                : alone && judged && nameable                     ? Verdict::named
                                                                  : Verdict::ambiguous;
  if (found.just_not)
    out.remarks.emplace_back(remark::JustSignificantLeft{});
  else if (one && !nameable)
    out.remarks.emplace_back(remark::LambdaNotSettled{});
  if (best && or_noise) out.remarks.emplace_back(remark::OrNoise{noise});
  if (one && !judged && !members)
    out.remarks.emplace_back(remark::MemberNotConfirmed{});
  else if (one && !judged)
    out.remarks.emplace_back(remark::NotPredicted{held_out.recordings_disagree});
  return out;
}

}  // namespace drift::diagnosis
