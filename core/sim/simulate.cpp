#include "core/sim/simulate.hpp"

#include <cmath>
#include <limits>

#include "core/physics/gimbals.hpp"
#include "core/sim/platform_ode.hpp"

namespace drift {
namespace {

constexpr auto fixed_drift = TermLibrary::index("D_F_x");

/// Intervals first..(return value) are one segment: nothing that drives the platform changes.
std::size_t segment_end(const Timeline& timeline, std::size_t first, std::size_t end, bool noisy) {
  const Interval& a = timeline.intervals[first];
  std::size_t k = first + 1;
  while (!noisy && k < end) {
    const Interval& b = timeline.intervals[k];
    const bool same = !b.cage && b.omega_cmd_p == a.omega_cmd_p && b.loop == a.loop &&
                      std::abs(b.heading_rate() - a.heading_rate()) < 1e-15;
    if (!same) break;
    ++k;
  }
  return k;
}

}  // namespace

struct Simulator::Engine {
  PlatformOde ode;
};

OdeOptions Simulator::default_options(Coupling coupling) {
  OdeOptions options;
  options.rel_tol = coupling == Coupling::servo ? 1e-9 : 1e-10;
  options.abs_tol = 1e-13;
  options.wall_limit = coupling == Coupling::servo ? 120.0 : 20.0;
  return options;
}

Simulator::Simulator(const TruthSpec& truth, const Readout& readout)
    : Simulator(truth, readout, default_options(truth.coupling)) {}

Simulator::Simulator(const TruthSpec& truth, const Readout& readout, const OdeOptions& options)
    : truth_(truth),
      readout_(readout),
      model_(truth.model()),
      engine_(new Engine{PlatformOde(model_, truth.servo, options)}) {}

Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&&) noexcept = default;

Simulation Simulator::run(const Timeline& timeline, std::uint64_t seed, std::uint64_t run_number) {
  return run(timeline, draw_truth(truth_, timeline.chains, seed, run_number), seed, run_number);
}

Simulation Simulator::run(const Timeline& timeline, const TruthDraw& draw, std::uint64_t seed,
                          std::uint64_t run_number) {
  Simulation out;
  begin(timeline, draw, seed, run_number, out);
  extend(timeline, 0, timeline.intervals.size(), out);
  return out;
}

void Simulator::begin(const Timeline& timeline, const TruthDraw& draw, std::uint64_t seed,
                      std::uint64_t run_number, Simulation& out) {
  for (std::uint32_t c = 0; c < 6; ++c) {
    sensor_noise_[c] = std::make_unique<Stream>(seed, run_number, Purpose::sensor_noise, c);
    process_noise_[c] = std::make_unique<Stream>(seed, run_number, Purpose::process_noise, c);
  }
  const auto n = static_cast<Eigen::Index>(timeline.intervals.size());
  const double missing = std::numeric_limits<double>::quiet_NaN();
  out.ode = {};
  out.cost = {};
  out.draw = draw;
  out.phi.assign(timeline.nodes.size(), Vec3::Zero());
  out.measured = {Mat3X::Constant(3, n, missing), Mat3X::Constant(3, n, missing)};
  theta_ = out.theta_end = draw.theta;
}

void Simulator::extend(const Timeline& timeline, std::size_t first, std::size_t end, Simulation& out) {
  integrate(timeline, first, end, out);
  if (!out.ode.ok()) return;
  for (std::size_t i = first; i < end; ++i) measure(timeline, i, out);
}

void Simulator::integrate(const Timeline& timeline, std::size_t first, std::size_t end, Simulation& out) {
  const ProcessNoise& noise = truth_.noise;
  PlatformOde& ode = engine_->ode;
  while (first < end && out.ode.ok()) {
    const std::size_t last = segment_end(timeline, first, end, noise.any() || disturbance_.cols() > 0);
    const Interval& interval = timeline.intervals[first];
    Vec3 omega_noise_p = Vec3::Zero();
    if (noise.any()) {
      const double T = interval.length();
      for (int a = 0; a < 3; ++a) {
        // White rate noise of density q^2 has variance q^2/T as a mean over T.
        omega_noise_p[a] = noise.angle_random_walk / std::sqrt(T) * process_noise_[a]->normal();
        theta_[fixed_drift + a] += noise.drift_random_walk * std::sqrt(T) * process_noise_[3 + a]->normal();
      }
    }
    if (disturbance_.cols() > 0) omega_noise_p += disturbance_.col(static_cast<Eigen::Index>(first));
    out.ode = ode.segment(timeline, first, last, theta_, omega_noise_p,
                          interval.cage ? &out.draw.psi0_l[interval.chain] : nullptr, out.phi);
    const OdeStats stats = ode.stats();
    out.cost.steps += stats.steps;
    out.cost.rhs_calls += stats.rhs_calls;
    out.cost.jacobian_calls += stats.jacobian_calls;
    first = last;
  }
  out.theta_end = theta_;
}

void Simulator::measure(const Timeline& timeline, std::size_t i, Simulation& out) {
  const Interval& interval = timeline.intervals[i];
  if (readout_.accelerometers) {
    Vec3 mean = Vec3::Zero();
    for (std::size_t k = 0; k < interval.node_count(); ++k) {
      const Node& node = timeline.nodes[interval.first_node + k];
      const Mat3 R_lp = node.R_lr * rotation(out.phi[interval.first_node + k]);
      const auto in = inputs_at<double>(node.omega_ic_l, interval.omega_cmd_p, model_.mounting, R_lp);
      mean += Timeline::simpson_weight(interval.substeps, k) *
              accelerometer_output(model_, in, out.draw.theta.data());
    }
    for (int a = 0; a < 3; ++a)
      out.measured.acc(a, i) = mean[a] + readout_.accelerometer_noise * sensor_noise_[a]->normal();
  }
  if (readout_.gimbals) {
    const Node& node = timeline.nodes[interval.last_node()];
    const Mat3 R_lp = node.R_lr * rotation(out.phi[interval.last_node()]);
    const Vec3 angles =
        gimbal_angles<double>(case_attitude(interval.heading1).transpose() * R_lp);
    for (int a = 0; a < 3; ++a)
      out.measured.gimbal(a, i) = angle_difference(
          angles[a] + readout_.gimbal_noise * sensor_noise_[3 + a]->normal(), 0.0);
  }
}

void set_loop(Timeline& timeline, const TruthSpec& truth) {
  if (truth.coupling != Coupling::compensated || truth.loop != LoopEstimate::given) return;
  constexpr auto eta = TermLibrary::index("eta_x");
  for (Interval& i : timeline.intervals) i.loop = truth.theta_loop.segment<6>(eta);
}

}  // namespace drift
