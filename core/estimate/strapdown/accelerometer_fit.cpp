#include "core/estimate/strapdown/accelerometer_fit.hpp"

#include <Eigen/LU>
#include <cmath>

#include "core/estimate/strapdown/least_squares.hpp"

namespace drift::strapdown {
namespace {

constexpr std::size_t first_parameter = TermLibrary::index("K0_x");

Vec3 output_of(const Mounting& mounting, const Theta& theta, const Vec3& f) {
  const Inputs<double> in{&mounting, f, Vec3::Zero(), Vec3::Zero()};
  ReadoutAssembly<double> out{f};
  terms::Accelerometer::readout(in, theta.data() + first_parameter, out);
  return out.acc;
}

}  // namespace

std::vector<std::size_t> parameters_of(AccelerometerModel model) {
  std::vector<std::size_t> all;
  if (model >= AccelerometerModel::bias_scale)
    for (const char* key : {"K0_x", "K0_y", "K0_z", "K1_x", "K1_y", "K1_z"})
      all.push_back(*TermLibrary::find(key));
  if (model >= AccelerometerModel::misaligned)
    for (const char* key : {"dO_y", "dP_z", "dO_z"}) all.push_back(*TermLibrary::find(key));
  if (model >= AccelerometerModel::quadratic)
    for (const char* key : {"K2_x", "K2_y", "K2_z"}) all.push_back(*TermLibrary::find(key));
  return all;
}

SpecificForce::SpecificForce(const Theta& theta) : theta_(theta) {
  Theta linear = theta;
  linear_ = true;
  for (const std::size_t first :
       {TermLibrary::index("K2_x"), TermLibrary::index("K3_x"), TermLibrary::index("K_ip_x")})
    for (std::size_t i = first; i < first + 3; ++i) {
      linear_ = linear_ && theta[i] == 0.0;
      linear[i] = 0.0;
    }
  const Vec3 offset = output_of(mounting_, linear, Vec3::Zero());
  Mat3 forward;
  for (int i = 0; i < 3; ++i) forward.col(i) = output_of(mounting_, linear, Vec3::Unit(i)) - offset;
  inverse_ = forward.inverse();
}

Vec3 SpecificForce::operator()(const Vec3& output) const {
  Vec3 f = inverse_ * (output - output_of(mounting_, theta_, Vec3::Zero()));
  if (linear_) return f;
  for (int i = 0; i < 20; ++i) {
    const Vec3 step = inverse_ * (output - output_of(mounting_, theta_, f));
    f += step;
    if (step.squaredNorm() < 1e-28) break;
  }
  return f;
}

Estimate fit_accelerometers(AccelerometerModel model, std::span<const Vec3> outputs) {
  Estimate fit;
  fit.params = parameters_of(model);
  const auto n = static_cast<Eigen::Index>(outputs.size());
  const auto p = static_cast<Eigen::Index>(fit.params.size());
  const auto scatter = [&](const VecX& x) {
    Theta theta = Theta::Zero();
    for (Eigen::Index i = 0; i < p; ++i) theta[fit.params[i]] = x[i];
    return theta;
  };
  const auto errors = [&](const VecX& x) {
    const SpecificForce force(scatter(x));
    VecX r(n);
    for (Eigen::Index k = 0; k < n; ++k) r[k] = force(outputs[k]).norm() - 1.0;
    return r;
  };
  const Residuals residuals = [&](const VecX& x, MatX* jacobian) {
    if (jacobian != nullptr) {
      jacobian->resize(n, p);
      for (Eigen::Index i = 0; i < p; ++i) {
        constexpr double h = 1e-5;  // central: error h^2 times third derivatives of order one
        VecX up = x, down = x;
        up[i] += h;
        down[i] -= h;
        jacobian->col(i) = (errors(up) - errors(down)) / (2.0 * h);
      }
    }
    return errors(x);
  };
  const Minimum best = minimise(residuals, VecX::Zero(p));
  fit.theta = scatter(best.x);
  fit.covariance = best.covariance(static_cast<double>(n - p));
  fit.rms = std::sqrt(best.residuals.squaredNorm() / static_cast<double>(n));
  fit.converged = best.converged;
  return fit;
}

}  // namespace drift::strapdown
