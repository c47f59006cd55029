#pragma once

#include <cmath>
#include <vector>

#include "analysis/inference/linear_problem.hpp"
#include "analysis/inference/noise/noise_model.hpp"
#include "core/base/units.hpp"

namespace drift::inference {

/// Where something usually is: a sigma to either side of the middle, in the logarithm.
struct Usual {
  double low, high;
  double middle() const { return 0.5 * std::log(low * high); }
  double spread() const { return 0.5 * std::log(high / low); }
  /// Distance of a value from the middle, in spreads.
  double z(double value) const { return (std::log(value) - middle()) / spread(); }
};

/// One standard deviation of the noise model.
struct NoiseComponent {
  const char* name;  ///< of NoiseFinding
  double NoiseModel::*sigma;
  double NoiseModel::*tau;  ///< null if it has none
  Unit unit;
  /// Sizes that instruments usually have (physics.md 4, effects 8 to 11), SI; of correlated
  /// accelerometer noise in declared sigmas of a sample.
  Usual size;
  Usual time = {1.0, 1.0};  ///< of the time constant [s]

  bool white() const {
    return sigma == &NoiseModel::acc_factor || sigma == &NoiseModel::gimbal_factor;
  }
  bool in(const NoiseModel& m) const { return m.*sigma > 0.0; }
};

inline constexpr NoiseComponent acc_white{
    "accelerometer_white", &NoiseModel::acc_factor, nullptr, unit::one, {0.5, 2.0}};
inline constexpr NoiseComponent gimbal_white{
    "gimbal_white", &NoiseModel::gimbal_factor, nullptr, unit::one, {0.5, 2.0}};
inline constexpr NoiseComponent angle_walk{
    "angle_random_walk",
    &NoiseModel::angle_random_walk,
    nullptr,
    unit::deg_per_sqrt_h,
    {3e-4 * unit::deg_per_sqrt_h.to_si, 3e-3 * unit::deg_per_sqrt_h.to_si}};
inline constexpr NoiseComponent drift_walk{
    "drift_random_walk",
    &NoiseModel::drift_random_walk,
    nullptr,
    unit::deg_per_h_per_sqrt_h,
    {1e-3 * unit::deg_per_h_per_sqrt_h.to_si, 5e-3 * unit::deg_per_h_per_sqrt_h.to_si}};
inline constexpr NoiseComponent markov_drift{
    "markov_drift",
    &NoiseModel::markov_drift,
    &NoiseModel::markov_tau,
    unit::deg_per_h,
    {2e-3 * unit::deg_per_h.to_si, 1e-2 * unit::deg_per_h.to_si},
    {600.0, 3600.0}};
/// Of each caging (shutdown to shutdown), physics.md 4, effect 10.
inline constexpr NoiseComponent caging_drift{
    "caging_drift",
    &NoiseModel::caging_drift,
    nullptr,
    unit::deg_per_h,
    {3e-3 * unit::deg_per_h.to_si, 3e-2 * unit::deg_per_h.to_si}};
inline constexpr NoiseComponent acc_markov{
    "accelerometer_markov", &NoiseModel::acc_markov, &NoiseModel::acc_tau, unit::ug, {0.2, 1.2},
    {150.0, 900.0}};

/// Every component beside white noise of the instruments.
inline constexpr const NoiseComponent* beside_white[] = {&angle_walk, &drift_walk, &markov_drift,
                                                         &caging_drift, &acc_markov};

/// Where the size of a component usually is, in units of `acc_sigma` for the accelerometers' [g].
/// What is declared is so within a factor of two. Of gyros that are declared coarser than those of
/// physics.md, data sheets state a bias instability B of 5 to 60 times the angle random walk N per
/// sqrt(h); the drift walks by B^2 / N per sqrt(h), as the Allan deviation has its floor where the
/// two cross.
Usual usual_size(const NoiseComponent& c, const NoiseModel& declared);
inline double unit_of(const NoiseComponent& c, double acc_sigma) {
  return &c == &acc_markov ? acc_sigma : 1.0;
}

/// Rows of the instruments; cagings of a platform after the first of each recording.
struct RowCounts {
  std::size_t accelerometer = 0, gimbal = 0, cagings = 0;
  explicit RowCounts(const MeasuredRows& rows);
  std::size_t of(const NoiseComponent& white) const {
    return &white == &acc_white ? accelerometer : gimbal;
  }
};

/// A component that may be added, with the time constant to be tried [s].
struct Addition {
  const NoiseComponent* component = nullptr;
  double tau = 0.0;
};

/// Of one caging more, the fixed drift is the mean of two, and their difference what any ramp
/// makes of it.
inline constexpr std::size_t least_cagings = 2;

/// Whether a drift that each caging draws anew may be noise. It is as free as the data of one
/// dwell: what it stands for must have lost first (drift_of_cagings()).
enum class Cagings { alike, may_differ };

/// What `model` leaves out and the rows can show: time constants on a coarse grid.
std::vector<Addition> possible_additions(const NoiseModel& model, const RowCounts& rows,
                                         Cagings cagings);

}  // namespace drift::inference
