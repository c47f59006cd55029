#include "core/sim/platform_ode.hpp"

#include <algorithm>
#include <numbers>
#include <type_traits>
#include <vector>

#include "core/base/check.hpp"
#include "core/base/dual.hpp"
#include "core/plan/case_heading.hpp"

namespace drift {
namespace {

/// Absolute tolerances of the loop's states relative to the attitude's (physics.md 6.2).
std::vector<double> servo_tolerances(const OdeOptions& options) {
  std::vector<double> tol(PlatformOde::servo_states);
  const auto fill = [&](int first, double scale) {
    for (int i = 0; i < 3; ++i) tol[first + i] = options.rel_tol * scale;
  };
  fill(ServoState::theta, 1e-5);
  fill(ServoState::theta_dot, 1e-5);
  fill(ServoState::compensator, 1e-4);
  fill(ServoState::omega_ip, 1e-6);
  fill(ServoState::size, 1e-3);
  return tol;
}

Cvode make_integrator(Coupling coupling, OdeOptions options) {
  if (coupling == Coupling::servo)
    return Cvode(Cvode::Method::bdf, options, servo_tolerances(options));
  // Tolerances are of one step and a test has a thousand: a quarter of each keeps the whole test
  // within 0.004 arcsec at rtol 1e-8 (physics.md 6.2).
  options.rel_tol *= 0.25;
  options.abs_tol *= 0.25;
  return Cvode(Cvode::Method::adams, 3, options);
}

}  // namespace

PlatformOde::PlatformOde(const DriftModel& model, const ServoOptions& servo,
                         const OdeOptions& options)
    : problem_(new Problem{model, servo, {}, {}, Mat3::Identity()}),
      rhs_(new Rhs{problem_.get()}),
      jacobian_(new Jacobian{problem_.get()}),
      ode_(make_integrator(model.coupling, options)) {
  problem_->drive.model = &problem_->model;
  if (model.coupling == Coupling::servo)
    ode_.system(*rhs_, *jacobian_);
  else
    ode_.system(*rhs_);
}

Mat3 PlatformOde::Problem::reference(double t) const {
  return reference_attitude(site, R_lr0, drive.omega_cmd_p, t - t0);
}

Vec3 PlatformOde::Problem::base_motion_l(double t) const {
  if (servo.base_amplitude == 0.0) return Vec3::Zero();
  const double w = 2.0 * std::numbers::pi * servo.base_frequency;
  const Vec3 rate_c = Vec3::Constant(servo.base_amplitude * w * std::cos(w * t));
  return case_attitude(heading0 + heading_rate * (t - t0)) * rate_c;
}

/// The interval that an instant of the segment belongs to.
const Interval& PlatformOde::Problem::interval_at(double t) const {
  const auto begin = drive.timeline->intervals.begin();
  const auto after =
      std::upper_bound(begin + static_cast<long>(first), begin + static_cast<long>(end), t,
                       [](double time, const Interval& i) { return time < i.t1; });
  return after == begin + static_cast<long>(end) ? *(after - 1) : *after;
}

/// What the terms see at a time of the segment, with the memory that they have of it then.
template <class S>
struct PlatformOde::Problem::SceneAt : Scene<S> {
  std::array<S, num_memory> memory_now;

