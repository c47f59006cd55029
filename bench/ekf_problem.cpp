#include "bench/ekf_problem.hpp"

#include <cmath>

#include "core/estimate/linearize.hpp"
#include "core/physics/parameters_config.hpp"
#include "core/sim/simulate.hpp"

namespace drift::bench {
namespace {

constexpr double arw = 1e-3 * detail::deg / 60.0;  // [rad/sqrt(s)]

FilterSpec all_terms() {
  FilterSpec filter;
  filter.name = "bench";
  filter.active = base_parameters();
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    filter.priors[i] = TermLibrary::specs[i].prior_si();
  filter.noise.angle_random_walk = arw;
  return filter;
}

Timeline six_free(double sample) {
  PlanDefaults defaults;
  defaults.mode = CommandLaw::free;
  defaults.dwell = 3600.0;
  defaults.sample = sample;
  return lay_out(preset_plan("six", defaults).value(), Site{45.75 * detail::deg});
}

}  // namespace

Problem make_problem(double sample) {
  Problem p;
  p.filter = all_terms();
  p.layout = make_layout(p.filter);
  p.timeline = six_free(sample);
  const DriftModel model = p.filter.model();
  const Theta theta = draw_parameters(p.filter, 1, 0, Purpose::test);
  const Trajectory phi =
      integrate_fixed(p.timeline, model, theta, std::vector<Vec3>(p.timeline.chains, Vec3::Zero()));
  Linearizer linearizer(model, p.layout, p.readout);
  linearizer.set_theta(theta);
  IntervalSensitivity s;
  for (std::size_t i = 0; i < p.timeline.intervals.size(); ++i) {
    const Interval& interval = p.timeline.intervals[i];
    linearize_interval(interval, p.timeline, Mat3::Zero(), &phi[interval.first_node], nullptr,
                       linearizer, s);
    const auto m = static_cast<std::size_t>(interval.substeps);
    const std::size_t last = interval.node_count() - 1;
    Step step;
    step.cage = interval.cage;
    step.Phi_half = s.Phi[m];
    const auto nr = static_cast<Eigen::Index>(p.layout.num_rate);
    step.G_half = s.G[m].leftCols(nr);
    step.Phi_rest = s.Phi[last] * s.Phi[m].inverse();
    step.G_rest = s.G[last].leftCols(nr) - step.Phi_rest * step.G_half;
    step.H_acc = s.jacobian[m].H;
    step.H_par = s.jacobian[m].H_par.leftCols(static_cast<Eigen::Index>(p.layout.size()) - nr);
    step.H_gimbal = predict_gimbals(p.timeline.nodes[interval.last_node()], interval.heading1,
                                    phi[interval.last_node()])
                        .H;
    const double a = static_cast<double>(i);
    step.nu_acc = p.readout.accelerometer_noise * Vec3(std::sin(a), std::cos(a), std::sin(2.0 * a));
    step.nu_gimbal = p.readout.gimbal_noise * Vec3(std::cos(3.0 * a), std::sin(a), std::cos(a));
    p.steps.push_back(std::move(step));
  }
  return p;
}

}  // namespace drift::bench
