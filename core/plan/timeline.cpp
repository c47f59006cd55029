#include "core/plan/timeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/plan/case_heading.hpp"
#include "core/plan/plan_memory.hpp"

namespace drift {
namespace {

/// Adds a stretch of constant command, cut into whole samples.
void add_stretch(Timeline& timeline, const Stretch& stretch, const Position& position, int index,
                 double& t, double heading0, double heading1, bool cage) {
  const double exact = stretch.duration / position.sample;
  const auto n = std::max<long>(1, std::lround(exact));
  const double start = t;
  for (long k = 0; k < n; ++k) {
    Interval i;
    i.t0 = t;
    i.t1 = start + stretch.duration * static_cast<double>(k + 1) / static_cast<double>(n);
    i.position = index;
    i.slew = stretch.slew;
    i.cage = cage && k == 0;
    if (i.cage) ++timeline.chains;
    i.chain = timeline.chains - 1;
    i.omega_cmd_p = stretch.omega_cmd_p;
    const auto heading = [&](long m) {
      return heading0 + (heading1 - heading0) * static_cast<double>(m) / static_cast<double>(n);
    };
    i.heading0 = heading(k);
    i.heading1 = heading(k + 1);
    timeline.intervals.push_back(i);
    t = i.t1;
  }
}

/// When each recording and each dwell began.
void set_clocks(std::vector<Interval>& intervals) {
  for (std::size_t k = 0; k < intervals.size(); ++k) {
    Interval& i = intervals[k];
    const Interval* before = k > 0 ? &intervals[k - 1] : nullptr;
    i.begins = i.begins || !before;
    i.t_begin = i.begins ? i.t0 : before->t_begin;
    const bool goes_on = before && before->position == i.position && !before->slew && !i.cage;
    i.t_dwell = goes_on ? before->t_dwell : i.t0;
  }
}

}  // namespace

double Timeline::mean_weight(int substeps, std::size_t k) {
  const std::size_t last = 2 * static_cast<std::size_t>(substeps);
  const bool at_end = k == 0 || k == last;
  if (substeps % 2 == 1) return (at_end ? 1.0 : k % 2 == 1 ? 4.0 : 2.0) / (6.0 * substeps);
  return (at_end ? 7.0 : k % 2 == 1 ? 32.0 : k % 4 == 2 ? 12.0 : 14.0) / (45.0 * substeps);
}

std::vector<std::size_t> Timeline::lacking(CovariateSet wanted) const {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < recordings.size(); ++k)
    if ((wanted & ~recordings[k].carried) != 0) out.push_back(k);
  if (out.size() == recordings.size()) out.clear();
  return out;
}

Timeline lay_out(const TestPlan& plan, const Site& site) {
  require_memory_for(plan);
  Timeline timeline;
  timeline.site = site;
  timeline.positions = static_cast<int>(plan.positions.size());
  std::vector<Mat3> chain_start;
  const std::vector<Passage> passages = plan_passages(plan, site);
  double t = 0.0;
  for (std::size_t p = 0; p < passages.size(); ++p) {
    const Passage& passage = passages[p];
    const Position& position = plan.positions[p];
    const int index = static_cast<int>(p);
    if (passage.caged) chain_start.push_back(position.R_lp);
    for (const Stretch& s : passage.approach)
      add_stretch(timeline, s, position, index, t, s.heading0, s.heading1, false);
    add_stretch(timeline, passage.dwell, position, index, t, passage.dwell.heading0,
                passage.dwell.heading1, passage.caged);
  }
  place_nodes(timeline, chain_start);
  return timeline;
}

void place_nodes(Timeline& timeline, const std::vector<Mat3>& R_lp, double longest_step) {
  DRIFT_DEMAND(static_cast<int>(R_lp.size()) == timeline.chains);
  const Vec3 omega_ie_l = timeline.site.omega_ie_l();
  Mat3 R_lr = Mat3::Identity();
  double t_cage = 0.0;
  timeline.nodes.clear();
  set_clocks(timeline.intervals);
  for (Interval& i : timeline.intervals) {
    if (i.cage) {
      R_lr = R_lp[i.chain];
      t_cage = i.t0;
    }
    double turned =
        i.rest ? 0.0 : (i.omega_cmd_p - R_lr.transpose() * omega_ie_l).norm() * i.length();
    // What follows a gimbal's angle is a sine of it: of steps of a quarter of a radian Simpson's
    // rule is off by 2e-5, where the attitude is integrated to far less than it is known.
    constexpr double of_the_case = 0.2;
    turned = std::max(turned, of_the_case * std::abs(i.heading1 - i.heading0));
    // By twos, for the rule of the higher order, which may take longer ones.
    if (turned > i.substeps * longest_step)
      i.substeps =
          std::max(i.substeps, 2 * static_cast<int>(std::ceil(0.25 * turned / longest_step)));
    i.first_node = timeline.nodes.size();
    const Vec3 omega_ic_l = omega_ie_l + i.heading_rate() * up_l;
    for (std::size_t k = 0; k < i.node_count(); ++k) {
      const double step = i.length() / (2.0 * i.substeps);
      const double tau = step * static_cast<double>(k);
      Node node;
      node.t = i.t0 + tau;
      const auto reference = [&](double after) -> Mat3 {
        return i.rest ? R_lr : reference_attitude(timeline.site, R_lr, i.omega_cmd_p, after);
      };
      node.R_lr = reference(tau);
      node.R_lr_half = reference(tau + 0.5 * step);
      node.R_il = rotation<double>(omega_ie_l * (node.t - t_cage));
      node.omega_ic_l = omega_ic_l;
      timeline.nodes.push_back(node);
    }
    R_lr = timeline.nodes.back().R_lr;
  }
}

}  // namespace drift
