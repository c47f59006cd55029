#include "core/recording/recording_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/check.hpp"
#include "core/recording/own/header.hpp"
#include "core/recording/own/recording_unit.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/recording_units.hpp"
#include "core/recording/rows/check_time.hpp"
#include "core/recording/rows/commanded_slews.hpp"
#include "core/recording/rows/count_positions.hpp"
#include "core/recording/rows/even_times.hpp"
#include "core/recording/rows/turned_rows.hpp"
#include "core/recording/sample_kind.hpp"
#include "core/recording/sexagesimal.hpp"

namespace drift {
namespace {

void check_names(const RawRecording& raw, Problems& problems) {
  for (std::size_t i = 0; i < raw.columns.size(); ++i) {
    const auto& name = raw.columns[i].name;
    if (!valid_channel_name(name))
      problems.add(fmt::format("column {}", i + 1), "the name is " + in_quotes(name),
                   "a letter, then letters, digits and underscores, at most 63; not 'units', "
                   "'facts' or one that ends in '_unit'",
                   "Rename the column");
    for (std::size_t j = 0; j < i; ++j)
      if (raw.columns[j].name == name)
        problems.add(name, fmt::format("columns {} and {} have the same name", j + 1, i + 1),
                     "every name once", "Rename or remove one of them");
  }
  for (const auto& [key, value] : raw.facts)
    if (!valid_utf8(key) || !valid_utf8(value))
      problems.add("", fmt::format("the fact {} is not UTF-8", in_quotes(key)), "UTF-8 text",
                   "Save the file as UTF-8");
}

void check_values(const Recording& r, RecordingKind kind, Problems& problems) {
  bool measured = false;
  for (const auto& c : r.channels) {
    const auto quantity = known_quantity(c.name);
    // In a unit that is not known, or that measures something else, no number is beyond reason.
    const double most = quantity && quantity->unit.dim == c.unit.dim
                            ? quantity->most
                            : std::numeric_limits<double>::max();
    const bool sensor = c.name.starts_with("acc_") || c.name.starts_with("gimbal_");
    std::string fix;  // of the first: rows with the same one are one message
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      const double x = c.values[i];
      check_value(r, c, i, kind, problems);
      if (std::isfinite(x) && std::abs(x) > most) add_unreasonable(r, c, i, most, fix, problems);
      measured = measured || (sensor && std::isfinite(x));
    }
  }
  if (!measured && !problems.any())
    problems.add("", "no accelerometer or gimbal angle was measured in any row",
                 "numbers in at least one sensor column", "Check how the recording was exported");
}

/// Temperatures in degC, as terms take them; of covariates only the differences count.
Unit made_celsius(std::vector<double>& values, const Unit& unit) {
  const double offset = celsius_offset(unit);
  if (offset == 0.0) return unit;
  for (double& x : values) x += offset;
  return "degC"_unit;
}

/// Makes angles decimal where their digits are minutes and seconds, or looks whether they are.
void take_digits(RawColumn& column, AngleDigits said, const Recording& r, MinutesAndSeconds& digits,
                 Problems& problems) {
  if (said == AngleDigits::automatic && column.name.starts_with("gimbal_"))
    digits.look_at(column.values);
  if (said != AngleDigits::minutes_and_seconds) return;
  for (std::size_t i = 0; i < column.values.size(); ++i) {
    const double number = column.values[i];
    if (std::isnan(number)) continue;
    column.values[i] = angle_from_minutes_and_seconds(number);
    if (std::isnan(column.values[i]))
      problems.add(place_in(r, i, column.name),
                   fmt::format("{} has 60 minutes or seconds, or more", number),
                   "degrees, minutes and seconds as in 45.3015",
                   "Remove angles = \"dd.mmss\" from [recording] of the study file if the angles "
                   "are decimal");
  }
}

bool equal_lengths(const RawRecording& raw, Problems& problems) {
  const std::size_t rows = raw.columns.front().values.size();
  bool equal = true;
  for (const auto& c : raw.columns)
    if (c.values.size() != rows) {
      equal = false;
      problems.add(c.name, fmt::format("{} values", c.values.size()),
                   fmt::format("{}, as in {}", rows, raw.columns.front().name),
                   "Give every channel one value per row; remove what is no channel");
    }
  return equal;
}

}  // namespace

