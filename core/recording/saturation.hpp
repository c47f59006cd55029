#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/recording/recording.hpp"

namespace drift {

/// Rows in which a sensor reads one value more often than its noise can make it.
struct Saturation {
  enum class At { low, high, between };  ///< of all that the channel reads

  std::string channel;
  double value = 0.0;  ///< [internal units]
  At at = At::high;
  std::vector<std::size_t> rows;  ///< ascending

  std::size_t runs() const;  ///< of rows that follow each other
};

/// A sensor that moves and has noise hardly ever reads one value twice: whatever it measures, noise
/// sigma puts it into one step q of the readout with
///
///   p = erf(q / (sqrt(8) sigma))
///
/// at most. A reading at the end of the range is the same every time. So a channel is at an end of
/// its range where its least or greatest reading comes back k - 1 times among the n readings within
/// ten sigma of it, which chance does with P(X >= k - 1), X binomial of n - 1 and p, in less than
/// one recording of a thousand (all sensors and both ends together). Likewise a gyro that turns
/// (reads ten sigma and more off its median) and stands at one value for a run of rows, which p has
/// as long in less than one recording of a thousand.
///
/// sigma: of the quietest quarter of the recording by third differences, less the most that steps
/// may add (q / 2), as what is slow or filtered is no noise; p is at least the part of readings
/// that are repeated anywhere (a log that is faster than its sensor). Where steps hide the noise p
/// is one, and nothing is found: of such a readout a rest and a constant rate stand at one value,
/// too. A gyro that never turns so far has no end.
inline constexpr double saturated_by_chance = 1e-3;

/// What is found of a channel; sensors: how many channels are looked at.
std::vector<Saturation> saturations(const Recording& recording, const Channel& channel,
                                    std::size_t sensors);

/// The same of all gyros of a recording.
std::vector<Saturation> saturated_gyros(const Recording& recording);

}  // namespace drift
