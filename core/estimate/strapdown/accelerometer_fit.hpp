#pragma once

#include <span>
#include <vector>

#include "core/estimate/strapdown/estimate.hpp"

namespace drift::strapdown {

/// Model of the accelerometers, each containing the one before.
enum class AccelerometerModel {
  nominal,     ///< as the recording says
  bias_scale,  ///< K0, K1 of each axis
  misaligned,  ///< and the three angles between the input axes
  quadratic,   ///< and K2 of each axis
};

/// The parameters a model estimates, as indices of TermLibrary. |a| = 1 g does not change when all
/// three axes turn together, so three of the six angles define the case axes: x is the input axis
/// of accelerometer x, and y lies in the plane of the input axes of x and y. Left are dO_y, dP_z,
/// dO_z.
std::vector<std::size_t> parameters_of(AccelerometerModel model);

/// Specific force from accelerometer outputs: the accelerometer equation solved
/// for a.
class SpecificForce {
 public:
  explicit SpecificForce(const Theta& theta);
  Vec3 operator()(const Vec3& output) const;  ///< [g] from [g]

 private:
  Theta theta_;
  Mounting mounting_;
  Mat3 inverse_;  ///< of the linear part
  bool linear_;
};

/// Estimates the model from the mean outputs of dwells, in which |a| = 1 g, by least squares.
Estimate fit_accelerometers(AccelerometerModel model, std::span<const Vec3> outputs);

}  // namespace drift::strapdown
