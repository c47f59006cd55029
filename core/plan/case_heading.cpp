#include "core/plan/case_heading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/words.hpp"

namespace drift {
namespace {

/// Largest middle gimbal angle along a stretch that starts at R_lp [rad]. The middle angle is the
/// arc sine of the z_p component along the case's x axis.
double largest_middle(const Site& site, const Mat3& R_lp, const Stretch& s) {
  const double angle = (s.omega_cmd_p - R_lp.transpose() * site.omega_ie_l()).norm() * s.duration +
                       std::abs(s.heading1 - s.heading0);
  const int n = std::max(1, static_cast<int>(std::ceil(angle / (3.0 * detail::deg))));
  double largest = 0.0;
  for (int k = 0; k <= n; ++k) {
    const double part = static_cast<double>(k) / n;
    const Mat3 R = reference_attitude(site, R_lp, s.omega_cmd_p, part * s.duration);
    const Mat3 R_lc = case_attitude(s.heading0 + part * (s.heading1 - s.heading0));
    largest = std::max(largest, std::asin(std::min(1.0, std::abs(R_lc.col(0).dot(R.col(2))))));
  }
  return largest;
}

double whole_samples(double duration, double sample) {
  return std::max(1.0, std::ceil(duration / sample - 1e-9)) * sample;
}

Vec3 law_command(const Position& position, const Mat3& R_lp, const Site& site) {
  return position.mode == CommandLaw::level ? Vec3(R_lp.transpose() * site.omega_ie_l())
                                            : Vec3::Zero();
}

/// Turn of the case at the previous position's command, then slew, then dwell, for one heading.
Passage passage_to(const TestPlan& plan, const Site& site, std::size_t p, const Mat3& R_lp,
                   double heading, double new_heading) {
  const Position& position = plan.positions[p];
  Passage passage;
  passage.caged = position.entry == Entry::caged || p == 0;
  if (!passage.caged) {
    Mat3 R = R_lp;
    if (new_heading != heading) {
      Stretch turn;
      turn.slew = true;
      turn.duration =
          whole_samples(std::abs(new_heading - heading) / plan.case_rate, position.sample);
      turn.omega_cmd_p = law_command(plan.positions[p - 1], R, site);
      turn.heading0 = heading;
      turn.heading1 = new_heading;
      R = reference_attitude(site, R, turn.omega_cmd_p, turn.duration);
      passage.approach.push_back(turn);
    }
    const double angle = rotation_vector(R.transpose() * position.R_lp).norm();
    if (angle > 1e-9) {
      Stretch slew;
      slew.slew = true;
      slew.duration = whole_samples(angle / plan.slew_rate, position.sample);
      // R_lr(T) = exp(-w_ie T) R exp(w_cmd T) shall be the nominal attitude.
      slew.omega_cmd_p =
          rotation_vector(R.transpose() * rotation<double>(site.omega_ie_l() * slew.duration) *
                          position.R_lp) /
          slew.duration;
      slew.heading0 = slew.heading1 = new_heading;
      passage.approach.push_back(slew);
    }
  }
  passage.dwell.duration = position.dwell;
  passage.dwell.omega_cmd_p = law_command(position, position.R_lp, site);
  passage.dwell.heading0 = passage.dwell.heading1 = new_heading;
  return passage;
}

double largest_middle(const Site& site, Mat3 R_lp, const Mat3& R_position, const Passage& passage) {
  double largest = 0.0;
  for (const Stretch& s : passage.approach) {
    largest = std::max(largest, largest_middle(site, R_lp, s));
    R_lp = reference_attitude(site, R_lp, s.omega_cmd_p, s.duration);
  }
  return std::max(largest, largest_middle(site, R_position, passage.dwell));
}

/// Headings to try, nearest to the present one first.
std::vector<double> candidate_headings(double heading) {
  std::vector<double> all{heading};
  for (int k = 1; k <= 12; ++k)
    for (const double sign : {1.0, -1.0}) all.push_back(heading + sign * k * 15.0 * detail::deg);
  return all;
}

/// What a position that cannot be held needs instead. best: the middle gimbal's angle at the
/// heading that keeps it least [rad].
std::string lock_text(const Position& position, std::size_t p, double best) {
  std::vector<std::string> ways{"a case_heading of your own"};
  if (position.case_heading) ways = {"another case_heading", "none of your own"};
  if (position.entry == Entry::caged || p == 0)
    ways.emplace_back("a shorter dwell");
  else
    ways.insert(ways.end(), {"an intermediate position", "entry = \"caged\""});
  return fmt::format(
      "position {} ('{}'): the middle gimbal would reach {:.0f} deg on the way or in the dwell "
      "(at most {:.0f} deg is usable). Choose {}",
      p + 1, position.name, best / detail::deg, position.case_heading ? 85.0 : 60.0,
      listed(ways, "or"));
}

}  // namespace

std::vector<Passage> plan_passages(const TestPlan& plan, const Site& site) {
  std::vector<Passage> passages;
  Mat3 R_lp = Mat3::Identity();
  double heading = 0.0;
  for (std::size_t p = 0; p < plan.positions.size(); ++p) {
    const Position& position = plan.positions[p];
    // A caged position starts afresh, so its heading is sought from North.
    const bool caged = position.entry == Entry::caged || p == 0;
    const std::vector<double> candidates = position.case_heading
                                               ? std::vector<double>{*position.case_heading}
                                               : candidate_headings(caged ? 0.0 : heading);
    double best = std::numbers::pi;
    bool found = false;
    for (const double candidate : candidates) {
      Passage passage = passage_to(plan, site, p, R_lp, heading, candidate);
      const double middle = largest_middle(site, R_lp, position.R_lp, passage);
      best = std::min(best, middle);
      if (middle > middle_gimbal_limit && !position.case_heading) continue;
      if (middle > 85.0 * detail::deg) continue;  // a heading that was asked for, yet singular
      passages.push_back(std::move(passage));
      heading = candidate;
      found = true;
      break;
    }
    if (!found) throw GimbalLock(p, lock_text(position, p, best));
    const Stretch& dwell = passages.back().dwell;
    R_lp = reference_attitude(site, position.R_lp, dwell.omega_cmd_p, dwell.duration);
  }
  return passages;
}

}  // namespace drift
