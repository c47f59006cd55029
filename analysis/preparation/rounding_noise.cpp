#include "analysis/preparation/rounding_noise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/words.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/reading_step.hpp"

namespace drift::preparation {
namespace {

/// Channels of one kind that are written in steps, and the one whose rounding is worst.
struct Steps {
  std::vector<std::string> names;
  const Channel* worst = nullptr;
  double step = 0.0, noise = 0.0;  ///< of that one, internal unit
};

/// Rows of a position on average that show one value one after the other.
double usual_run(const Channel& c, const Channel* position) {
  std::size_t rows = 0, runs = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (!std::isfinite(c.values[i])) continue;
    ++rows;
    const bool goes_on = i > 0 && c.values[i] == c.values[i - 1] &&
                         (position == nullptr || position->values[i] == position->values[i - 1]);
    runs += goes_on ? 0 : 1;
  }
  return runs == 0 ? 1.0 : static_cast<double>(rows) / static_cast<double>(runs);
}

Steps steps_of(const std::vector<Recording>& recordings, const ChannelTriple& channels) {
  Steps found;
  for (const Recording& r : recordings)
    for (const std::string_view name : channels.names) {
      const Channel *c = r.find(name), *position = r.find("position");
      const auto step = c != nullptr ? reading_step(*c, position) : std::nullopt;
      if (!step) continue;
      if (std::ranges::find(found.names, name) == found.names.end()) found.names.emplace_back(name);
      const double noise = *step * std::sqrt(usual_run(*c, position) / 12.0);
      if (noise > found.noise) found = {std::move(found.names), c, *step, noise};
    }
  return found;
}

/// `noise` becomes that of rounding where it is less; `unit`: of the remark.
void take(const Steps& steps, double& noise, bool& rounded, const Unit& unit,
          std::vector<std::string>& remarks) {
  if (!(steps.noise > noise)) return;
  rounded = true;
  remarks.push_back(fmt::format(
      "{} {} written in steps of {:.3g} {}: rounding makes a noise of {:.3g} {}, which is taken in "
      "place of the {:.3g} {} of [readout]",
      listed(steps.names, "and"), steps.names.size() == 1 ? "is" : "are",
      steps.step / steps.worst->unit.to_si, steps.worst->unit.symbol.view(),
      steps.noise / unit.to_si, unit.symbol.view(), noise / unit.to_si, unit.symbol.view()));
  noise = steps.noise;
}

}  // namespace

void take_rounding(const std::vector<Recording>& recordings, Readout& readout,
                   std::vector<std::string>& remarks) {
  if (readout.accelerometers)
    take(steps_of(recordings, accelerometer_channels), readout.accelerometer_noise,
         readout.accelerometers_rounded, unit::ug, remarks);
  if (readout.gimbals)
    take(steps_of(recordings, gimbal_channels), readout.gimbal_noise, readout.gimbals_rounded,
         unit::arcsec, remarks);
}

}  // namespace drift::preparation
