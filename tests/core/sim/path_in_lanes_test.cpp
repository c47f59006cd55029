#include "core/sim/path_in_lanes.hpp"

#include <gtest/gtest.h>

#include "tests/support/term_scenes.hpp"

namespace drift::path_in_lanes_test {
namespace {

using namespace drift::test;

struct Distance {
  double of_steps = 0.0, of_lanes = 0.0;  ///< from CVODE, largest over all nodes [rad]
};

Distance from_cvode(const char* preset, Coupling coupling) {
  const Timeline timeline = preset_timeline(preset, CommandLaw::free, 3600.0, 180.0);
  TruthSpec truth = base_truth(coupling);
  const TruthDraw draw = draw_truth(truth, timeline.chains, 3, 0);
  const DriftModel model = truth.model();
  const Trajectory cvode = Simulator(truth, Readout{}).run(timeline, draw, 3, 0).phi;
  const Trajectory steps = integrate_fixed(timeline, model, draw.theta, draw.psi0_l);
  Trajectory forward = steps, backward = steps;
  PathInLanes path(timeline, model);
  path.set_theta(draw.theta);
  const auto& all = timeline.intervals;
  for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
    for (end = first + 1; end < all.size() && !all[end].cage;) ++end;
    path.forward(first, end, forward.data());
    backward[all[end - 1].last_node()] = forward[all[end - 1].last_node()];
    path.backward(first, end, backward.data());
  }
  Distance out;
  for (std::size_t n = 0; n < cvode.size(); ++n) {
    out.of_steps = std::max(out.of_steps, (steps[n] - cvode[n]).norm());
    out.of_lanes = std::max(out.of_lanes, (forward[n] - cvode[n]).norm());
    // The same polynomials both ways: rounding, and what the last round leaves.
    EXPECT_LT((backward[n] - forward[n]).norm(), 1e-11) << preset << ' ' << n;
  }
  std::printf("%s %s: from CVODE, steps %.1e rad, lanes %.1e rad\n", preset,
              key_of(coupling).data(), out.of_steps, out.of_lanes);
  return out;
}

/// Second and third implementation: CVODE, whose tolerance allows 2e-8 rad over a day, and
/// Runge-Kutta steps. In slews, of nodes up to 0.05 rad apart, and in dwells both stay within
/// 1e-4 arcsec of it.
TEST(PathInLanes, IsTheMotionOfCvodeAsRungeKuttaStepsAre) {
  for (const char* preset : {"six", "slew12", "casespin"})
    for (const Coupling coupling : {Coupling::eq5, Coupling::eq6}) {
      const Distance d = from_cvode(preset, coupling);
      EXPECT_LT(d.of_lanes, 5e-10) << preset;
      EXPECT_LT(d.of_steps, 5e-10) << preset;
    }
}

/// What is commanded in a piece, and how the case turns, may change at any interval; steps need not
/// be even.
TEST(PathInLanes, CutsWhereSomethingChanges) {
  const Timeline timeline = scene("slew12", CommandLaw::level, 300.0, 60.0);
  const TruthSpec truth = base_truth(Coupling::eq6);
  const TruthDraw draw = draw_truth(truth, timeline.chains, 5, 0);
  const Trajectory steps = integrate_fixed(timeline, truth.model(), draw.theta, draw.psi0_l);
  PathInLanes lanes(timeline, truth.model());
  lanes.set_theta(draw.theta);
  // From interval to interval: nothing is shared, every piece is one of three nodes or more.
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    Trajectory one = steps;
    lanes.forward(i, i + 1, one.data());
    const std::size_t last = timeline.intervals[i].last_node();
    EXPECT_LT((one[last] - steps[last]).norm(), 1e-9) << i;
  }
}

}  // namespace
}  // namespace drift::path_in_lanes_test
