#include "analysis/inference/noise/gross_misfit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/inference/noise/noise_component.hpp"
#include "analysis/inference/thresholds.hpp"
#include "core/stats/median.hpp"

namespace drift::inference {

NoiseEstimate noise_of_differences(const MeasuredRows& rows, const VecX& residual) {
  // Second differences of a channel within a position: variance 6 sigma^2, blind to slopes. Their
  // median is blind to outliers too.
  std::array<std::vector<double>, 2> squares;
  std::array<std::vector<double>, num_channels> last;
  std::array<int, num_channels> position{};
  for (std::size_t k = 0; k < rows.tags.size(); ++k) {
    const RowTag& t = rows.tags[k];
    auto& seen = last[t.channel];
    if (position[t.channel] != t.position) seen.clear();
    position[t.channel] = t.position;
    seen.push_back(residual[k]);
    if (const std::size_t n = seen.size(); n >= 3) {
      const double d = seen[n - 1] - 2.0 * seen[n - 2] + seen[n - 3];
      squares[t.accelerometer() ? 0 : 1].push_back(d * d / 6.0);
    }
  }
  constexpr double median_of_square = 0.4549;  // of a standard normal
  NoiseEstimate out;
  out.of_differences = true;
  for (const int kind : {0, 1}) {
    const auto& s = squares[kind];
    if (s.size() < 10 || (kind == 0 ? rows.acc_rounded : rows.gimbals_rounded)) continue;
    const double factor = std::sqrt(std::max(stats::upper_median(s) / median_of_square, 1e-6));
    (kind == 0 ? out.model.acc_factor : out.model.gimbal_factor) = factor;
    // The median has 37 % efficiency, differences about half of the rows' information.
    out.findings.push_back(
        white_finding(kind == 0 ? "accelerometer_white" : "gimbal_white", factor,
                      1.0 / std::sqrt(2.0 * 0.37 * 0.5 * static_cast<double>(s.size())), s.size()));
  }
  // Not at a maximum of the likelihood: Schwarz's price.
  out.log_price = NoisePrior::log_not_as_declared() -
                  0.5 * std::log(std::max<double>(1.0, static_cast<double>(rows.rows()))) *
                      static_cast<double>(out.findings.size());
  return out;
}

bool grossly_wrong(const MeasuredRows& rows, const VecX& residual,
                   const NoiseEstimate& differences) {
  double chi2 = 0.0;
  for (Eigen::Index k = 0; k < residual.size(); ++k) {
    const double factor = rows.tags[k].accelerometer() ? differences.model.acc_factor
                                                       : differences.model.gimbal_factor;
    chi2 += residual[k] * residual[k] / (factor * factor);
  }
  return chi2 > SampleLimits::gross * static_cast<double>(residual.size());
}

bool driven_as_usual(const MeasuredRows& rows, const NoiseEstimate& noise,
                     const NoiseModel& declared) {
  bool driven = false;
  for (const NoiseComponent* c : noise.components) {
    if (c->white()) continue;
    driven = true;
    const double size = noise.model.*(c->sigma) / unit_of(*c, rows.acc_sigma);
    if (usual_size(*c, declared).z(size) > NoisePrior::usual) return false;
  }
  return driven;
}

}  // namespace drift::inference