void check_columns(const Recording& r, RecordingKind kind, const std::string& not_counted,
                   Problems& problems) {
  std::string present;
  for (const auto& c : r.channels) present += (present.empty() ? "" : ", ") + c.name;
  const bool strapdown = kind == RecordingKind::strapdown;
  const std::string hint =
      std::string(
          "Add it, or name the column that holds it in [recording] of the study file "
          "(`driftscope look` proposes how); ") +
      (strapdown ? "a recording of a gimballed platform needs a study without kind = \"strapdown\""
                 : "sensors fixed to a case need [plan] kind = \"strapdown\" in the study");
  const auto need = [&](std::string_view name) {
    if (!r.find(name))
      problems.add(name, "the column is missing",
                   fmt::format("it beside the columns found: {}", present), hint);
  };
  const auto known = canonical_channels(kind);
  if (std::ranges::none_of(r.channels, [&](const Channel& c) {
        return std::ranges::find(known, c.name) != known.end();
      })) {
    problems.add("", "none of its columns is one that the program knows",
                 fmt::format("such as {}; there are {}",
                             strapdown ? "time, gyro_x, acc_x" : "time, position, acc_x", present),
                 "Name them in [recording] of the study file; `driftscope look` proposes how");
    return;
  }
  need("time");
  if (!strapdown && r.find("position") == nullptr)
    problems.add(
        "position",
        fmt::format("the column is missing{}",
                    not_counted.empty() ? "" : ", and positions cannot be counted: " + not_counted),
        fmt::format("it beside the columns found: {}", present), hint);
  for (const auto& triple : channel_triples) {
    const auto has = [&](std::string_view name) { return r.find(name) != nullptr; };
    const auto count = std::ranges::count_if(triple.names, has);
    const bool required = strapdown && (triple.what == "gyros" || triple.what == "accelerometers");
    // A sensor of a platform that was not recorded is one that was not measured: said by the
    // quality card.
    const bool sensors = triple.what == "accelerometers" || triple.what == "gimbal angles";
    for (const auto name : triple.names) {
      if (has(name) || (sensors && !strapdown)) continue;
      if (count > 0)
        problems.add(name,
                     fmt::format("the column is missing while other {} are there", triple.what),
                     "all three or none", "Add it, or remove the other two");
      else if (required)
        need(name);
    }
  }
  const bool measured = std::ranges::any_of(r.channels, [](const Channel& c) {
    const auto is_one = [&](const ChannelTriple& t) {
      return std::ranges::find(t.names, c.name) != t.names.end();
    };
    return is_one(channel_triples[0]) || is_one(channel_triples[1]);
  });
  if (!strapdown && !measured)
    problems.add("acc_x", "there are neither accelerometers nor gimbal angles",
                 "acc_x, acc_y, acc_z or gimbal_outer, gimbal_middle, gimbal_inner, or both", hint);
}

void check_value(const Recording& r, const Channel& c, std::size_t row, RecordingKind kind,
                 Problems& problems) {
  const double x = c.values[row];
  if (std::isinf(x))
    problems.add(place_in(r, row, c.name), "the value is infinite", "a finite number",
                 "Leave the cell empty (nan) if it was not measured");
  else if (std::isnan(x) && kind == RecordingKind::platform && c.name.starts_with("cmd_"))
    problems.add(place_in(r, row, c.name), "the command is missing",
                 "the commanded rate in every row", "Give the command, 0 if there was none");
}

