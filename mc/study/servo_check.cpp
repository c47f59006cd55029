#include "mc/study/servo_check.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/config/node.hpp"
#include "core/physics/parameters_config.hpp"
#include "core/physics/servo_modes.hpp"

namespace drift::mc {
namespace {

/// The turn of the gyros about one axis that their misalignments make, as [truth] draws them and
/// were they all such a turn, e_xy = -e_yx [rad].
double turn_of_gyros(const TruthSpec& truth) {
  const ParamMask angles = params_named("gyro_misalignment");
  double squares = 0.0;
  for (std::size_t i = 0; i < angles.size(); ++i)
    if (angles[i] && truth.active[i])
      squares += std::pow(truth.priors[i].mean(), 2) + std::pow(truth.priors[i].sigma(), 2);
  return std::sqrt(squares / 2.0);
}

std::string swinging_at(const std::complex<double>& mode) {
  if (mode.imag() == 0.0) return "";
  return fmt::format(", swinging at {:.3g} Hz", std::abs(mode.imag()) / (2.0 * std::numbers::pi));
}

std::string slow_loop(const Study& study) {
  const double sample =
      std::ranges::min(study.plan.positions, {}, &Position::sample).sample;  // [s]
  const ServoModes modes = servo_modes(study.truth.servo, turn_of_gyros(study.truth));
  if (modes.time() <= sample) return "";
  const std::string settles =
      std::isfinite(modes.time())
          ? fmt::format("settles by a factor e in {:.3g} s{}, longer than", modes.time(),
                        swinging_at(modes.slowest))
          : fmt::format("does not settle{}, let alone within", swinging_at(modes.slowest));
  return fmt::format(
      "note: [truth.servo]: the loop {} the shortest sample of the plan ({:.6g} s): what it does "
      "on the way is in the rows, and in no filter. A longer lead, or a higher loop_gain, settles "
      "sooner\n",
      settles, sample);
}

std::string base_at_rest(const ServoOptions& servo) {
  const bool turns = servo.base_amplitude > 0.0, often = servo.base_frequency > 0.0;
  if (turns == often) return "";
  return fmt::format(
      "note: [truth.servo]: {} without {}: the base stands still. Give both, or neither\n",
      turns ? "base_amplitude" : "base_frequency", turns ? "base_frequency" : "base_amplitude");
}

}  // namespace

void check_servo(const config::Node& root, const Study& study, config::Report& report) {
  const config::Node* truth = root.find("truth");
  if (truth == nullptr) return;
  const config::Node* given = truth->find("servo");
  if (given == nullptr && study.truth.coupling != Coupling::servo) return;
  const config::Place& at = given == nullptr ? truth->at : given->at;
  const ServoOptions& servo = study.truth.servo;
  if (!servo.motor_coupling.fullPivLu().isInvertible()) {
    const config::Node* coupling = given == nullptr ? nullptr : given->find("motor_coupling");
    report.error(coupling == nullptr ? at : coupling->at,
                 "'truth.servo.motor_coupling' is singular: about one axis the motors answer no "
                 "gyro, and the loop is open (expected three independent rows). Correct it, or "
                 "leave it out: it is the identity then");
    return;
  }
  const ServoModes modes = servo_modes(servo, turn_of_gyros(study.truth));
  if (!modes.grows()) return;
  report.error(
      at, fmt::format("'truth.servo' makes an unstable loop: at rest a disturbance grows by a "
                      "factor e every {:.3g} s{} (expected a loop that settles, with gyros turned "
                      "by as much as the misalignments of [truth], too). Make lead longer against "
                      "lag and float_inertia / float_damping, lower loop_gain, or let "
                      "motor_coupling be nearer to the identity",
                      modes.time(), swinging_at(modes.slowest)));
}

std::string servo_notes(const Study& study) {
  const bool integrates = study.has_truth && study.kind == RecordingKind::platform &&
                          study.truth.coupling == Coupling::servo;
  if (!integrates || study.plan.positions.empty()) return "";
  return slow_loop(study) + base_at_rest(study.truth.servo);
}

}  // namespace drift::mc