  SceneAt(const Problem& p, double t, const Mat3T<S>& R_lp)
      : Scene<S>(p.drive.omega_ic_l + p.base_motion_l(t), p.drive.omega_cmd_p, p.model.mounting,
                 R_lp) {
    if (!p.drive.needs.any()) return;
    const Interval& interval = p.interval_at(t);
    if (p.drive.needs.memory) {
      const MemoryPoint m = p.memory->at_time(*p.drive.timeline, interval, t);
      for (std::size_t k = 0; k < num_memory; ++k) memory_now[k] = S(m.value[k]);
    }
    this->look_around(p.drive.needs, moment_at(*p.drive.timeline, interval, t), R_lp,
                      memory_now.data());
  }
};

bool PlatformOde::Problem::reduced(double t, const double* y, double* y_dot) const {
  if (!drive.needs.any()) {
    Eigen::Map<Vec3>(y_dot, 3) = attitude_rate_l(drive, reference(t), vec3(y), t, nullptr);
    return true;
  }
  std::array<double, num_memory> memory_now;
  Drive here = drive;
  here.interval = &interval_at(t);
  if (drive.needs.memory) memory_now = memory->at_time(*drive.timeline, *here.interval, t).value;
  Eigen::Map<Vec3>(y_dot, 3) = attitude_rate_l(here, reference(t), vec3(y), t, memory_now.data());
  return true;
}

/// The 15 equations of the loop and the attitude.
template <class S>
void PlatformOde::Problem::loop(double t, const S* y, S* y_dot) const {
  const Vec3T<S> phi = vec3(y + ServoState::size);
  const Mat3T<S> R_rp = rotation(phi);
  const Mat3T<S> R_lp = reference(t).template cast<S>() * R_rp;
  const SceneAt<S> scene(*this, t, R_lp);
  const S* theta;
  if constexpr (std::is_same_v<S, double>)
    theta = drive.theta;
  else
    theta = theta_dual.data();
  const Vec3T<S> unfelt_p = servo_derivative(servo, model, scene.in, theta, y, y_dot);
  const Vec3T<S> omega_ip_p =
      vec3(y + ServoState::omega_ip) + unfelt_p + drive.omega_noise_p.template cast<S>();
  const Vec3T<S> phi_dot = rotation_vector_rate(phi, R_rp, omega_ip_p, drive.omega_cmd_p);
  for (int i = 0; i < 3; ++i) y_dot[ServoState::size + i] = phi_dot[i];
}

bool PlatformOde::Rhs::operator()(double t, const double* y, double* y_dot) const {
  if (problem->model.coupling != Coupling::servo) return problem->reduced(t, y, y_dot);
  problem->loop(t, y, y_dot);
  return true;
}

bool PlatformOde::Jacobian::operator()(double t, const double* y, double* J) const {
  using D = Dual<servo_states>;
  std::array<D, servo_states> x, x_dot;
  for (int i = 0; i < servo_states; ++i) x[i] = D::variable(y[i], i);
  problem->loop(t, x.data(), x_dot.data());
  for (int k = 0; k < servo_states; ++k)
    for (int i = 0; i < servo_states; ++i) J[k * servo_states + i] = x_dot[i].d[k];
  return true;
}

OdeResult PlatformOde::segment(const Timeline& timeline, std::size_t first, std::size_t end,
                               const Theta& theta, const Vec3& omega_noise_p, const Vec3* psi0_l,
                               Trajectory& phi, const MemoryRecord* memory) {
  const Interval& start = timeline.intervals[first];
  const Node& node = timeline.nodes[start.first_node];
  Problem& p = *problem_;
  p.site = timeline.site;
  p.R_lr0 = node.R_lr;
  p.t0 = start.t0;
  p.heading0 = start.heading0;
  p.heading_rate = start.heading_rate();
  p.drive = drive_of(start, timeline, p.model, theta);
  p.drive.omega_noise_p = omega_noise_p;
  DRIFT_DEMAND(memory != nullptr || !p.drive.needs.memory);
  p.memory = memory;
  p.first = first;
  p.end = end;
  if (p.model.coupling == Coupling::servo)
    for (std::size_t i = 0; i < TermLibrary::num_params; ++i) p.theta_dual[i].v = theta[i];

  const bool servo = p.model.coupling == Coupling::servo;
  const int at_phi = servo ? ServoState::size : 0;
  if (psi0_l) {
    const Vec3 phi0 = caged_phi(node.R_lr, *psi0_l);
    Eigen::Map<Vec3>(y_.data() + at_phi, 3) = servo ? phi0 : Vec3(node.R_lr * phi0);
    if (servo) {
      const Problem::SceneAt<double> scene(p, start.t0, node.R_lr * rotation(phi0));
      Eigen::Map<Eigen::Matrix<double, ServoState::size, 1>>(y_.data()) =
          servo_at_rest(p.servo, p.model, scene.in, theta.data());
    }
  }
  ode_.start(start.t0, y_.data(), timeline.intervals[end - 1].t1);
  for (std::size_t i = first; i < end; ++i) {
    const Interval& interval = timeline.intervals[i];
    for (std::size_t k = interval.first_node; k <= interval.last_node(); ++k) {
      if (k == interval.first_node && i > first) {
        phi[k] = phi[k - 1];  // the last node of the interval before
        continue;
      }
      if (k > start.first_node) {
        const OdeResult r =
            ode_.advance(k == interval.last_node() ? interval.t1 : timeline.nodes[k].t);
        if (!r.ok()) return r;
      }
      const Vec3 y =
          vec3(k == start.first_node ? y_.data() + at_phi : ode_.state().data() + at_phi);
      phi[k] = servo ? y : Vec3(timeline.nodes[k].R_lr.transpose() * y);
    }
  }
  const auto state = ode_.state();
  std::copy(state.begin(), state.end(), y_.begin());
  return {};
}

}  // namespace drift
