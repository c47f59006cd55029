#include "analysis/identification/absent_channels.hpp"

#include <algorithm>

#include "core/sim/measurements.hpp"

namespace drift::identification {

std::vector<std::string> absent_channels(const std::vector<Recording>& recordings,
                                         const Readout& readout) {
  std::vector<Measurements> measured;
  for (const Recording& r : recordings) measured.push_back(measurements_of(r, readout));
  std::vector<std::string> absent;
  const auto look = [&](bool wanted, Mat3X Measurements::*values, const ChannelTriple& channels) {
    for (Eigen::Index a = 0; wanted && a < 3; ++a)
      if (std::ranges::none_of(measured, [&](const Measurements& m) {
            return (m.*values).row(a).array().isFinite().any();
          }))
        absent.emplace_back(channels.names[static_cast<std::size_t>(a)]);
  };
  look(readout.accelerometers, &Measurements::acc, accelerometer_channels);
  look(readout.gimbals, &Measurements::gimbal, gimbal_channels);
  return absent;
}

bool lacks(const std::vector<std::string>& absent, const ChannelTriple& instrument) {
  return std::ranges::all_of(instrument.names, [&](std::string_view name) {
    return std::ranges::find(absent, name) != absent.end();
  });
}

}  // namespace drift::identification
