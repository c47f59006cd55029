// What follows a gimbal's angle while the case turns.
#include <gtest/gtest.h>

#include "core/estimate/linearize.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::turning_case_test {
namespace {

using namespace drift::test;

TEST(TurningCase, DriftByAGimbalAngleIsIntegratedOverTheTurnWithinARow) {
  // At a pole, z up and held there: the inner gimbal turns as the case does, 500 deg in one row,
  // and w_ip,z = -G cos(angle).
  constexpr double rate = 1.0 * detail::deg, row = 500.0, G = 0.01 * deg_per_h;
  Timeline timeline;
  timeline.site = Site{90.0 * detail::deg};
  timeline.chains = timeline.positions = 1;
  Interval i;
  i.t1 = row;
  i.cage = true;
  i.heading1 = rate * row;
  i.omega_cmd_p = Vec3(0.0, 0.0, detail::earth_rate);
  timeline.intervals.push_back(i);
  std::string why;
  place_nodes(timeline, {parse_axes("x=N y=W z=U", why).value()});

  FilterSpec filter;
  filter.coupling = Coupling::eq6;
  filter.active = TermLibrary::completed(only({"G_c_z", "G_gimbal"}));
  for (std::size_t k = 0; k < TermLibrary::num_params; ++k)
    filter.priors[k] = TermLibrary::specs[k].prior_si();
  Theta theta = Theta::Zero();
  for (std::size_t k = 0; k < TermLibrary::num_params; ++k)
    if (filter.active[k]) theta[k] = TermLibrary::specs[k].prior_si().mean();
  theta[param("G_c_z")] = G;
  const DriftModel model = filter.model();
  const Trajectory phi = integrate_fixed(timeline, model, theta, {Vec3::Zero()});
  const double integral = std::sin(rate * row) / rate;
  // Simpson's rule over steps of 0.25 rad: 0.25^4 / 180 of it.
  const double error = 2.2e-5 / rate;
  EXPECT_NEAR(phi.back().z(), -G * integral, G * error);

  const Layout layout = make_layout(filter);
  Linearizer linearizer(model, layout, {});
  linearizer.set_theta(theta);
  IntervalSensitivity sensitivity;
  linearize_interval(timeline.intervals[0], timeline, Mat3::Zero(), phi.data(), nullptr, linearizer,
                     sensitivity);
  const auto at = std::ranges::find(layout.params, param("G_c_z")) - layout.params.begin();
  const double sigma = layout.sigma[at];
  EXPECT_NEAR(sensitivity.G[phi.size() - 1].col(at).norm(), std::abs(sigma * integral),
              sigma * error);
}

}  // namespace
}  // namespace drift::turning_case_test
