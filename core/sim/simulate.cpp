#include "core/sim/simulate.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/physics/stochastic.hpp"
#include "core/plan/stretches_and_chains.hpp"
#include "core/sim/held_noise.hpp"
#include "core/sim/instruments.hpp"
#include "core/sim/own_terms_drawn.hpp"
#include "core/sim/platform_ode.hpp"

namespace drift {
namespace {

constexpr auto fixed_drift = TermLibrary::index("D_F_x");

}  // namespace

struct Simulator::Engine {
  PlatformOde ode;
};

/// Intervals first..(return value) are one segment: nothing that drives the platform changes.
std::size_t Simulator::segment_end(const Timeline& timeline, std::size_t first, std::size_t end,
                                   bool noisy) const {
  const Interval& a = timeline.intervals[first];
  const double longest = own_steps_.longest(timeline, first);
  std::size_t k = first + 1;
  while (!noisy && k < end) {
    const Interval& b = timeline.intervals[k];
    const bool same = !b.cage && b.omega_cmd_p == a.omega_cmd_p && b.loop == a.loop &&
                      std::abs(b.heading_rate() - a.heading_rate()) < 1e-15 &&
                      std::abs(own_steps_.longest(timeline, k) - longest) <= 1e-9 * longest;
    if (!same) break;
    ++k;
  }
  return k;
}

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
      engine_(
          new Engine{PlatformOde(with_random_drift(truth.noise, model_), truth.servo, options)}),
      own_steps_(truth) {}

Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&&) noexcept = default;

Simulation Simulator::run(const Timeline& timeline, std::uint64_t seed, std::uint64_t run_number) {
  return run(timeline, draw_truth(truth_, timeline.chains, seed, run_number), seed, run_number);
}

Simulation Simulator::run(const Timeline& timeline, const TruthDraw& draw, std::uint64_t seed,
                          std::uint64_t run_number) {
  Simulation out;
  run(timeline, draw, seed, run_number, out);
  return out;
}

void Simulator::run(const Timeline& timeline, const TruthDraw& draw, std::uint64_t seed,
                    std::uint64_t run_number, Simulation& out) {
  begin(timeline, draw, seed, run_number, out);
  extend(timeline, 0, timeline.intervals.size(), out);
}

void Simulator::begin(const Timeline& timeline, const TruthDraw& draw, std::uint64_t seed,
                      std::uint64_t run_number, Simulation& out) {
  for (std::uint32_t c = 0; c < 6; ++c) {
    sensor_noise_[c].emplace(seed, run_number, Purpose::sensor_noise, c);
    process_noise_[c].emplace(seed, run_number, Purpose::process_noise, c);
  }
  for (std::uint32_t c = 0; c < 3; ++c) {
    drift_level_[c].emplace(seed, run_number, Purpose::drift_level, c);
    between_ends_[c].emplace(seed, run_number, Purpose::process_noise, 6 + c);
  }
  for (std::uint32_t c = 0; c < 6; ++c)
    wrong_samples_[c].emplace(seed, run_number, Purpose::wrong_samples, c);
  require_covariates(model_, timeline);
  own_steps_.of_run(timeline, draw.theta);
  memory_ = MemoryRecord(timeline, model_);
  memory_.trace(draw.theta.data());
  const auto n = static_cast<Eigen::Index>(timeline.intervals.size());
  const double missing = std::numeric_limits<double>::quiet_NaN();
  out.ode = {};
  out.cost = {};
  out.draw = draw;
  out.phi.assign(timeline.nodes.size(), Vec3::Zero());
  out.measured.acc.setConstant(3, n, missing);
  out.measured.gimbal.setConstant(3, n, missing);
  theta_ = out.theta_end = draw.theta;
}

void Simulator::extend(const Timeline& timeline, std::size_t first, std::size_t end,
                       Simulation& out) {
  integrate(timeline, first, end, out);
  if (!out.ode.ok()) return;
  for (std::size_t i = first; i < end; ++i) measure(timeline, i, out);
  judge_samples(timeline, first, end, out);
}

/// To estimators a sample that is no number is one that was not taken: a test with fewer of them,
/// and nobody would know.
void Simulator::judge_samples(const Timeline& timeline, std::size_t first, std::size_t end,
                              Simulation& out) {
  const auto bad = nonfinite_sample(out.measured, readout_, first, end);
  if (!bad) return;
  TermMask reading;
  for (std::size_t t = 0; t < TermLibrary::num_terms; ++t)
    reading[t] =
        bad->of_accelerometer ? TermLibrary::terms[t].in_readout : TermLibrary::terms[t].in_gimbals;
  const double t = timeline.intervals[bad->interval].t1;
  out.ode = {OdeStatus::sample_nonfinite, t,
             fmt::format("{} is no finite number at t = {:.9g} s", bad->channel, t)};
  if (const std::string own = own_terms_drawn(model_.terms & reading, out.draw.theta); !own.empty())
    out.ode.cause += ", with " + own;
}

