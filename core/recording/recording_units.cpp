#include "core/recording/recording_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/recording/own/recording_unit.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/repeated_rows.hpp"
#include "core/recording/sample_kind.hpp"
#include "core/stats/median.hpp"

namespace drift {
namespace {

constexpr Unit acceleration = "m/s^2"_unit, velocity = "m/s"_unit;

/// Angles and velocities per sample are what a strapdown recording of increments holds.
std::optional<ChannelQuantity> quantity_of(const RawColumn& column, const UnitContext& context) {
  const bool increments =
      context.samples == SampleKind::increments && context.kind == RecordingKind::strapdown;
  if (increments && column.name.starts_with("gyro_") && known_quantity(column.name))
    return ChannelQuantity{unit::rad, "an angle gained per sample, for example [rad] or [deg]",
                           true, 1e3};
  if (increments && column.name.starts_with("acc_") && known_quantity(column.name))
    return ChannelQuantity{"g*s"_unit, "a velocity gained per sample, for example [m/s] or [g*s]",
                           true, 1e5};
  return known_quantity(column.name);
}

/// A covariate whose unit is not known: a plain number that no term mistakes for its own.
Unit carried_plain(RawColumn& column, std::string_view why, WeighedTexts& remarks) {
  const std::string was = column.name;
  const bool of_terms = known_quantity(was).has_value();
  if (of_terms) column.name += "_raw";
  remarks.add(of_terms ? Weight::doubtful : Weight::note,
              fmt::format("{}: {}, it is carried as a plain number{}", was, why,
                          of_terms ? fmt::format(", as {}, which no term uses", column.name)
                                   : std::string()));
  return unit::one;
}

/// The last digit of times [s]: where so many digits are written, and not so many places, that of
/// the largest times.
double last_digit(const Channel& time) {
  constexpr std::size_t enough = 100;  // of times of one size: a few may all end in zeros
  std::map<double, Channel> of_size;
  for (const double t : time.values)
    if (std::isfinite(t) && t != 0.0)
      of_size.try_emplace(std::floor(std::log10(std::abs(t))), Channel{time.name, time.unit, {}})
          .first->second.values.push_back(t);
  double coarsest = decimal_step(time);
  for (const auto& [size, channel] : of_size)
    if (channel.values.size() >= enough) coarsest = std::max(coarsest, decimal_step(channel));
  return coarsest;
}

}  // namespace

void check_units_given(const std::vector<RawColumn>& columns, const UnitContext& context,
                       Problems& problems) {
  std::string names, expected;
  for (const RawColumn& c : columns) {
    const auto quantity = quantity_of(c, context);
    if (c.unit || is_covariate(c.name, context.kind) || (quantity && !quantity->needs_unit))
      continue;
    names += (names.empty() ? "" : ", ") + c.name;
    if (expected.empty() && quantity) expected = quantity->words;
  }
  if (names.empty()) return;
  const std::string first = names.substr(0, names.find(','));
  problems.add(names, "the unit is missing",
               first == names ? expected : fmt::format("one for each, {} for {}", expected, first),
               fmt::format("Give it with the name, as in '{} [{}]', or in [recording] columns of "
                           "the study file",
                           first,
                           first == "time"            ? "s"
                           : first.starts_with("acc") ? "g"
                                                      : "deg"));
}

Unit checked_unit(RawColumn& column, const UnitContext& context, Problems& problems,
                  WeighedTexts& remarks) {
  const auto quantity = quantity_of(column, context);
  const bool plain = quantity && !quantity->needs_unit;
  const bool covariate = is_covariate(column.name, context.kind);
  const std::string expected(
      quantity ? quantity->words : "a unit such as [degC], [gauss], [arcsec] or [1] for a number");
  if (!column.unit) {
    if (plain) return unit::one;
    if (covariate) return carried_plain(column, "no unit is given", remarks);
    return unit::one;
  }
  const auto unit = parse_recording_unit(*column.unit);
  if (!unit) {
    if (covariate && !plain)
      return carried_plain(column, "the unit " + in_quotes(*column.unit) + " is not known",
                           remarks);
    problems.add(column.name, "unknown unit " + in_quotes(*column.unit), expected,
                 "Write the unit as a product of known ones, as in deg/h or m/s^2, or give it in "
                 "[recording] columns of the study file");
    return unit::one;
  }
  if (!quantity || unit->dim == quantity->unit.dim) return *unit;
  if (quantity->unit.dim == unit::g.dim && unit->dim == acceleration.dim)
    return {unit->symbol, unit->to_si / context.gravity, unit::g.dim};
  if (quantity->unit.dim == "g*s"_unit.dim && unit->dim == velocity.dim)
    return {unit->symbol, unit->to_si / context.gravity, quantity->unit.dim};
  std::string fix = "Correct the unit or the name of the column";
  if (context.samples != SampleKind::increments && context.kind == RecordingKind::strapdown &&
      (unit->dim == unit::rad.dim || unit->dim == velocity.dim))
    fix =
        "Angles and velocities gained per sample need kind = \"increments\" in [recording] of the "
        "study file; otherwise correct the unit";
  problems.add(column.name,
               fmt::format("the unit [{}] does not measure this channel", *column.unit), expected,
               fix);
  return *unit;
}

void add_offset(RawColumn& column, const Unit& unit, Problems& problems) {
  if (!column.offset || !column.unit) return;  // what has no unit is said elsewhere
  if (column.offset->dim != unit.dim) {
    problems.add(column.name, "recording.offset of the study file has another kind of unit",
                 fmt::format("one that goes with [{}]", unit.symbol.view()),
                 "Correct the unit of the offset");
    return;
  }
  for (double& x : column.values) x += column.offset->value;
}

void make_rates(Recording& recording, double gravity) {
  const Channel* time = recording.find("time");
  if (!time || recording.rows() < 2) return;
  std::vector<double> steps;
  for (std::size_t i = 1; i < recording.rows(); ++i)
    steps.push_back(time->values[i] - time->values[i - 1]);
  const double usual = stats::upper_median(steps);
  if (!(usual > 0.0)) return;
  // Times of few digits make even rows seem uneven: what such a row gained is divided by what all
  // of them took on average. By its own each reading of coarse counts would differ from the others,
  // but for zeros.
  const double rounding = std::min(1.001 * last_digit(*time), 0.25 * usual);
  const auto even = [&](double step) { return std::abs(step - usual) <= rounding; };
  double sum = 0.0, count = 0.0;
  for (const double step : steps)
    if (even(step)) {
      sum += step;
      count += 1.0;
    }
  const double mean = sum / count;
  const auto length = [&](std::size_t row) {
    if (row == 0 || even(steps[row - 1])) return mean;
    return sampled_over(steps[row - 1], usual);
  };
  for (Channel& c : recording.channels) {
    const bool gyro = c.name.starts_with("gyro_") && c.unit.dim == unit::rad.dim;
    const bool acc = c.name.starts_with("acc_") && c.unit.dim == "g*s"_unit.dim;
    if (!gyro && !acc) continue;
    for (std::size_t i = 0; i < c.values.size(); ++i) c.values[i] /= length(i);
    c.unit = gyro ? unit::deg_per_s
                  : Unit{acceleration.symbol, acceleration.to_si / gravity, unit::g.dim};
  }
}

std::string_view unit_of_one_g(double number) {
  struct Size {
    double one_g;  ///< in that unit
    std::string_view unit;
  };
  constexpr double g = 9.80665;  // that of the place is the same within the room
  constexpr Size sizes[] = {
      {1.0, "g"},          {g, "m/s^2"},        {1e3, "mg"},           {1e6, "ug"},
      {1e2 * g, "cm/s^2"}, {1e3 * g, "mm/s^2"}, {g / 0.3048, "ft/s^2"}};
  constexpr double room = 0.01;
  for (const Size& s : sizes)
    if (std::abs(number / s.one_g - 1.0) < room) return s.unit;
  return {};
}

void check_gravity(const Recording& recording, Problems& problems) {
  if (problems.any()) return;
  constexpr std::size_t enough = 5;  // a handful of rows says nothing
  const std::vector<double> lengths = specific_forces(recording);
  if (lengths.size() < enough) return;
  const double f = stats::upper_median(lengths);
  constexpr double far = 5.0;  // nearer to 1 g a case may have been moving
  if (f < far && f > 1.0 / far) return;
  // A length that depends on the attitude is of one accelerometer in another unit: that is looked
  // for where the rests are known.
  constexpr double twice = 2.0, most = 0.9;
  const auto alike = std::ranges::count_if(
      lengths, [&](double other) { return other < twice * f && other > f / twice; });
  if (static_cast<double>(alike) < most * static_cast<double>(lengths.size())) return;
  const Unit& unit = recording.find("acc_x")->unit;
  if (const auto other = unit_of_one_g(f / unit.to_si); !other.empty())
    problems.add("acc_x",
                 fmt::format("the accelerometers together read {:.4g} g, as half of the "
                             "rows show",
                             f),
                 "1 g from a case at rest",
                 fmt::format("Correct their unit: the numbers look like [{}], not [{}]", other,
                             unit.symbol.view()));
}

std::vector<double> specific_forces(const Recording& recording) {
  std::vector<double> lengths;
  const Channel* phase = recording.find("phase");
  for (std::size_t i = 0; i < recording.rows(); ++i)
    if (!phase || !(phase->values[i] > 0.5))
      if (const auto f = measured(recording, accelerometer_channels, i))
        lengths.push_back(f->norm());
  return lengths;
}

}  // namespace drift
