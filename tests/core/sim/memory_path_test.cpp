// What terms with memory do to the platform where gimbals reverse, within steps of fixed length and
// by an integrator that chooses its own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/sim/trajectory.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::memory_path_test {
namespace {

using namespace drift::test;

/// One term of which one parameter, or none, has an amplitude: one prior sigma.
struct Remembering {
  TruthSpec truth = base_truth(Coupling::eq6);
  Theta theta = Theta::Zero();

  explicit Remembering(const TermInfo& term, std::size_t amplitude = TermLibrary::num_params) {
    truth.active = params_named(term.key);
    for (std::size_t i = term.first; i < term.first + term.count; ++i) {
      const Prior prior = TermLibrary::specs[i].prior_si();
      theta[i] = prior.mean();
      if (i == amplitude) theta[i] += prior.sigma();
    }
  }
};

/// phi at the ends of rows, from one timeline to another of finer steps or by another way.
double farthest_apart(const Timeline& a, const Trajectory& along_a, const Timeline& b,
                      const Trajectory& along_b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.intervals.size(); ++i)
    worst = std::max(
        worst, (along_a[a.intervals[i].last_node()] - along_b[b.intervals[i].last_node()]).norm());
  return worst / arcsec;
}

Timeline finer(const Timeline& timeline, int times) {
  Timeline fine = timeline;
  std::vector<Mat3> R_lp;
  for (Interval& i : fine.intervals) {
    if (i.cage) R_lp.push_back(timeline.nodes[i.first_node].R_lr);
    i.substeps *= times;
  }
  place_nodes(fine, R_lp);
  return fine;
}

Trajectory stepped(const Timeline& timeline, const Remembering& m) {
  return integrate_fixed(
      timeline, m.truth.model(), m.theta,
      std::vector<Vec3>(static_cast<std::size_t>(timeline.chains), Vec3::Zero()));
}
Trajectory by_cvode(const Timeline& timeline, const Remembering& m) {
  const TruthDraw draw{m.theta,
                       std::vector<Vec3>(static_cast<std::size_t>(timeline.chains), Vec3::Zero())};
  const Simulation sim = Simulator(m.truth, {}).run(timeline, draw, 1, 0);
  EXPECT_TRUE(sim.ode.ok()) << sim.ode.cause;
  return sim.phi;
}

TEST(MemoryPath, LeadsThePlatformWhereTheTruthIsThoughTheCaseTurns) {
  // Gimbals reverse dozens of times while their axes turn by up to 15 deg a step, and stand for 40
  // min where they were: of the friction's parabola its moments are exact, and what is left of a
  // change of 2 P is the third power of the turn of a step, (0.2 rad)^3 / 100 of it.
  for (const double sample : {60.0, 300.0})
    for (const CommandLaw mode : {CommandLaw::level, CommandLaw::free}) {
      const Timeline timeline = preset_timeline("casespin", mode, 2400.0, sample);
      for (const TermInfo& term : TermLibrary::terms) {
        if (term.memory == 0 || !term.in_rates) continue;
        for (std::size_t i = term.first; i < term.first + term.count; ++i) {
          if (!TermLibrary::specs[i].amplitude()) continue;
          SCOPED_TRACE(fmt::format("{} {} s {}", TermLibrary::specs[i].key.view(), sample,
                                   mode == CommandLaw::free ? "free" : "level"));
          const Remembering m(term, i);
          const Trajectory phi = stepped(timeline, m), truth = by_cvode(timeline, m);
          EXPECT_LT(farthest_apart(timeline, phi, timeline, truth), 1e-3);
        }
      }
    }
}

TEST(MemoryPath, ConvergesByTheThirdOrderWhereGimbalsReverse) {
  const TermInfo& term = TermLibrary::terms[TermLibrary::find_term("float_restraint").value()];
  for (const char* preset : {"casespin", "slew12"}) {
    SCOPED_TRACE(preset);
    const Timeline timeline = preset_timeline(preset, CommandLaw::level, 1200.0, 300.0);
    for (const char* key : {"P_outer", "P_middle"}) {
      SCOPED_TRACE(key);
      const Remembering m(term, param(key));
      const Timeline best = finer(timeline, 32);
      const Trajectory limit = stepped(best, m);
      double before = 0.0;
      for (const int times : {1, 2, 4}) {
        const Timeline fine = finer(timeline, times);
        const double error = farthest_apart(fine, stepped(fine, m), best, limit);
        // Where in a step a gimbal reverses is not the same twice: less than eight, on the whole.
        if (times > 1) EXPECT_LT(error, before / 4.0);
        before = error;
      }
      EXPECT_LT(before, 5e-5);
    }
  }
}

}  // namespace
}  // namespace drift::memory_path_test
