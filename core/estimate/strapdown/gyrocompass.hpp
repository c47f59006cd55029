#pragma once

#include <vector>

#include "core/estimate/strapdown/case_test.hpp"

namespace drift::strapdown {

/// Where North is, as far as the gyros at rest tell.
struct Gyrocompass {
  bool sees_earth = false;      ///< the Earth's rate stands out of the gyros' drift and noise
  std::vector<double> azimuth;  ///< of each chain, as lay_out_case() takes it [rad]
  double sigma = 1.0;           ///< 1 standard deviation of the worst [rad]; 1 where it is unknown
};

/// Where an axis of the case points.
struct AxisHeading {
  int axis = 0;          ///< x, y, z: the first of the case's that is within 45 deg of the horizon
  double azimuth = 0.0;  ///< of its horizontal part, from North to East about Up, 0 to 2 pi [rad]
};

/// Of a case that was levelled by what its accelerometers read, at an azimuth as Gyrocompass has
/// it (from North to West).
AxisHeading axis_heading(const Vec3& acc, double azimuth);

/// Sum of the Earth's rate and a fixed drift of each gyro, least squares on the dwells: the Earth's
/// horizontal rate of each chain (two numbers; the vertical is the latitude's) and the drift, with
/// the prior `sigma_drift` of each axis [rad/s]. Attitudes are those of the laid out test.
/// The Earth is seen where its rate is found within what the site says, and the azimuth to 0.3 rad,
/// unless it takes a prior of the drift that the drift contradicts. Sigmas are those of the noise
/// times the root of chi-square per degree of freedom of the dwells (1 at least).
Gyrocompass gyrocompass(const CaseTest& test, const std::vector<double>& assumed_azimuth,
                        double sigma_drift);

/// The Earth as the gyros at rest see it, with nothing of it from the site but the attitudes.
struct EarthSeen {
  double latitude = 0.0, sigma = 0.0;   ///< [rad]
  double rate = 0.0, sigma_rate = 0.0;  ///< of the whole [rad/s]
  std::vector<double> azimuth;          ///< as Gyrocompass has it
};

/// The same sum with the rate about Up unknown, too: of a gyro drift alone where the attitudes are
/// too few to tell the two apart, which sigma_rate shows.
EarthSeen earth_seen(const CaseTest& test, const std::vector<double>& assumed_azimuth,
                     double sigma_drift);

}  // namespace drift::strapdown
