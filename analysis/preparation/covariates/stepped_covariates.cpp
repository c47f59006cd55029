#include "analysis/preparation/covariates/stepped_covariates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drift::preparation {

std::vector<SteppedCovariate> stepped_covariates(const std::vector<Recording>& recordings) {
  std::vector<SteppedCovariate> all;
  for (std::size_t k = 0; k < recordings.size(); ++k)
    for (const CovariateSpec& c : known_covariates)
      if (!c.is_vector())
        if (auto reading = SmoothReading::of(recordings[k], c.name))
          all.push_back({k, &c, std::move(*reading)});
  return all;
}

void take_smooth(const std::vector<SteppedCovariate>& stepped, std::vector<Recording>& recordings,
                 std::vector<std::string>& remarks) {
  for (const auto& [number, covariate, reading] : stepped) {
    Recording& r = recordings[number];
    const auto column = std::ranges::find(r.channels, covariate->name, &Channel::name);
    const std::vector<double>& time = r.find("time")->values;
    for (std::size_t row = 0; row < time.size(); ++row)
      if (std::isfinite(column->values[row]))
        column->values[row] = reading.at(time[row]).value_or(column->values[row]);
    remarks.push_back(
        fmt::format("{}: the {} is read in steps of {:.3g} {}, which hide its rate: taken from {}",
                    r.source.empty() ? "recording" : r.source, covariate->what,
                    reading.step() / column->unit.to_si, column->unit.symbol.view(),
                    reading.is_one_parabola()
                        ? "one parabola through all that was read"
                        : fmt::format("the parabolas through {:.3g} min to both sides of a row",
                                      reading.half() / 60.0)));
  }
}

}  // namespace drift::preparation
