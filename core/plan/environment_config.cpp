#include "core/plan/environment_config.hpp"

#include <fmt/format.h>

#include <string>

#include "core/base/units.hpp"

namespace drift {
namespace {

using config::Option;

void read_number(config::Section& section, const CovariateSpec& c, CovariateCourse& course) {
  const std::string name(c.name);
  section.read(Option{name, c.unit, c.least, c.most, "mean"}, course.mean.front());
  const auto read = [&](const char* what, Option option, double& value) {
    const std::string key = name + what;
    option.key = key;
    section.read(option, value);
    if (section.has(key) && !section.has(name))
      section.report().error(section.take(key)->at,
                             fmt::format("'{}' is given without the mean (expected {} = {} "
                                         "beside it). Add it, or remove the line",
                                         section.full(key), name, c.example));
  };
  read("_amplitude", {{}, c.unit, 0.0, c.swing, "of its daily sine", true}, course.amplitude);
  read("_period", {{}, unit::hour, 0.01, 1e5, "of the sine"}, course.period);
  read("_phase", {{}, unit::deg, -360.0, 360.0, "of the sine at the start"}, course.phase);
  read("_ramp", {{}, c.unit_per_hour(), -c.swing, c.swing, "even change"}, course.ramp);
  read("_fluctuation", {{}, c.unit, 0.0, c.swing, "1 sigma of a sample", true}, course.fluctuation);
}

void read_vector(config::Section& section, const CovariateSpec& c, CovariateCourse& course) {
  std::string keys;
  int given = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Name key = c.column(k);
    section.read(Option{key, c.unit, c.least, c.most, "toward North, West, Up"}, course.mean[k]);
    given += section.has(key) ? 1 : 0;
    keys += (k == 0 ? "" : ", ") + std::string(key.view());
  }
  if (given == 0 || given == 3) return;
  section.report().error(section.at(),
                         fmt::format("'{}' has {} of {} (expected all three or none, "
                                     "such as {}). Give all three",
                                     section.full(c.column(0)), given, keys, c.example));
  course.mean = {};
}

}  // namespace

Environment read_environment(config::Section section) {
  Environment e;
  if (!section.present()) return e;
  for (const CovariateSpec& c : known_covariates)
    if (c.is_vector())
      read_vector(section, c, e[c]);
    else
      read_number(section, c, e[c]);
  section.finish();
  return e;
}

}  // namespace drift
