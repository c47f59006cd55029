#include "core/recording/own/guess_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/recording/own/csv_cells.hpp"
#include "core/recording/own/guess_names.hpp"
#include "core/recording/own/recording_unit.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift {
namespace {

/// A unit of accelerations, and 9.80665 m/s^2 in it.
struct GravityUnit {
  std::string_view symbol;
  double one_g;
};

constexpr double standard_gravity = 9.80665;  // [m/s^2]
constexpr std::array<GravityUnit, 4> gravity_units{
    {{"g", 1.0}, {"m/s^2", standard_gravity}, {"mg", 1e3}, {"ug", 1e6}}};
/// [9.80665 m/s^2] In g, gravity may be that of the place or this one, which is within the band.
constexpr double lowest =
    GuessLimits::gravity_low / standard_gravity * (1.0 - GuessLimits::scale_room);
constexpr double highest =
    GuessLimits::gravity_high / standard_gravity * (1.0 + GuessLimits::scale_room);

/// The unit of one column in a choice of units for all three.
constexpr std::size_t unit_in(std::size_t choice, std::size_t column) {
  return choice >> (2 * column) & 3U;
}
constexpr bool all_alike(std::size_t choice) {
  return unit_in(choice, 0) == unit_in(choice, 1) && unit_in(choice, 1) == unit_in(choice, 2);
}

bool may_be_acceleration(const GuessedColumn& c) {
  if (!c.channel.empty()) return false;
  const auto unit = stated_unit(c);
  return !unit || unit->dim == "g"_unit.dim || unit->dim == "m/s^2"_unit.dim;
}

/// A name without what numbers the axis: "Beschl_1" and "Beschl_2" have one stem.
std::string stem_of(const GuessedColumn& c) {
  std::string name = lower_case(c.header.name);
  if (!name.empty()) name.pop_back();
  return name;
}

bool may_be_heading(std::string_view name) {
  const std::string word = lower_case(name);
  constexpr std::string_view parts[] = {"head",      "azim",     "sockel", "kurs",
                                        "fundament", "carcasse", "base",   "case",
                                        "pedestal",  "table",    "tisch"};
  return std::ranges::any_of(parts, [&](auto p) { return word.find(p) != std::string::npos; });
}

}  // namespace

std::optional<Unit> stated_unit(const GuessedColumn& c) {
  if (c.header.unit)
    if (const auto unit = parse_recording_unit(*c.header.unit)) return unit;
  return parse_recording_unit(guessed_unit(c.header.name));
}

bool measures(const Unit& unit, std::string_view channel) {
  const auto quantity = known_quantity(channel);
  if (!quantity || unit.dim == quantity->unit.dim) return true;
  if (channel.starts_with("gyro_")) return unit.dim == "rad"_unit.dim;
  return channel.starts_with("acc_") &&
         (unit.dim == "m/s^2"_unit.dim || unit.dim == "m/s"_unit.dim || unit.dim == "g*s"_unit.dim);
}

bool may_measure(const HeaderCell& header, std::string_view channel) {
  const auto unit = parse_recording_unit(header.unit ? *header.unit : unit_of_symbol(header.name));
  return !unit || measures(*unit, channel);
}

GuessByValues::GuessByValues(const GuessedFile& file) {
  const auto& all = file.columns;
  const bool has_acc = std::ranges::any_of(
      all, [](const GuessedColumn& c) { return c.channel.starts_with("acc_"); });
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!has_acc && may_be_acceleration(all[i])) free.push_back(i);
    const auto unit = stated_unit(all[i]);
    const bool gimbal = all[i].channel.starts_with("gimbal_");
    if (unit && unit->dim == "rad"_unit.dim && (gimbal || all[i].channel.empty()))
      (gimbal ? gimbals_ : angles_).push_back({.column = i, .to_rad = unit->to_si});
    if (all[i].channel != "position") continue;
    position_ = i;
    has_position_ = true;
  }
  std::array<std::size_t, 3> acc{};
  bool named = has_acc, stated = true;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto it =
        std::ranges::find(all, fmt::format("acc_{}", "xyz"[a]), &GuessedColumn::channel);
    named = named && it != all.end();
    if (it == all.end()) continue;
    acc[a] = static_cast<std::size_t>(it - all.begin());
    stated = stated && stated_unit(*it);
  }
  if (named && !stated) named_.push_back({.columns = acc});
  const auto add = [&](std::array<std::size_t, 3> columns) {
    if (std::ranges::find(triples_, columns, &Triple::columns) == triples_.end())
      triples_.push_back({.columns = columns});
  };
  // Names first: of raw and corrected columns side by side, three that are adjacent may be a mix.
  for (const std::size_t i : free) {
    std::vector<std::size_t> same;
    for (const std::size_t k : free)
      if (stem_of(all[k]) == stem_of(all[i])) same.push_back(k);
    if (same.size() == 3) add({same[0], same[1], same[2]});
  }
  for (std::size_t i = 0; i + 2 < free.size(); ++i)
    if (free[i + 2] == free[i] + 2) add({free[i], free[i] + 1, free[i] + 2});
}

void GuessByValues::begin_position() {
  ++positions_;
  for (auto* list : {&angles_, &gimbals_})
    for (Angle& a : *list) {
      a.low = HUGE_VAL;
      a.high = -HUGE_VAL;
    }
}

