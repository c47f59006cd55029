#pragma once

#include "core/sim/measurements.hpp"

namespace drift {

/// A test that was made: where and when, how well it is read, what was measured.
struct MeasuredTest {
  const Timeline& timeline;
  const Readout& readout;
  const Measurements& measured;
};

}  // namespace drift
