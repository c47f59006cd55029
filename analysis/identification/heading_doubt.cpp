#include "analysis/identification/heading_doubt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/inference/thresholds.hpp"
#include "analysis/planning/attitudes.hpp"
#include "analysis/preparation/dwell_turn.hpp"
#include "analysis/preparation/recorded_test.hpp"
#include "core/base/check.hpp"
#include "core/estimate/batch.hpp"
#include "core/estimate/layout.hpp"
#include "core/plan/case_heading.hpp"
#include "core/stats/chi_square_band.hpp"

namespace drift::identification {
namespace {

using inference::FitLimits;
using inference::SiteLimits;

constexpr double right_angle = 90.0 * detail::deg, half_right_angle = 45.0 * detail::deg;
constexpr double right_studies = 1.0 / SiteLimits::another;  // for one with wrong headings

/// Positions whose attitude is carried along, so that they can only be turned together.
using Caging = std::vector<std::size_t>;

std::vector<Caging> cagings_of(const std::vector<Passage>& passages) {
  std::vector<Caging> all;
  for (std::size_t p = 0; p < passages.size(); ++p) {
    if (passages[p].caged) all.emplace_back();
    all.back().push_back(p);
  }
  return all;
}

/// A position turned about Up [rad]; empty where `axes` cannot say so. Turns about its own axes
/// come behind them and stay.
std::optional<Position> turned(Position p, double turn) {
  const Mat3 own = rotation_of(p.turns);
  auto attitude = planning::attitude_of(case_attitude(turn) * p.R_lp * own.transpose());
  if (!attitude) return std::nullopt;
  p.axes = std::move(attitude->axes);
  p.R_lp = attitude->R_lp * own;
  return p;
}

/// Earth rate in the axes of the plan, summed over the dwells of each position [rad/s].
std::vector<Vec3> earth_rates(const mc::Study& study, const std::vector<Recording>& recordings) {
  std::vector<Vec3> sums(study.plan.positions.size(), Vec3::Zero());
  for (const Recording& r : recordings) {
    const Timeline timeline = lay_out(r, study.plan, study.site);
    const Measurements measured = measurements_of(r, study.readout);
    for (const preparation::Dwell& d : preparation::dwells_of(timeline)) {
      const Position& p = study.plan.positions[static_cast<std::size_t>(d.position)];
      const auto turn = preparation::turn_of(d, timeline, measured, p);
      if (!turn) continue;
      Vec3 command = Vec3::Zero();
      for (const std::size_t k : d.rows)
        command += timeline.intervals[k].omega_cmd_p / static_cast<double>(d.rows.size());
      sums[static_cast<std::size_t>(d.position)] += p.R_lp * command - turn->rate_l;
    }
  }
  return sums;
}

/// The multiple of 45 deg that `axes` can say of all these positions and that is nearest to the
/// turn that brings North to where the Earth rate has it.
double nearest_turn(const TestPlan& plan, const Caging& positions, const Vec3& earth_l) {
  const double shown = std::atan2(-earth_l.y(), earth_l.x());
  double best = 0.0;
  for (int k = -3; k <= 4; ++k) {
    const double turn = k * half_right_angle;
    const auto off = [&](double t) {
      return std::abs(std::remainder(shown - t, 4.0 * right_angle));
    };
    if (off(turn) < off(best) && std::ranges::all_of(positions, [&](std::size_t p) {
          return turned(plan.positions[p], turn).has_value();
        }))
      best = turn;
  }
  return best;
}

/// The plan turned, position by position.
std::vector<Position> turned_plan(const TestPlan& plan, const std::vector<Passage>& passages,
                                  const std::vector<double>& turns, bool gimbals) {
  std::vector<Position> positions = plan.positions;
  for (std::size_t p = 0; p < positions.size(); ++p) {
    // Headings that the plan left open were chosen: the case stood as its gimbals say.
    if (gimbals) positions[p].case_heading = passages[p].dwell.heading1 + turns[p];
    if (turns[p] != 0.0) positions[p] = turned(std::move(positions[p]), turns[p]).value();
  }
  return positions;
}

/// A recorded heading of the case is as wrong as the plan that gimbals agree with.
Recording turned_recording(Recording r, const std::vector<double>& turns) {
  const std::vector<double> positions = r.find("position")->values;
  for (Channel& c : r.channels)
    for (std::size_t k = 0; c.name == "case_heading" && k < c.values.size(); ++k)
      c.values[k] += turns[static_cast<std::size_t>(std::lround(positions[k])) - 1];
  return r;
}

struct Fit {
  std::vector<double> turns;
  std::vector<Position> positions;
  double choices = 0.0;  ///< turns that were free
  double cost = std::numeric_limits<double>::infinity(), dof = 1.0;
  double per_dof() const { return cost / dof; }
};

void fit(Fit& f, mc::Study study, std::vector<Recording> recordings, const FilterSpec& filter) {
  study.plan.positions = f.positions;
  for (Recording& r : recordings) r = turned_recording(std::move(r), f.turns);
  try {
    const preparation::RecordedTest test = preparation::recorded_test(study, recordings);
    const BatchResult result =
        fit_batch(filter, {test.timeline, study.readout, test.measured}, make_layout(filter).theta,
                  {.result = BatchOptions::Result::estimates});
    f.cost = result.estimate.statistic;
    f.dof = static_cast<double>(std::max<std::size_t>(1, result.estimate.measured));
  } catch (const InputError&) {
    // Not a plan that this recording can be of.
  }
}

/// Log of the probability of the plan as it is, after a fit that is so much better.
double log_chance(const Fit& before, const Fit& after) {
  const double gain = (before.cost - after.cost) / std::max(1.0, after.per_dof());  // 2 log L
  return std::log(right_studies) + after.choices * std::log(SiteLimits::other_headings) -
         0.5 * gain;
}

}  // namespace

bool HeadingDoubt::alone() const {
  return chance_after >= inference::SearchLimits::alpha;
}

std::optional<HeadingDoubt> heading_doubt(const mc::Study& study,
                                          const std::vector<Recording>& recordings,
                                          const FilterSpec& filter) {
  const TestPlan& plan = study.plan;
  const std::size_t count = plan.positions.size();
  const std::vector<Passage> passages = plan_passages(plan, study.site);
  const std::vector<Vec3> rates = earth_rates(study, recordings);
  const auto recorded = [&](const char* channel) {
    return std::ranges::any_of(recordings,
                               [&](const Recording& r) { return r.find(channel) != nullptr; });
  };
  const bool gimbals = recorded("gimbal_inner");

  std::vector<Fit> tried(1);
  tried[0].turns.assign(count, 0.0);
  Fit each = tried[0];
  Vec3 of_all = Vec3::Zero();
  Caging all;
  for (const Caging& caging : cagings_of(passages)) {
    Vec3 sum = Vec3::Zero();
    for (const std::size_t p : caging) sum += rates[p];
    const double turn = nearest_turn(plan, caging, sum);
    for (const std::size_t p : caging) each.turns[p] = turn;
    each.choices += turn != 0.0 ? 1.0 : 0.0;
    of_all += sum;
    all.insert(all.end(), caging.begin(), caging.end());
  }
  const Fit alike{.turns = std::vector<double>(count, nearest_turn(plan, all, of_all)),
                  .positions = {},
                  .choices = 1.0};
  if (each.choices > 0.0) tried.push_back(each);
  if (alike.turns.front() != 0.0) tried.push_back(alike);
  if (tried.size() == 1) return std::nullopt;

  tried[0].positions = plan.positions;
  for (std::size_t k = 1; k < tried.size(); ++k)
    tried[k].positions = turned_plan(plan, passages, tried[k].turns, gimbals);
  for (Fit& f : tried) fit(f, study, recordings, filter);
  const Fit& before = tried.front();
  if (!std::isfinite(before.cost)) return std::nullopt;
  const Fit& best = *std::min_element(
      tried.begin() + 1, tried.end(),
      [&](const Fit& a, const Fit& b) { return log_chance(before, a) < log_chance(before, b); });
  const double chance = log_chance(before, best);
  if (!(chance < std::log(right_studies) - 0.5 * FitLimits::mirrored)) return std::nullopt;
  HeadingDoubt doubt{.turned = {},
                     .positions = best.positions,
                     .chi2_per_dof_before = before.per_dof(),
                     .chi2_per_dof_after = best.per_dof(),
                     .chance = std::exp(chance)};
  doubt.recorded = recorded("case_heading");
  if (doubt.chi2_per_dof_before - doubt.chi2_per_dof_after <
      SiteLimits::most * (doubt.chi2_per_dof_before - 1.0))
    return std::nullopt;
  doubt.chance_after = stats::misfit_chance(best.per_dof(), best.dof);
  for (std::size_t p = 0; p < count; ++p)
    if (best.turns[p] != 0.0) doubt.turned.push_back({static_cast<int>(p), best.turns[p]});
  doubt.all_alike =
      std::ranges::all_of(best.turns, [&](double turn) { return turn == best.turns.front(); });
  return doubt;
}

}  // namespace drift::identification
