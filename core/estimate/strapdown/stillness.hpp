#pragma once

#include <vector>

#include "core/estimate/strapdown/dwells.hpp"

namespace drift::strapdown {

/// What the sensors read on average over some samples.
struct MeanReading {
  double start = 0.0, end = 0.0;                 ///< [s]
  Vec3 gyro = Vec3::Zero(), acc = Vec3::Zero();  ///< [rad/s], [g]
};

/// Over the intervals that end at samples first + 1 .. last.
MeanReading mean_reading(const Signals& signals, std::size_t first, std::size_t last);

/// The sample between the two halves of a dwell.
inline std::size_t middle_of(const Dwell& dwell) {
  return (dwell.first + dwell.last) / 2;
}

/// Which dwells of a unit whose gyros do not see the Earth are rests to its gyros, and how well the
/// mean of half of one is known. A unit held in the hand is quiet enough for its accelerometers;
/// what its gyros read is the hand.
struct Stillness {
  std::vector<bool> still;  ///< of each dwell
  double acc_noise = 0.0;   ///< 1 sigma of the mean over half of a still dwell [g]
  double gyro_noise = 0.0;  ///< likewise [rad/s]
  double half = 0.0;        ///< mean length of half of a still dwell [s]
};

/// Still is a dwell in which the gyros scatter at most twice as much as in the quietest quarter of
/// all, and whose halves differ by less than five sigma. That sigma is what the halves of dwells
/// differ by: such sensors wander within a dwell, and nobody declares by how much.
Stillness stillness_of(const Signals& signals, const std::vector<Dwell>& dwells);

}  // namespace drift::strapdown
