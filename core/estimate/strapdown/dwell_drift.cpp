#include "core/estimate/strapdown/dwell_drift.hpp"

#include <cmath>

#include "core/base/decompose.hpp"

namespace drift::strapdown {
namespace {

void append(std::vector<std::size_t>& all, std::vector<std::size_t> more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

std::vector<std::size_t> parameters_of(DriftOrder order) {
  std::vector<std::size_t> all = group<"D_F">();
  if (order >= DriftOrder::input_axis) append(all, group<"D_I">());
  if (order >= DriftOrder::g_sensitive) {
    append(all, group<"D_O">());
    append(all, group<"D_S">());
  }
  if (order >= DriftOrder::g2_sensitive) {
    append(all, group<"D_II">());
    append(all, group<"D_OO">());
    append(all, group<"D_IO">());
    append(all, group<"D_IS">());
    append(all, group<"D_OS">());
  }
  return all;
}

Vec3 drift_rate(const Theta& theta, const Vec3& f_c) {
  static const Mounting mounting;
  const Inputs<double> in{&mounting, f_c, Vec3::Zero(), Vec3::Zero()};
  RateAssembly<double> out;
  terms::FixedDrift::rates(in, theta.data() + TermLibrary::index("D_F_x"), out);
  terms::GDrift::rates(in, theta.data() + TermLibrary::index("D_I_x"), out);
  terms::G2Drift::rates(in, theta.data() + TermLibrary::index("D_II_x"), out);
  return out.omega_drift_g;
}

Estimate fit_drift(DriftOrder order, std::span<const Rest> rests) {
  Estimate fit;
  fit.params = parameters_of(order);
  const auto n = static_cast<Eigen::Index>(3 * rests.size());
  const auto p = static_cast<Eigen::Index>(fit.params.size());
  MatX design(n, p);
  VecX measured(n);
  for (std::size_t k = 0; k < rests.size(); ++k) {
    measured.segment<3>(static_cast<Eigen::Index>(3 * k)) = rests[k].omega_g;
    for (Eigen::Index i = 0; i < p; ++i) {
      Theta one = Theta::Zero();
      one[fit.params[i]] = 1.0;
      design.block<3, 1>(static_cast<Eigen::Index>(3 * k), i) = drift_rate(one, rests[k].f_c);
    }
  }
  const MatX normal = design.transpose() * design;
  const VecX x = solve_symmetric(normal, VecX(design.transpose() * measured));
  const double squares = (measured - design * x).squaredNorm();
  for (Eigen::Index i = 0; i < p; ++i) fit.theta[fit.params[i]] = x[i];
  fit.covariance = squares / std::max<double>(1.0, static_cast<double>(n - p)) *
                   solve_symmetric(normal, MatX(MatX::Identity(p, p)));
  fit.rms = std::sqrt(squares / static_cast<double>(n));
  return fit;
}

}  // namespace drift::strapdown
