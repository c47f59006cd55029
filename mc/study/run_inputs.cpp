#include "mc/study/run_inputs.hpp"

#include <algorithm>

#include "core/base/sha256.hpp"
#include "core/physics/own/own_terms.hpp"
#include "core/plan/case_heading.hpp"

namespace drift::mc {
namespace {

/// Members are taken apart by name, all of a struct: one that is added to it does not compile here
/// until it is said whether runs read it.
class RunInputs {
 public:
  template <class... Values>
  void add(const Values&... values) {
    (put(values), ...);
  }
  std::string digest() const {
    Sha256 sum;
    sum.update(std::span(numbers_));
    return sum.finish();
  }

  void add_plan(const TestPlan& plan, const Site& site);
  void add_readout(const Readout& readout);
  void add_course(const CovariateCourse& course);
  void add_model(const ModelSpec& model, bool accelerometer_axes);
  void add_servo(const ServoOptions& servo);
  void add_truth(const TruthSpec& truth, bool accelerometer_axes);
  void add_filter(const FilterSpec& filter, bool accelerometer_axes);

 private:
  void put(double value) { numbers_.push_back(value); }
  void put(bool value) { numbers_.push_back(value ? 1.0 : 0.0); }
  void put(int value) { numbers_.push_back(value); }
  void put(std::size_t value) { numbers_.push_back(static_cast<double>(value)); }
  template <class E>
  requires std::is_enum_v<E>
  void put(E value) { numbers_.push_back(static_cast<double>(value)); }
  template <class Derived>
  void put(const Eigen::MatrixBase<Derived>& values) {
    for (const double v : values.reshaped()) numbers_.push_back(v);
  }
  void put(const std::string& text) {
    for (const char c : text) put(static_cast<int>(c));
  }
  void put(const Prior& prior) {
    const auto& [kind, a, b] = prior;
    add(kind, a, b);
  }
  void put(const Stretch& stretch) {
    const auto& [duration, omega_cmd_p, slew, heading0, heading1] = stretch;
    add(duration, omega_cmd_p, slew, heading0, heading1);
  }
  void put(const Triads& triads) {
    const auto& [second, third] = triads;
    for (const auto& axes : {second, third})
      for (const SignedAxis& axis : axes) add(axis.index, axis.sign);
  }

  std::vector<double> numbers_;
};

void RunInputs::add_plan(const TestPlan& plan, const Site& site) {
  const auto& [latitude, gravity, north_known] = site;  // gravity: of recordings alone
  add(latitude, north_known);
  const std::vector<Passage> passages = plan_passages(plan, site);
  for (std::size_t p = 0; p < passages.size(); ++p) {
    // Of a position the rest is resolved in its passage, or is a text.
    const auto& [name, axes, turns, R_lp, dwell, sample, mode, entry, case_heading] =
        plan.positions[p];
    const auto& [caged, approach, dwelling] = passages[p];
    add(R_lp, sample, caged, approach.size());
    for (const Stretch& stretch : approach) add(stretch);
    add(dwelling);
  }
}

void RunInputs::add_readout(const Readout& readout) {
  const auto& [accelerometers, gimbals, accelerometer_noise, gimbal_noise, accelerometers_rounded,
               gimbals_rounded, at_most] = readout;
  add(accelerometers, gimbals, at_most);
  if (accelerometers) add(accelerometer_noise, accelerometers_rounded);
  if (gimbals) add(gimbal_noise, gimbals_rounded);
}

void RunInputs::add_course(const CovariateCourse& course) {
  const auto& [mean, amplitude, period, phase, ramp, fluctuation] = course;
  for (const auto& component : mean) add(component.has_value(), component.value_or(0.0));
  add(amplitude, period, phase, ramp, fluctuation);
}

void RunInputs::add_model(const ModelSpec& model, bool accelerometer_axes) {
  const auto& [coupling, active, priors, initial_attitude, noise, mounting] = model;
  const auto& [angle_random_walk, drift_random_walk] = noise;
  add(coupling, active.count());
  for (std::size_t i = 0; i < active.size(); ++i)
    if (active[i]) add(i, priors[i]);
  add(initial_attitude, angle_random_walk, drift_random_walk, mounting.gyro);
  if (accelerometer_axes) add(mounting.accelerometer);
}

void RunInputs::add_servo(const ServoOptions& servo) {
  const auto& [wheel_momentum, float_inertia, float_damping, float_restraint, platform_inertia,
               loop_gain, lead, lag, viscous, coulomb, coulomb_rate, constant_torque,
               motor_coupling, float_dynamics, base_amplitude, base_frequency] = servo;
  add(wheel_momentum, float_inertia, float_damping, float_restraint, platform_inertia, loop_gain,
      lead, lag, viscous, coulomb, coulomb_rate, constant_torque, motor_coupling, float_dynamics,
      base_amplitude, base_frequency);
}

void RunInputs::add_truth(const TruthSpec& truth, bool accelerometer_axes) {
  add_model(truth, accelerometer_axes);
  if (truth.coupling == Coupling::servo) add_servo(truth.servo);
  if (truth.coupling == Coupling::compensated) add(truth.loop, truth.theta_loop);
}

void RunInputs::add_filter(const FilterSpec& filter, bool accelerometer_axes) {
  add_model(filter, accelerometer_axes);
  add(filter.drawn_starts, filter.starts.size());
  for (const Start& start : filter.starts) {
    add(start.size());
    for (const auto& [param, value] : start) add(param, value);
  }
}

/// Whether a truth has parameters that a design spreads: initial attitudes and noise are random in
/// every design.
bool spreads(const TruthSpec& truth) {
  for (std::size_t i = 0; i < truth.active.size(); ++i)
    if (truth.active[i] && truth.priors[i].kind != Prior::Kind::fixed) return true;
  return false;
}

/// Whether a term acts on what the accelerometers say: of terms those alone see how they sit.
bool acts_on_accelerometers(const TermMask& terms) {
  for (std::size_t t = 0; t < TermLibrary::num_terms; ++t)
    if (terms[t] && TermLibrary::terms[t].in_readout) return true;
  return false;
}

}  // namespace

std::string run_inputs(const Study& study) {
  if (study.kind != RecordingKind::platform || !study.has_truth || study.filters.empty()) return "";
  TermMask terms = study.truth.model().terms;
  for (const FilterSpec& filter : study.filters) terms |= filter.model().terms;
  const bool axes = acts_on_accelerometers(terms);
  const CovariateSet followed = TermLibrary::needs(terms).covariates;
  RunInputs inputs;
  inputs.add_plan(study.plan, study.site);
  inputs.add_readout(study.readout);
  for (const CovariateSpec& c : known_covariates)
    if ((followed & c.set()) != 0) inputs.add_course(study.environment[c]);
  inputs.add_truth(study.truth, axes);
  for (const OwnTerm& term : own_terms().terms)
    inputs.add(term.declaration.size(), term.declaration);
  inputs.add(study.filters.size());
  for (const FilterSpec& filter : study.filters) inputs.add_filter(filter, axes);
  const auto& [runs, seed, allowed_failures, design, estimator, healthy_sigma, stop] =
      study.monte_carlo;
  if (spreads(study.truth)) inputs.add(design);
  inputs.add(estimator, healthy_sigma);
  return inputs.digest();
}

}  // namespace drift::mc
