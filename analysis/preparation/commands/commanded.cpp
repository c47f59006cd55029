#include "analysis/preparation/commands/commanded.hpp"

#include <algorithm>
#include <cmath>

namespace drift::preparation {
namespace {

/// How near a command must be to the Earth rate in the meridian [rad/s].
constexpr double in_meridian = PlanLimits::meridian * command_room;

Vec3 command_by(CommandLaw law, const Position& p, const Site& site) {
  return law == CommandLaw::level ? Vec3(p.R_lp.transpose() * site.omega_ie_l()) : Vec3::Zero();
}

}  // namespace

std::vector<Commanded> commanded_in(const mc::Study& study, const Timeline& timeline,
                                    const Measurements& measured,
                                    const std::vector<Dwell>& dwells) {
  std::vector<Commanded> all;
  for (const Dwell& d : dwells) {
    const Position& p = study.plan.positions[static_cast<std::size_t>(d.position)];
    Vec3 mean = Vec3::Zero();
    for (const std::size_t k : d.rows)
      mean += timeline.intervals[k].omega_cmd_p / static_cast<double>(d.rows.size());
    const CommandLaw other = p.mode == CommandLaw::level ? CommandLaw::free : CommandLaw::level;
    all.push_back({d.position + 1, p.mode, p.R_lp, mean, command_by(p.mode, p, study.site),
                   command_by(other, p, study.site), turn_of(d, timeline, measured, p)});
  }
  return all;
}

double part_obeyed(const std::vector<Commanded>& all) {
  double shown = 0.0, called_for = 0.0;
  for (const Commanded& c : all) {
    if (c.law != CommandLaw::level || !c.turn) continue;
    const Vec3 turn = Vec3(c.R_lp * (c.recorded - c.planned)).cwiseProduct(c.turn->seen);
    shown += turn.dot(c.turn->rate_l);
    called_for += turn.squaredNorm();
  }
  return called_for > 0.0 ? shown / called_for : nan_value;
}

double rms_turn(const std::vector<Commanded>& all) {
  double squares = 0.0, dwells = 0.0;
  for (const Commanded& c : all) {
    if (c.law != CommandLaw::level || !c.turn) continue;
    squares += c.turn->rate_l.cwiseProduct(c.turn->seen).squaredNorm();
    dwells += 1.0;
  }
  return std::sqrt(squares / dwells);
}

bool stands_level(const std::vector<Commanded>& all, const Site& site) {
  double squares = 0.0, dwells = 0.0;  // of the Earth rate as far as it is seen
  for (const Commanded& c : all) {
    if (c.law != CommandLaw::level || !c.turn) continue;
    squares += Vec3(site.omega_ie_l()).cwiseProduct(c.turn->seen).squaredNorm();
    dwells += 1.0;
  }
  return rms_turn(all) < PlanLimits::other_law * std::sqrt(squares / dwells);
}

std::optional<Mixup> exchanged_commands(const std::vector<Commanded>& all) {
  const auto of_the_plan = [&](const Mixup& m) {
    return std::ranges::all_of(all, [&](const Commanded& c) {
      return (m.of(c.recorded) - c.planned).norm() < command_room;
    });
  };
  if (all.size() < fewest_sights || of_the_plan({})) return std::nullopt;
  return the_one_mixup(of_the_plan);
}

std::optional<double> sine_of_another_latitude(const std::vector<Commanded>& all,
                                               const Site& site) {
  double sum = 0.0, least = 1.0, most = -1.0, level = 0.0;
  for (const Commanded& c : all) {
    if (c.law != CommandLaw::level) continue;
    const double rate = c.recorded.norm();
    const Vec3 local = c.R_lp * c.recorded;
    // As long as the Earth rate, in the meridian, and never to the South.
    if (!(std::abs(rate - detail::earth_rate) < in_meridian) ||
        !(std::abs(local[1]) < in_meridian) || local[0] < -in_meridian)
      return std::nullopt;
    const double sine = local[2] / rate;
    least = std::min(least, sine);
    most = std::max(most, sine);
    sum += sine;
    level += 1.0;
  }
  if (level == 0.0 || (most - least) * detail::earth_rate > 2.0 * in_meridian) return std::nullopt;
  const double sine = std::clamp(sum / level, -1.0, 1.0), cosine = std::sqrt(1.0 - sine * sine);
  const Vec3 off = detail::earth_rate * Vec3(cosine, 0.0, sine) - Vec3(site.omega_ie_l());
  return off.norm() > PlanLimits::latitude * command_room ? std::optional(sine) : std::nullopt;
}

std::optional<double> factor_of_commands(const std::vector<Commanded>& all, int column) {
  double products = 0.0, squares = 0.0, largest = 0.0;
  std::size_t telling = 0;
  for (const Commanded& c : all) {
    if (c.law != CommandLaw::level) continue;
    const double planned = c.planned[column];
    products += c.recorded[column] * planned;
    squares += planned * planned;
    largest = std::max(largest, std::abs(planned));
    telling += std::abs(planned) > command_room;
  }
  if (telling < fewest_sights) return std::nullopt;
  const double factor = products / squares;
  if (factor < 0.0) return std::nullopt;
  const double room = PlanLimits::factor_left * std::min(factor, std::abs(factor - 1.0)) * largest;
  const bool holds = std::ranges::all_of(all, [&](const Commanded& c) {
    return c.law != CommandLaw::level ||
           std::abs(c.recorded[column] - factor * c.planned[column]) <= room;
  });
  return holds ? std::optional(factor) : std::nullopt;
}

}  // namespace drift::preparation
