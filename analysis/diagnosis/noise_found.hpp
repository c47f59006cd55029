#pragma once

#include <optional>
#include <vector>

#include "analysis/diagnosis/findings/remark.hpp"
#include "analysis/inference/noise/noise_finding.hpp"
#include "analysis/search/fitted.hpp"

namespace drift::diagnosis {

/// What was found about the noise, outliers among it.
struct NoiseFound {
  std::vector<inference::NoiseFinding> findings;
  std::vector<Remark> remarks;
  /// Where it drives the platform beyond what is declared.
  std::optional<inference::NoiseModel> driving = {};

  /// Another noise in the place of the one that was estimated.
  void take(const inference::NoiseEstimate& noise);
};

/// spikes: samples left out as outliers.
NoiseFound noise_found(const search::Fitted& fitted,
                       const std::vector<identification::Spike>& spikes);

/// Noise that drives all gyros alike is noise. Where one gyro alone explains the test decisively
/// better, it is something that happens to this axis.
std::optional<remark::DrivesOneGyro> noise_of_one_axis(const search::Fitted& nominal);

/// Where noise that drives the platform leaves nothing significant: what would be, were it no
/// noise.
std::optional<remark::NoiseOrEffect> noise_or_effect(const search::Fitted& nominal);

}  // namespace drift::diagnosis