void GuessByValues::look_at_row(const std::vector<std::string_view>& cells) {
  for (auto* list : {&triples_, &named_}) {
    for (Triple& t : *list) {
      std::array<double, 3> f{};
      for (std::size_t a = 0; a < 3; ++a) f[a] = cell_number(cells[t.columns[a]]);
      if (!std::isfinite(f[0] + f[1] + f[2])) continue;
      ++t.rows;
      for (std::size_t a = 0; a < 3; ++a) t.whole[a] = t.whole[a] && f[a] == std::round(f[a]);
      for (std::size_t choice = 0; choice < t.as_units.size(); ++choice) {
        double squares = 0.0;
        for (std::size_t a = 0; a < 3; ++a)
          squares += std::pow(f[a] / gravity_units[unit_in(choice, a)].one_g, 2);
        if (squares >= lowest * lowest && squares <= highest * highest) ++t.as_units[choice];
      }
    }
  }
  if (!has_position_) return;
  if (positions_ == 0 || cells[position_] != here_) begin_position();
  here_ = cells[position_];
  for (auto* list : {&angles_, &gimbals_})
    for (Angle& a : *list) {
      const double x = cell_number(cells[a.column]) * a.to_rad;
      a.missing += std::isfinite(x) ? 0 : 1;
      if (!std::isfinite(x)) continue;
      ++a.rows;
      a.low = std::min(a.low, x);
      a.high = std::max(a.high, x);
      a.farthest = std::max(a.farthest, a.high - a.low);
    }
}

bool GuessByValues::likely(const GuessedFile& file, const Triple& t) const {
  bool stated = true, moved = false;
  for (const std::size_t i : t.columns) {
    const GuessedColumn& c = file.columns[i];
    stated = stated && stated_unit(c);
    moved = moved || c.high - c.low > 2.0 * GuessLimits::scale_room * std::max(-c.low, c.high);
  }
  // Flags of which one is 1 have the length 1, too.
  return 2 * t.rows > file.rows &&
         (stated || (moved && std::ranges::none_of(t.whole, [](bool w) { return w; })));
}

std::string GuessByValues::axes_of(const GuessedFile& file, const Triple& t) {
  std::string axes, sorted;
  for (const std::size_t i : t.columns)
    if (const std::string name = lower_case(file.columns[i].header.name); !name.empty())
      axes += name.back();
  sorted = axes;
  std::ranges::sort(sorted);
  return sorted == "xyz" ? axes : "xyz";
}

std::vector<std::string> GuessByValues::units_of(const GuessedFile& file, const Triple& t) const {
  const auto fits = [&](std::size_t choice) {
    for (std::size_t a = 0; a < 3; ++a)
      if (const auto stated = stated_unit(file.columns[t.columns[a]]);
          stated &&
          !same_unit(*stated, *parse_recording_unit(gravity_units[unit_in(choice, a)].symbol)))
        return false;
    return t.rows > 0 && static_cast<double>(t.as_units[choice]) >=
                             GuessLimits::most_rows * static_cast<double>(t.rows);
  };
  std::vector<std::size_t> fitting;
  for (std::size_t choice = 0; choice < t.as_units.size(); ++choice)
    if (fits(choice)) fitting.push_back(choice);
  // One unit for all goes before any mixture: a column that hardly moves fits every unit.
  const auto alike = std::ranges::find_if(fitting, all_alike);
  if (alike == fitting.end() && fitting.size() != 1) return {};
  const std::size_t choice = alike == fitting.end() ? fitting.front() : *alike;
  std::vector<std::string> units;
  for (std::size_t a = 0; a < 3; ++a) units.emplace_back(gravity_units[unit_in(choice, a)].symbol);
  return units;
}

std::string GuessByValues::name_channels(GuessedFile& file) {
  std::string unit;
  bool found = false;
  for (const Triple& t : triples_) {
    const std::vector<std::string> units =
        found || !likely(file, t) ? std::vector<std::string>() : units_of(file, t);
    if (units.empty()) continue;
    found = true;
    const bool alike = units[0] == units[1] && units[1] == units[2];
    if (alike) unit = units[0];
    const std::string axes = axes_of(file, t);
    for (std::size_t a = 0; a < 3; ++a) {
      GuessedColumn& c = file.columns[t.columns[a]];
      c.channel = fmt::format("acc_{}", axes[a]);
      c.by_values = true;
      if (!alike && !stated_unit(c)) c.unit = units[a];
    }
  }
  for (const Triple& t : named_)
    if (const auto units = units_of(file, t); !units.empty())
      for (std::size_t a = 0; a < 3; ++a)
        if (GuessedColumn& c = file.columns[t.columns[a]]; !stated_unit(c)) c.unit = units[a];
  const bool moving =
      std::ranges::any_of(gimbals_, [](const Angle& a) { return a.farthest > GuessLimits::held; });
  std::vector<std::size_t> held, called;
  for (const Angle& a : angles_) {
    const GuessedColumn& c = file.columns[a.column];
    if (!moving || positions_ < 2 || a.missing > 0 || a.farthest > GuessLimits::held ||
        !(c.high > c.low) || !c.channel.empty())
      continue;
    held.push_back(a.column);
    if (may_be_heading(c.header.name)) called.push_back(a.column);
  }
  // Several are held where the nominal attitude is written down: then a name must tell.
  const std::vector<std::size_t>& of = held.size() == 1 ? held : called;
  const bool taken = std::ranges::find(file.columns, "case_heading", &GuessedColumn::channel) !=
                     file.columns.end();
  if (of.size() == 1 && !taken) {
    file.columns[of.front()].channel = "case_heading";
    file.columns[of.front()].by_values = true;
  }
  return unit;
}

}  // namespace drift
