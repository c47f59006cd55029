#include "core/estimate/strapdown/rotation.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "core/base/check.hpp"

namespace drift::strapdown {
namespace {

// Factors by which parameters enter the rate, for the Jacobian:
// w_ic (3), (I + S)^-1 (w_g - w_l) (3), 1, f (3), f_x^2 f_y^2 f_z^2 f_x f_y f_y f_z f_z f_x.
constexpr int num_factors = 16, num_turning_factors = 6;  // the first six for s, eta, xi
constexpr int of_rate = 0, of_scaled = 3, of_one = 6, of_force = 7, of_square = 10;

int of_product(int a, int b) {
  if (a == b) return of_square + a;
  return of_square + 3 + ((a + 1) % 3 == b ? a : b);
}

// The drift parameters come first in the library.
constexpr int num_drift_params = TermLibrary::index("eta_x");
static_assert(TermLibrary::index("D_F_x") == 0 &&
              TermLibrary::index("D_OS_z") < TermLibrary::index("eta_x"));

/// d w_ic / d parameter = -weight * C^-1 e_axis * factor.
struct Lever {
  int axis = 0;
  int factor = 0;
  double weight = 0.0;
};

Lever lever_of(std::size_t param, const Vec3& s, Coupling equation) {
  static const Mounting mounting;
  const ParamSpec& spec = TermLibrary::specs[param];
  const std::string_view group = spec.group.view();
  const int i = spec.key.view().back() - 'x';
  const SignedAxis out = mounting.gyro.second[i], spin = mounting.gyro.third[i];
  const double drift = 1.0 / (1.0 + s[i]);
  const double tilt = equation == Coupling::eq6 ? 0.0 : 1.0;
  if (group == "eta") return {i, of_rate + spin.index, tilt * spin.sign};
  if (group == "xi") return {i, of_rate + out.index, tilt * out.sign};
  if (group == "s") return {i, of_scaled + i, drift};
  if (group == "D_F") return {i, of_one, drift};
  if (group == "D_I") return {i, of_force + i, drift};
  if (group == "D_O") return {i, of_force + out.index, drift * out.sign};
  if (group == "D_S") return {i, of_force + spin.index, drift * spin.sign};
  if (group == "D_II") return {i, of_product(i, i), drift};
  if (group == "D_OO") return {i, of_product(out.index, out.index), drift};
  if (group == "D_SS") return {i, of_product(spin.index, spin.index), drift};
  if (group == "D_IO") return {i, of_product(i, out.index), drift * out.sign};
  if (group == "D_IS") return {i, of_product(i, spin.index), drift * spin.sign};
  DRIFT_EXPECTS(group == "D_OS");
  return {i, of_product(out.index, spin.index), drift * out.sign * spin.sign};
}

Mat3 misalignment(const Theta& theta) {
  static const Mounting mounting;
  const Inputs<double> in{&mounting, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  RateAssembly<double> out;
  terms::GyroMisalignment::rates(in, theta.data() + TermLibrary::index("eta_x"), out);
  return out.E_gp;
}

bool usable(const Signals& s, std::size_t first, std::size_t last) {
  for (std::size_t k = first; k <= last; ++k)
    if (!s.measured(k) || (k > first && s.time[k] - s.time[k - 1] > 2.5 * s.interval)) return false;
  return true;
}

/// Calls visit(R, C^-1, dt, w_ic dt, (I + S)^-1 (w_g - w_l) dt, f_c) before each step.
Mat3 integrate(const Rotation& rotation, Coupling equation, const Theta& theta, auto&& visit) {
  const Mat3 E = equation == Coupling::eq6 ? Mat3(Mat3::Zero()) : misalignment(theta);
  const Mat3 C_inverse = (Mat3::Identity() + E).inverse();
  const bool drifts = (theta.head<num_drift_params>().array() != 0.0).any();
  const Vec3 scale = (Vec3::Ones() + vec3(theta.data() + TermLibrary::index("s_x"))).cwiseInverse();
  Mat3 R = Mat3::Identity();
  for (std::size_t k = 0; k < rotation.dt.size(); ++k) {
    Vec3 scaled = rotation.theta_g[k];
    if (drifts) scaled -= rotation.dt[k] * drift_rate(theta, rotation.f_c[k]);
    scaled = scaled.cwiseProduct(scale);
    const Vec3 increment = C_inverse * scaled;
    visit(R, C_inverse, rotation.dt[k], increment, scaled, rotation.f_c[k]);
    R = R * drift::rotation(increment);
  }
  return R;
}

template <int N>
Eigen::Matrix<double, 1, N> factors(double dt, const Vec3& increment, const Vec3& scaled,
                                    const Vec3& f) {
  Eigen::Matrix<double, 1, N> q;
  q.template segment<3>(of_rate) = increment;
  q.template segment<3>(of_scaled) = scaled;
  if constexpr (N > num_turning_factors) {
    q[of_one] = dt;
    q.template segment<3>(of_force) = dt * f;
    q.template segment<3>(of_square) = dt * f.cwiseAbs2();
    q.template segment<3>(of_square + 3) = dt * Vec3(f[0] * f[1], f[1] * f[2], f[2] * f[0]);
  }
  return q;
}

template <int N>
Prediction predict(const Rotation& rotation, Coupling equation, const Theta& theta,
                   const std::vector<Lever>& levers) {
  // A change dw of the rate turns the end of the path by psi = integral of R dw dt, axes of the
  // start. `swept` holds that integral for dw = C^-1 e_i times each factor.
  std::array<Eigen::Matrix<double, 3, N>, 3> swept;
  for (auto& s : swept) s.setZero();
  const Mat3 R = integrate(rotation, equation, theta,
                           [&](const Mat3& R_start, const Mat3& C_inverse, double dt,
                               const Vec3& increment, const Vec3& scaled, const Vec3& f) {
                             const Mat3 directions =
                                 R_start * (C_inverse + 0.5 * skew(increment) * C_inverse);
                             const auto q = factors<N>(dt, increment, scaled, f);
                             for (int i = 0; i < 3; ++i)
                               swept[i].noalias() += directions.col(i) * q;
                           });
  Prediction result{R.transpose() * rotation.up_before,
                    MatX(3, static_cast<Eigen::Index>(levers.size()))};
  const Mat3 turned = R.transpose() * skew(rotation.up_before);
  for (std::size_t p = 0; p < levers.size(); ++p)
    result.jacobian.col(static_cast<Eigen::Index>(p)) =
        -levers[p].weight * turned * swept[levers[p].axis].col(levers[p].factor);
  return result;
}

}  // namespace

Rotations find_rotations(const Signals& signals, std::span<const Dwell> dwells) {
  Rotations found;
  for (std::size_t d = 0; d + 1 < dwells.size(); ++d) {
    const std::size_t first = dwells[d].last, last = dwells[d + 1].first;
    if (!usable(signals, first, last)) {
      ++found.omitted;
      continue;
    }
    Rotation turn;
    turn.before = d;
    turn.after = d + 1;
    for (std::size_t k = first + 1; k <= last; ++k) {
      const double dt = signals.time[k] - signals.time[k - 1];
      const Vec3 &a = signals.gyro[k - 1], &b = signals.gyro[k];
      turn.dt.push_back(dt);
      turn.theta_g.push_back(0.5 * dt * (a + b) + dt * dt / 12.0 * a.cross(b));
      turn.f_c.push_back(0.5 * (signals.acc[k - 1] + signals.acc[k]));
    }
    turn.up_before = dwells[d].acc.normalized();
    turn.up_after = dwells[d + 1].acc.normalized();
    found.all.push_back(std::move(turn));
  }
  return found;
}

Rotation calibrated(const Rotation& raw, std::span<const Dwell> dwells,
                    const SpecificForce& force) {
  Rotation turn = raw;
  for (Vec3& f : turn.f_c) f = force(f);
  turn.up_before = force(dwells[raw.before].acc).normalized();
  turn.up_after = force(dwells[raw.after].acc).normalized();
  return turn;
}

Rotation without_drift(Rotation rotation, const Theta& theta) {
  for (std::size_t k = 0; k < rotation.dt.size(); ++k)
    rotation.theta_g[k] -= rotation.dt[k] * drift_rate(theta, rotation.f_c[k]);
  return rotation;
}

Prediction predict(const Rotation& rotation, Coupling equation, const Theta& theta,
                   std::span<const std::size_t> params) {
  const Vec3 s = vec3(theta.data() + TermLibrary::index("s_x"));
  std::vector<Lever> levers;
  bool drifting = false;
  for (const std::size_t p : params) {
    levers.push_back(lever_of(p, s, equation));
    drifting = drifting || levers.back().factor >= num_turning_factors;
  }
  return drifting ? predict<num_factors>(rotation, equation, theta, levers)
                  : predict<num_turning_factors>(rotation, equation, theta, levers);
}

double prediction_error(const Rotation& rotation, Coupling equation, const Theta& theta) {
  const Mat3 R = integrate(rotation, equation, theta, [](const auto&...) {});
  const Vec3 up = R.transpose() * rotation.up_before;
  return std::atan2(up.cross(rotation.up_after).norm(), up.dot(rotation.up_after));
}

}  // namespace drift::strapdown
