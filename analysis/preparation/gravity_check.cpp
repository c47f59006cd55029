#include "analysis/preparation/gravity_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "analysis/preparation/input_thresholds.hpp"
#include "core/base/words.hpp"
#include "core/physics/term_library.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/recording_units.hpp"
#include "core/stats/median.hpp"

namespace drift::preparation {
namespace {

/// By how much the study's own priors let bias and scale lengthen the specific force [g].
double room_of_priors(const mc::Study& study) {
  double variance = 0.0;
  for (const FilterSpec& filter : study.filters) {
    double sum = 0.0;
    for (std::size_t p = 0; p < TermLibrary::num_params; ++p) {
      const std::string_view name = TermLibrary::specs[p].key.view();
      const bool along = name.size() == 4 && (name.starts_with("K0_") || name.starts_with("K1_"));
      if (!along || !filter.active[p]) continue;
      const Prior& prior = filter.priors[p];
      const double most = std::abs(prior.mean()) + GravityLimits::sigmas * prior.sigma();
      sum += most * most;
    }
    variance = std::max(variance, sum);
  }
  return std::sqrt(variance);
}

/// Squares of the specific force [g^2] in the rows of one position's dwell.
struct Rest {
  std::vector<Vec3> rows{};
  int position = 0;  ///< as the plan numbers it; 0: of no position
};

/// One for each position that has rows enough.
std::vector<Rest> rests_of(const Recording& r) {
  std::vector<Rest> all;
  const Channel *phase = r.find("phase"), *position = r.find("position");
  for (std::size_t i = 0; i < r.rows(); ++i) {
    if (i == 0 || (position != nullptr && position->values[i] != position->values[i - 1]))
      all.push_back({.position = position ? static_cast<int>(position->values[i]) : 0});
    if (phase != nullptr && phase->values[i] > 0.5) continue;
    if (const auto f = measured(r, accelerometer_channels, i))
      all.back().rows.push_back(f->cwiseAbs2());
  }
  std::erase_if(all, [](const Rest& rest) { return rest.rows.size() < GravityLimits::enough; });
  return all;
}

/// One or two axes, as 1 and 0, and by how much they read too much.
struct Scaled {
  Vec3 axes = Vec3::Zero();
  double factor = 1.0;

  /// The specific force [g] with that undone, as half of the rows of a rest have it.
  double force_in(const Rest& rest) const {
    const Vec3 weight = Vec3::Ones() + (1.0 / (factor * factor) - 1.0) * axes;
    std::vector<double> squares;
    for (const Vec3& row : rest.rows) squares.push_back(weight.dot(row));
    return std::sqrt(stats::upper_median(std::move(squares)));
  }
  /// The least and the largest of all rests.
  std::pair<double, double> span(const std::vector<Rest>& rests) const {
    std::pair<double, double> span{HUGE_VAL, 0.0};
    for (const Rest& rest : rests) {
      const double f = force_in(rest);
      span = {std::min(span.first, f), std::max(span.second, f)};
    }
    return span;
  }
};

bool is_one_g(std::pair<double, double> span, double room) {
  return span.first >= 1.0 - room && span.second <= 1.0 + room;
}

/// The factor on these axes that makes 1 g of the rest in which they carry most.
double factor_on(const Vec3& axes, const std::vector<Rest>& rests) {
  double most = 0.0, factor = 1.0;
  for (const Rest& rest : rests) {
    std::vector<double> theirs, others;
    for (const Vec3& row : rest.rows) {
      theirs.push_back(axes.dot(row));
      others.push_back((Vec3::Ones() - axes).dot(row));
    }
    const double a = stats::upper_median(theirs), left = 1.0 - stats::upper_median(others);
    if (!(a > most) || !(left > 0.0)) continue;
    most = a;
    factor = std::sqrt(a / left);
  }
  return factor;
}

/// One or two accelerometers whose unit or scale keeps every rest from 1 g; none if all three are
/// alike in that, or no factor on fewer brings all rests there.
std::optional<Scaled> scaled_alone(const std::vector<Rest>& rests, double f, double room) {
  if (is_one_g(Scaled{Vec3::Ones(), f}.span(rests), room)) return std::nullopt;
  for (const double others : {0.0, 1.0})
    for (int i = 0; i < 3; ++i) {
      Vec3 axes = Vec3::Constant(others);
      axes[i] = 1.0 - others;
      const Scaled scaled{axes, factor_on(axes, rests)};
      if (is_one_g(scaled.span(rests), room)) return scaled;
    }
  return std::nullopt;
}

std::string unit_text(double number, const Unit& unit, std::string_view whose) {
  const std::string_view other = unit_of_one_g(number / unit.to_si);
  return other.empty()
             ? fmt::format("Correct {} unit or scale: no unit known here explains it", whose)
             : fmt::format("Correct {} unit: the numbers look like [{}], not [{}]", whose, other,
                           unit.symbol.view());
}

std::string text_of(const Scaled& scaled, const std::vector<Rest>& rests, const Recording& r,
                    double room, std::string_view where) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < 3; ++i)
    if (scaled.axes[static_cast<int>(i)] > 0.5) names.push_back(accelerometer_channels.names[i]);
  const auto [least, most] = Scaled{}.span(rests);
  return fmt::format(
      "{}:{}: the accelerometers together read {:.4g} g in one {} and {:.4g} g in another, "
      "as "
      "half of the rows of their dwells show (expected 1 g within {:.2g}); with {} taken {:.4g} "
      "times they read 1 g in all {}s. {}",
      r.source, fmt::join(names, ", "), least, where, most, room, fmt::join(names, " and "),
      1.0 / scaled.factor, where,
      unit_text(scaled.factor, r.find(names.front())->unit, names.size() > 1 ? "their" : "its"));
}

