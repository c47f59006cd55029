#include "analysis/diagnosis/noise_found.hpp"

#include <cmath>

#include "analysis/inference/evidence.hpp"
#include "analysis/inference/noise/noise_component.hpp"
#include "analysis/inference/thresholds.hpp"

namespace drift::diagnosis {

void NoiseFound::take(const inference::NoiseEstimate& noise) {
  findings = noise.findings;
  driving = noise.driven ? std::optional(noise.model) : std::nullopt;
}

NoiseFound noise_found(const search::Fitted& fitted,
                       const std::vector<identification::Spike>& spikes) {
  NoiseFound out;
  out.take(fitted.noise);
  std::size_t lowered = 0;
  for (const double w : fitted.problem.weight) lowered += w < 1.0;
  const std::size_t removed = spikes.size();
  if (removed + lowered == 0) return out;
  inference::NoiseFinding f;
  f.component = "outliers";
  f.factor = f.factor_sigma = std::nan("");
  f.unit = "samples";
  f.value = static_cast<double>(removed + lowered);
  f.count = removed;
  f.significant = true;
  f.p_value = inference::RemarkLimits::outliers_p;
  out.findings.push_back(f);
  out.remarks.emplace_back(remark::SamplesLeftOut{spikes, lowered});
  return out;
}

std::optional<remark::DrivesOneGyro> noise_of_one_axis(const search::Fitted& nominal) {
  const inference::NoiseModel& all = nominal.noise.model;
  if (!nominal.noise.driven ||
      all.angle_random_walk + all.drift_random_walk + all.markov_drift + all.caging_drift == 0.0)
    return std::nullopt;
  const inference::MarginalLikelihood likelihood(nominal.problem);
  const auto value = [&](const inference::NoiseModel& m) { return likelihood.log_likelihood2(m); };
  const double together = value(all);
  remark::DrivesOneGyro best{-1, 0.0};
  for (int a = 0; a < 3; ++a)
    for (const double factor : {0.7, 1.0, 1.6, 2.5}) {
      inference::NoiseModel one = all;
      one.gyros = factor * Vec3::Unit(a);
      const double gain = value(one) - together;
      if (gain > best.gain) best = {a, gain};
    }
  if (best.gain < inference::NoiseLimits::one_gyro) return std::nullopt;
  return best;
}

std::optional<remark::NoiseOrEffect> noise_or_effect(const search::Fitted& nominal) {
  using inference::RemarkLimits;
  if (!nominal.noise.driven) return std::nullopt;
  const inference::NoiseModel declared = search::declared_noise(nominal.filter);
  inference::NoiseModel plain = nominal.noise.model;
  for (const inference::NoiseComponent* c : inference::beside_white)
    plain.*(c->sigma) = declared.*(c->sigma);
  const inference::Evidence seen =
      inference::evidence_under(nominal.problem, nominal.set, plain, {});
  const auto worth = [&](std::size_t k) {
    return seen.gains[k].ratio - RemarkLimits::or_effect_per_amplitude * (seen.gains[k].dof - 1);
  };
  std::size_t best = 0;
  for (std::size_t k = 1; k < seen.gains.size(); ++k)
    if (worth(k) > worth(best)) best = k;
  if (seen.gains.empty() || worth(best) < RemarkLimits::or_effect) return std::nullopt;
  const inference::Candidate& c = nominal.set.candidates[best];
  return remark::NoiseOrEffect{{c.term, c.axis, c.label}, std::sqrt(seen.gains[best].ratio)};
}

}  // namespace drift::diagnosis