void add_unreasonable(const Recording& r, const Channel& c, std::size_t row, double most,
                      std::string& fix, Problems& problems) {
  const double in_unit = c.values[row] / c.unit.to_si;
  const bool temperature = c.unit.dim == "degC"_unit.dim;
  if (fix.empty())
    fix = fmt::format(
        "Check the unit and the export{}; if it stands for not measured, say in "
        "[recording] of the study file missing = [{:g}]",
        temperature ? fmt::format(" (kelvins are {} = \"its header as it stands, then "
                                  "[K]\" in columns of [recording], or [K] in the "
                                  "header)",
                                  c.name)
                    : "",
        in_unit);
  problems.add(place_in(r, row, c.name), fmt::format("the value {:g} is beyond reason", in_unit),
               fmt::format("at most {:g} {} in size", most / c.unit.to_si, c.unit.symbol.view()),
               fix);
}

Recording checked_recording(RawRecording raw, RecordingKind kind, double gravity,
                            Problems& problems) {
  DRIFT_EXPECTS(gravity > 0.0);
  Recording r;
  r.source = utf8_text(problems.file());
  if (raw.columns.empty()) {
    if (!problems.any())
      problems.add("", "there is no channel", "columns such as time, acc_x, acc_y, acc_z",
                   "Check how the recording was exported");
    return r;
  }
  check_names(raw, problems);
  r.remarks = std::move(raw.remarks);
  r.unmapped_temperature = std::move(raw.unmapped_temperature);
  if (!equal_lengths(raw, problems)) return r;
  const std::size_t rows = raw.columns.front().values.size();
  if (rows == 0 && !problems.any())
    problems.add("", "there are no rows", "one row per sample",
                 "Check how the recording was exported");
  if (rows == 1 && kind == RecordingKind::strapdown)
    problems.add("", "there is one row", "at least two, to tell the sample interval",
                 "Check how the recording was exported");
  r.facts = std::move(raw.facts);
  r.lines = std::move(raw.lines);
  number_rows(r, rows);
  MinutesAndSeconds digits;
  if (raw.settled) check_units_given(raw.columns, {kind, raw.kind, gravity}, problems);
  for (auto& c : raw.columns) {
    const bool temperature = c.name == "temperature";
    WeighedTexts said;
    Unit unit = checked_unit(c, {kind, raw.kind, gravity}, problems, said);
    if (temperature && c.name != "temperature") r.unmapped_temperature = said.texts().front();
    r.remarks.add(said);
    if (is_angle(c.name) && same_unit(unit, unit::deg))
      take_digits(c, raw.angles, r, digits, problems);
    for (double& x : c.values) x *= c.sign * unit.to_si;
    if (c.name == "temperature") unit = made_celsius(c.values, unit);
    add_offset(c, unit, problems);
    r.channels.push_back({std::move(c.name), unit, std::move(c.values)});
  }
  if (std::string wrong = digits.text(); !wrong.empty())
    problems.add("gimbal_outer, gimbal_middle, gimbal_inner", std::move(wrong), "decimal degrees",
                 "Say in [recording] of the study file angles = \"dd.mmss\", if 45.3015 is 45 deg "
                 "30' 15\", or angles = \"decimal\"");
  if (kind == RecordingKind::strapdown && raw.kind != SampleKind::rates) {
    if (raw.kind == SampleKind::increments) make_rates(r, gravity);
    say_mean_rates(r);
  }
  if (raw.settled) {
    const std::string why = kind == RecordingKind::platform ? count_positions(r) : "";
    check_columns(r, kind, why, problems);
  }
  if (kind == RecordingKind::platform) {
    take_turned_rows(r);
    take_commanded_slews(r);
    take_even_times(r);
  }
  const std::size_t before = problems.count();
  check_time(r, problems);
  const bool in_order = problems.count() == before;
  check_phase(r, problems);
  check_position(r, in_order ? RowOrder::known : RowOrder::broken, problems);
  check_values(r, kind, problems);
  check_gravity(r, problems);
  return r;
}

}  // namespace drift
