#include "analysis/preparation/rounding_noise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/words.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/reading_step.hpp"

namespace drift::preparation {
namespace {

/// Rows on average, over the rows, that one rounding error lasts: as long as the rows of a position
/// go on by as many steps as before.
double usual_run(const Channel& c, const Channel* position, double step) {
  const auto& x = c.values;
  const auto steps = [&](std::size_t i) { return std::round((x[i] - x[i - 1]) / step); };
  const auto here = [&](std::size_t i) {
    return std::isfinite(x[i]) && std::isfinite(x[i - 1]) &&
           (position == nullptr || position->values[i] == position->values[i - 1]);
  };
  double rows = 0.0, squares = 0.0, run = 0.0;
  const auto end_run = [&] {
    squares += run * run;
    rows += run;
    run = 0.0;
  };
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i])) continue;
    const bool goes_on =
        i > 0 && here(i) && (run < 2.0 || (i > 1 && here(i - 1) && steps(i) == steps(i - 1)));
    if (!goes_on) end_run();
    run += 1.0;
  }
  end_run();
  return rows > 0.0 ? squares / rows : 1.0;
}

Steps steps_of(const std::vector<Recording>& recordings, const ChannelTriple& channels) {
  constexpr double much_less = 3.0;
  Steps found;
  std::string file;
  double least = std::numeric_limits<double>::infinity();  // of the recordings
  for (const Recording& r : recordings) {
    double worst = 0.0;
    for (const std::string_view name : channels.names) {
      const Channel *c = r.find(name), *position = r.find("position");
      const auto step = c != nullptr ? reading_step(*c, position) : std::nullopt;
      if (!step) continue;
      if (std::ranges::find(found.names, name) == found.names.end()) found.names.emplace_back(name);
      const double noise = *step * std::sqrt(usual_run(*c, position, *step) / 12.0);
      worst = std::max(worst, noise);
      if (!(noise > found.noise)) continue;
      file = r.source;
      found = {std::move(found.names), std::string(c->unit.symbol.view()), *step / c->unit.to_si,
               noise};
    }
    least = std::min(least, worst);
  }
  if (much_less * least < found.noise) found.file = file;
  return found;
}

void take(const Steps& steps, double& noise, bool& rounded, const Unit& unit,
          std::vector<std::string>& remarks) {
  if (!(steps.noise > noise)) return;
  rounded = true;
  const double both = std::hypot(steps.noise, noise);
  const std::string of_file = steps.file.empty() ? "" : steps.file + ": ";
  const std::string of_all =
      steps.file.empty() ? ""
                         : ", which is that of all recordings: finer ones count for less beside "
                           "this one than alone";
  remarks.push_back(
      fmt::format("{}{} {} written in steps of {:.3g} {}: with the noise of rounding it is {:.3g} "
                  "{} in place of "
                  "the {:.3g} {} of [readout]{}",
                  of_file, listed(steps.names, "and"), steps.names.size() == 1 ? "is" : "are",
                  steps.step, steps.unit, both / unit.to_si, unit.symbol.view(), noise / unit.to_si,
                  unit.symbol.view(), of_all));
  noise = both;
}

}  // namespace

Rounding rounding_of(const std::vector<Recording>& recordings) {
  return {steps_of(recordings, accelerometer_channels), steps_of(recordings, gimbal_channels)};
}

void take_rounding(const Rounding& rounding, Readout& readout, std::vector<std::string>& remarks) {
  if (readout.accelerometers)
    take(rounding.accelerometers, readout.accelerometer_noise, readout.accelerometers_rounded,
         unit::ug, remarks);
  if (readout.gimbals)
    take(rounding.gimbals, readout.gimbal_noise, readout.gimbals_rounded, unit::arcsec, remarks);
}

}  // namespace drift::preparation