/// All parameters as they are in interval i: the drift's random walk goes on, its level may flip.
/// In every recording the walk begins at the D_F that was drawn, on a level of its own.
Theta Simulator::drift_of(const Timeline& timeline, std::size_t i, const Theta& drawn) {
  const double T = time_since_before(timeline, i);
  const bool begins = timeline.intervals[i].begins;
  if (begins) theta_.segment<3>(fixed_drift) = drawn.segment<3>(fixed_drift);
  for (int a = 0; a < 3; ++a)
    theta_[fixed_drift + a] += drift_walk(truth_.noise, model_.terms, theta_, a) * std::sqrt(T) *
                               process_noise_[3 + a]->normal();
  Theta now = theta_;
  if (!is_bistable(model_.terms)) return now;
  for (int a = 0; a < 3; ++a) {
    if (begins) level_[a] = drift_level_[a]->uniform() < 0.5 ? -1.0 : 1.0;
    if (drift_level_[a]->uniform() < flip_probability(theta_, T)) level_[a] = -level_[a];
    now[fixed_drift + a] += level_[a] * bistable_size(theta_, a);
  }
  return now;
}

void Simulator::integrate(const Timeline& timeline, std::size_t first, std::size_t end,
                          Simulation& out) {
  const ProcessNoise& noise = truth_.noise;
  const bool noisy = noise.any() || drift_varies(noise, model_.terms) || disturbance_.cols() > 0;
  PlatformOde& ode = engine_->ode;
  while (first < end && out.ode.ok()) {
    const std::size_t last = segment_end(timeline, first, end, noisy);
    const Interval& interval = timeline.intervals[first];
    Vec3 omega_noise_p = Vec3::Zero();
    Theta theta = theta_;
    if (noisy) {
      // White rate noise of density q^2 has variance q^2/T as a mean over T.
      for (int a = 0; a < 3; ++a)
        omega_noise_p[a] =
            noise.angle_random_walk / std::sqrt(interval.length()) * process_noise_[a]->normal();
      theta = drift_of(timeline, first, out.draw.theta);
    }
    out.theta_end = theta;
    ode.limit_steps(own_steps_.longest(timeline, first));
    if (disturbance_.cols() > 0)
      omega_noise_p += disturbance_.col(static_cast<Eigen::Index>(first));
    out.ode =
        ode.segment(timeline, first, last, theta, omega_noise_p,
                    interval.cage ? &out.draw.psi0_l[interval.chain] : nullptr, out.phi, &memory_);
    const OdeStats stats = ode.stats();
    out.cost.steps += stats.steps;
    out.cost.rhs_calls += stats.rhs_calls;
    out.cost.jacobian_calls += stats.jacobian_calls;
    first = last;
  }
  if (out.ode.ok()) return;
  // What grows without bounds is mostly a term of the study's own.
  if (const std::string own = own_terms_drawn(model_.terms, out.draw.theta); !own.empty())
    out.ode.cause += ", with " + own;
}

/// What makes a sample wrong, in units of its noise; nearly always nothing.
double Simulator::wrong_by(std::size_t channel, const Theta& theta) {
  if (!has_outliers(model_.terms)) return 0.0;
  Stream& stream = *wrong_samples_[channel];
  const bool wrong = stream.uniform() < outlier_rate(theta);
  const double size = stream.normal();
  return wrong ? outlier_size(theta) * size : 0.0;
}

/// The attitude at the nodes of interval i with what white noise of the gyros does between its ends
/// (HeldNoise): `phi` where there is none.
const Vec3* Simulator::turned_between(const Timeline& timeline, std::size_t i, const Vec3* phi) {
  const double walk = truth_.noise.angle_random_walk;
  const Interval& interval = timeline.intervals[i];
  if (walk == 0.0 || interval.rest) return phi;
  Vec3 b;
  for (int a = 0; a < 3; ++a)
    b[a] = walk / std::sqrt(interval.length()) * between_ends_[a]->normal();
  phi_between_.assign(phi, phi + interval.node_count());
  turn_between_ends(interval, timeline, b, phi_between_.data());
  return phi_between_.data();
}

void Simulator::measure(const Timeline& timeline, std::size_t i, Simulation& out) {
  const Interval& interval = timeline.intervals[i];
  const Instruments instruments{&timeline, &model_, out.draw.theta.data()};
  const MemoryPoint* points = memory_.points(interval);
  const auto memory = [&](std::size_t k) { return points ? points[2 * k].value.data() : nullptr; };
  const Vec3* phi = &out.phi[interval.first_node];
  if (readout_.accelerometers) {
    const Vec3 mean =
        instruments.accelerometers(interval, turned_between(timeline, i, phi), memory);
    for (int a = 0; a < 3; ++a)
      out.measured.acc(a, i) =
          mean[a] + interval.accelerometer_noise(readout_.accelerometer_noise) *
                        (sensor_noise_[a]->normal() + wrong_by(a, out.draw.theta));
  }
  if (readout_.gimbals) {
    const Vec3 angles = instruments.gimbals(interval, phi, memory);
    for (int a = 0; a < 3; ++a)
      out.measured.gimbal(a, i) = angle_difference(
          angles[a] + interval.gimbal_noise(readout_.gimbal_noise) *
                          (sensor_noise_[3 + a]->normal() + wrong_by(3 + a, out.draw.theta)),
          0.0);
  }
}

void set_loop(Timeline& timeline, const TruthSpec& truth) {
  if (truth.coupling != Coupling::compensated || truth.loop != LoopEstimate::given) return;
  constexpr auto eta = TermLibrary::index("eta_x");
  for (Interval& i : timeline.intervals) i.loop = truth.theta_loop.segment<6>(eta);
  timeline.loop_told = true;
}

}  // namespace drift
