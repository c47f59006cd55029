#pragma once

#include <cstddef>
#include <optional>

#include "core/recording/recording.hpp"

namespace drift {

/// What two recordings have in common whose noise is one.
struct SharedNoise {
  std::size_t readings = 0;  ///< of both at one time, where noise turns about
  double alike = 0.0;        ///< part of them that turn to the same side; of two tests 0.5
};

/// Whether the noise of one recording is that of another: one log at two intervals, as readings, as
/// means of them, or as every other row, none of which need be equal. Empty: it is not.
///
/// Looked at are the times at rest that both have, the clock of one shifted by what makes their
/// positions end together; accelerometers and gyros as they are read there or as means since the
/// time before, gimbal angles likewise. Two tests of one unit share their course, so that only
/// readings count about which both turn, as in shared_rows(): third differences change their sign.
/// To which side they do is chance in two tests. Of one noise with correlation r the same sides
/// exceed the others by about r of all: 1 of equal readings, 0.7 of a reading and the mean of two.
/// Two recordings are one log where every triple of sensors that shows noise has an excess above a
/// third and that of one is less likely by chance, among all clocks and means that are tried, than
/// chance_of_repeated_rows. How it scatters by chance is what other alignments of the same sides
/// show: what swings in both tests at one frequency is alike in those, too. What does not pass four
/// steps of the readout, or a hundred millionth of the largest reading, is no noise here: of
/// rounding, and of what was computed without noise, two tests have the same.
std::optional<SharedNoise> shared_noise(const Recording& a, const Recording& b);

}  // namespace drift