/// Of positions that do not read 1 g where most do: a log whose unit changes on the way, a position
/// of another log, or none at rest.
std::string elsewhere_than_one_g(const std::vector<Rest>& rests, const Recording& r, double room) {
  std::vector<std::string> places;
  std::vector<double> forces;
  for (const Rest& rest : rests) {
    const double f = Scaled{}.force_in(rest);
    if (std::abs(f - 1.0) <= room) continue;
    places.push_back(fmt::format("{}", rest.position));
    forces.push_back(f);
  }
  if (places.empty() || 2 * places.size() >= rests.size() || rests.front().position == 0) return "";
  const Unit& unit = r.find("acc_x")->unit;
  const auto [least, most] = std::ranges::minmax(forces);
  const std::string_view other = unit_of_one_g(least / unit.to_si);
  const bool one_unit = !other.empty() && unit_of_one_g(most / unit.to_si) == other;
  return fmt::format(
      "{}:acc_x: in position{} {} the accelerometers together read {:.4g} g, as half of the rows "
      "of "
      "the dwell show, in the other {} 1 g (expected 1 g within {:.2g}). {}",
      r.source, places.size() == 1 ? "" : "s", listed(places, "and"), least,
      rests.size() - places.size(), room,
      one_unit ? fmt::format("There the numbers look like [{}], not [{}]: correct these rows",
                             other, unit.symbol.view())
               : "Correct these rows, or leave the position out of the file");
}

}  // namespace

std::string other_than_one_g(const mc::Study& study, const Recording& recording) {
  const std::vector<double> lengths = specific_forces(recording);
  if (lengths.size() < GravityLimits::enough) return "";
  const double f = stats::upper_median(lengths);
  const double room = GravityLimits::room + room_of_priors(study);
  if (const auto rests = rests_of(recording);
      !rests.empty() && !is_one_g(Scaled{}.span(rests), room)) {
    if (const auto scaled = scaled_alone(rests, f, room))
      return text_of(*scaled, rests, recording, room, "position");
    if (std::string text = elsewhere_than_one_g(rests, recording, room); !text.empty()) return text;
  }
  if (std::abs(f - 1.0) <= room) return "";
  return fmt::format(
      "{}:acc_x: the accelerometers together read {:.4g} g, as half of the rows of dwells show "
      "(expected 1 g within {:.2g}). {}",
      recording.source, f, room, unit_text(f, recording.find("acc_x")->unit, "their"));
}

std::string accelerometers_in_another_unit(const Recording& recording,
                                           const std::vector<RestingRows>& rows) {
  std::vector<Rest> rests;
  std::vector<double> lengths;
  for (const RestingRows& rest : rows) {
    rests.emplace_back();
    for (std::size_t i = rest.first; i <= rest.last; ++i)
      if (const auto f = measured(recording, accelerometer_channels, i)) {
        rests.back().rows.push_back(f->cwiseAbs2());
        lengths.push_back(f->norm());
      }
  }
  std::erase_if(rests, [](const Rest& rest) { return rest.rows.size() < GravityLimits::enough; });
  if (rests.empty()) return "";
  const auto [least, most] = Scaled{}.span(rests);
  if (most < GravityLimits::by_attitude * least) return "";
  const auto scaled =
      scaled_alone(rests, stats::upper_median(std::move(lengths)), GravityLimits::on_a_case);
  if (!scaled || (scaled->factor < GravityLimits::units_differ &&
                  scaled->factor > 1.0 / GravityLimits::units_differ))
    return "";
  return text_of(*scaled, rests, recording, GravityLimits::on_a_case, "dwell");
}

}  // namespace drift::preparation
