#include "analysis/preparation/plan_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/preparation/commands/command_check.hpp"
#include "analysis/preparation/dwell_turn.hpp"
#include "analysis/preparation/input_thresholds.hpp"
#include "core/base/words.hpp"
#include "core/physics/gimbals.hpp"
#include "core/plan/timeline.hpp"
#include "core/sim/measurements.hpp"

namespace drift::preparation {
namespace {

constexpr double deg_per_h = unit::deg_per_h.to_si;

CommandLaw other_than(CommandLaw law) {
  return law == CommandLaw::level ? CommandLaw::free : CommandLaw::level;
}

std::string time_text(double seconds) {
  return seconds >= 120.0 ? fmt::format("{:.4g} min", seconds / 60.0)
                          : fmt::format("{:.4g} s", seconds);
}

/// Of positions counted from 0.
std::string numbered(std::vector<int> positions) {
  for (int& p : positions) ++p;
  return positions_text(positions);
}

void check_dwells(const mc::Study& study, const std::string& source, const Timeline& timeline,
                  const std::vector<Dwell>& dwells, std::vector<std::string>& remarks) {
  std::map<std::pair<double, double>, std::vector<int>>
      others;  // (planned, recorded) in whole samples
  for (const Dwell& d : dwells) {
    const Position& p = study.plan.positions[static_cast<std::size_t>(d.position)];
    const double lasts =
        timeline.intervals[d.rows.back()].t1 - timeline.intervals[d.rows.front()].t0;
    if (std::abs(lasts - p.dwell) > PlanLimits::dwell * p.sample)
      others[{p.dwell, p.sample * std::round(lasts / p.sample)}].push_back(d.position);
  }
  if (others.empty()) return;
  constexpr std::size_t most = 4;
  std::vector<std::string> texts;
  for (const auto& [times, positions] : others)
    texts.push_back(fmt::format("{} for {} (in the plan {})", numbered(positions),
                                time_text(times.second), time_text(times.first)));
  const std::string more =
      texts.size() > most ? fmt::format(" and {} others", texts.size() - most) : "";
  texts.resize(std::min(most, texts.size()));
  remarks.push_back(
      fmt::format("{}: dwells of another length than in the plan: {}{}. The recording's own times "
                  "are used; check "
                  "plan.dwell if that is not what was meant",
                  source, fmt::join(texts, ", "), more));
}

/// Without recorded commands the plan's law is believed; the platform shows whether it was so.
void check_law(const mc::Study& study, const std::string& source, const Timeline& timeline,
               const Measurements& m, const std::vector<Dwell>& dwells,
               std::vector<std::string>& wrong) {
  for (const CommandLaw law : {CommandLaw::free, CommandLaw::level}) {
    Vec3 mean = Vec3::Zero(), seen = Vec3::Ones();
    double squares = 0.0;
    std::vector<int> positions;
    for (const Dwell& d : dwells) {
      const Position& p = study.plan.positions[static_cast<std::size_t>(d.position)];
      const auto turn = p.mode == law ? turn_of(d, timeline, m, p) : std::nullopt;
      if (!turn) continue;
      mean += turn->rate_l;
      squares += turn->rate_l.cwiseProduct(turn->seen).squaredNorm();
      seen = seen.cwiseProduct(turn->seen);
      positions.push_back(d.position);
    }
    if (positions.empty()) continue;
    mean = (mean / static_cast<double>(positions.size())).cwiseProduct(seen);
    const Vec3 free = Vec3(-study.site.omega_ie_l()).cwiseProduct(seen);
    const Vec3 other = law == CommandLaw::free ? Vec3(Vec3::Zero()) : free;
    if (free.norm() < PlanLimits::laws_differ_deg_per_h * deg_per_h ||
        (mean - other).norm() > PlanLimits::other_law * free.norm())
      continue;
    // Turns as long as the Earth's that are none in the mean: positions of other headings than
    // planned (identification::heading_doubt), not a platform that stands.
    const double length = std::sqrt(squares / static_cast<double>(positions.size()));
    if (law == CommandLaw::free &&
        std::abs(length - free.norm()) < PlanLimits::other_law * free.norm())
      continue;
    const std::string shows =
        law == CommandLaw::free
            ? "the platform keeps its attitude to the local axes, as in a level dwell"
            : "the platform turns at Earth rate against the local axes, as in free drift";
    wrong.push_back(
        fmt::format("{}: in {} {}, but the plan says mode = \"{}\" and the recording has no "
                    "commands (expected the law "
                    "it was made with). Set plan.mode = \"{}\", or record cmd_x, cmd_y, cmd_z",
                    source, numbered(positions), shows, key_of(law), key_of(other_than(law))));
  }
}

/// How far the platform turns from a row to a later one [rad]: gimbals and accelerometers must both
/// show it where both measured, for one alone may be faulty. 0 where neither did.
double turn_between(const Measurements& m, std::size_t from, std::size_t to) {
  const auto a = static_cast<Eigen::Index>(from), b = static_cast<Eigen::Index>(to);
  std::vector<double> shown;
  if ((m.gimbal.col(a) + m.gimbal.col(b)).array().isFinite().all())
    shown.push_back(rotation_vector(Mat3(gimbal_chain(m.gimbal.col(a)).transpose() *
                                         gimbal_chain(m.gimbal.col(b))))
                        .norm());
  if ((m.acc.col(a) + m.acc.col(b)).array().isFinite().all())
    shown.push_back(std::atan2(Vec3(m.acc.col(a)).cross(Vec3(m.acc.col(b))).norm(),
                               m.acc.col(a).dot(m.acc.col(b))));
  return shown.empty() ? 0.0 : *std::ranges::min_element(shown);
}

/// A position within which the platform is turned, and not by a row or two of its neighbours: two
/// positions under one number. A spike turns back in the row after it.
void check_turned_within(const std::string& source, const Recording& recording,
                         const Timeline& timeline, const Measurements& m,
                         const std::vector<Dwell>& dwells, std::vector<std::string>& wrong) {
  for (const Dwell& d : dwells) {
    constexpr std::size_t beside = PlanLimits::rows_beside_a_turn;
    for (std::size_t k = beside; k + beside <= d.rows.size(); ++k) {
      const std::size_t before = d.rows[k - 1], after = d.rows[k];
      double allowed = PlanLimits::turned;  // and by drift, by commands, and with the case
      for (std::size_t i = k - beside + 1; i < k + beside; ++i) {
        const Interval& to = timeline.intervals[d.rows[i]];
        const double lasts = to.t1 - timeline.intervals[d.rows[i - 1]].t1;
        allowed += (PlanLimits::drifted + to.omega_cmd_p.norm()) * lasts +
                   std::abs(to.heading1 - timeline.intervals[d.rows[i - 1]].heading1);
      }
      if (turn_between(m, before, after) < allowed ||
          turn_between(m, d.rows[k - beside], d.rows[k + beside - 1]) < allowed)
        continue;
      wrong.push_back(
          fmt::format("{}: within position {} the platform turns by {:.0f} deg at {} s{} (expected "
                      "one attitude in a position). Give the rows from there on the number of "
                      "their own position, or phase = 1 to those that are slewed",
                      source, d.position + 1, turn_between(m, before, after) / detail::deg,
                      timeline.intervals[after].t1,
                      recording.lines.size() == recording.rows()
                          ? fmt::format(", line {}", recording.lines[after])
                          : ""));
      break;
    }
  }
}

}  // namespace

void check_plan(const mc::Study& study, const Recording& recording,
                std::vector<std::string>& remarks, std::vector<std::string>& wrong) {
  const std::string source = recording.source.empty() ? "recording" : recording.source;
  const Timeline timeline = lay_out(recording, study.plan, study.site);
  const std::vector<Dwell> dwells = dwells_of(timeline);
  const Measurements measured = measurements_of(recording, study.readout);
  check_dwells(study, source, timeline, dwells, remarks);
  if (recording.find("cmd_x") != nullptr)
    check_commands(study, recording, timeline, measured, dwells, remarks, wrong);
  else
    check_law(study, source, timeline, measured, dwells, wrong);
  check_turned_within(source, recording, timeline, measured, dwells, wrong);
}

}  // namespace drift::preparation
