#include "analysis/blind/world.hpp"

#include <fmt/format.h>

#include "core/base/check.hpp"

namespace drift::blind {
namespace {

void add_errors(const World& world, Measurements& measured) {
  if (world.acc_error.cols() > 0) measured.acc += world.acc_error;
  if (world.gimbal_error.cols() == 0) return;
  for (Eigen::Index i = 0; i < measured.gimbal.cols(); ++i)
    for (int a = 0; a < 3; ++a)
      measured.gimbal(a, i) =
          angle_difference(measured.gimbal(a, i) + world.gimbal_error(a, i), 0.0);
}

Simulation simulate(const World& world, const TruthSpec& truth, const Readout& readout,
                    std::uint64_t seed, std::uint64_t run) {
  Simulator simulator(truth, readout);
  simulator.disturb(world.disturbance);
  Simulation sim = simulator.run(world.timeline, world.draw, seed, run);
  if (!sim.ode.ok())
    throw InputError(
        ExitCode::self_check,
        fmt::format("simulation of trial {} failed at t = {:.6g} s: {} ({}). The truth may be "
                    "unphysical: see `driftscope check`",
                    run, sim.ode.t, name(sim.ode.status), sim.ode.cause));
  add_errors(world, sim.measured);
  return sim;
}

}  // namespace

Simulation simulate_clean(const World& world, std::uint64_t seed, std::uint64_t run) {
  TruthSpec truth = world.truth;
  truth.coupling = facts(truth.coupling).settles_to;
  truth.noise = {};
  Readout readout = world.readout;
  readout.accelerometer_noise = readout.gimbal_noise = 0.0;
  return simulate(world, truth, readout, seed, run);
}

Simulation simulate_recorded(const World& world, std::uint64_t seed, std::uint64_t run) {
  Readout readout = world.readout;
  readout.accelerometer_noise *= world.acc_factor;
  readout.gimbal_noise *= world.gimbal_factor;
  return simulate(world, world.truth, readout, seed, run);
}

}  // namespace drift::blind
