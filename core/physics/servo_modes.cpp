#include "core/physics/servo_modes.hpp"

#include <Eigen/Eigenvalues>
#include <array>
#include <limits>

#include "core/base/dual.hpp"
#include "core/physics/servo.hpp"

namespace drift {
namespace {

using StateMatrix = Eigen::Matrix<double, ServoState::size, ServoState::size>;

StateMatrix jacobian_at_rest(const ServoOptions& servo) {
  constexpr int n = ServoState::size;
  using D = Dual<15>;  // as the integrator has it, compiled once
  const DriftModel model{Coupling::servo, {}, {}};
  const Vec3 nothing = Vec3::Zero();
  const Inputs<D> in{&model.mounting, Vec3(0.0, 0.0, 1.0).cast<D>(), nothing.cast<D>(), nothing};
  const std::array<D, TermLibrary::num_params> theta{};
  std::array<D, n> x, x_dot;
  for (int i = 0; i < n; ++i) x[i] = D::variable(0.0, i);
  servo_derivative(servo, model, in, theta.data(), x.data(), x_dot.data());
  StateMatrix J;
  for (int i = 0; i < n; ++i) J.row(i) = x_dot[i].d.head<n>().matrix().transpose();
  return J;
}

}  // namespace

ServoModes servo_modes(const ServoOptions& servo, double turned) {
  // The states of the first two axes.
  constexpr std::array pair{0, 1, 3, 4, 6, 7, 9, 10};
  ServoOptions alone = servo;
  alone.coulomb = 0.0;
  ServoModes all{{-std::numeric_limits<double>::infinity(), 0.0}, 0.0};
  const Eigen::Vector3cd gains = servo.motor_coupling.eigenvalues();
  for (const std::complex<double>& gain : gains) {
    const double a = gain.real(), b = std::abs(gain.imag()) + std::abs(gain) * turned;
    alone.motor_coupling << a, -b, 0.0, b, a, 0.0, 0.0, 0.0, 1.0;
    const Eigen::MatrixXd A = jacobian_at_rest(alone)(pair, pair);
    const double rounding = ServoState::size * std::numeric_limits<double>::epsilon() * A.norm();
    const Eigen::VectorXcd modes = A.eigenvalues();
    for (const std::complex<double>& mode : modes)
      if (mode.real() > all.slowest.real()) all = {mode, rounding};
  }
  return all;
}

}  // namespace drift
