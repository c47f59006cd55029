// Memory that changes within a step, where it drives the platform.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/estimate/linearize.hpp"
#include "core/estimate/stretch_jacobians.hpp"
#include "core/sim/instruments.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::memory_means_test {
namespace {

using namespace drift::test;

constexpr double row = 180.0, P = 0.03 * detail::deg / 3600.0;
constexpr double turn = 40.0 * detail::deg / 3600.0;

/// A test with rows of three minutes, the platform's x along the Earth's axis: with no command the
/// case turns about it with the Earth, which is a turn of one gimbal alone; twice the Earth's rate
/// turns it the other way as fast.
Timeline rows_about_the_axis(double latitude, const char* axes,
                             std::initializer_list<double> commands_in_earth_rates) {
  Timeline timeline;
  timeline.site = Site{latitude};
  timeline.chains = timeline.positions = 1;
  double t = 0.0;
  for (const double command : commands_in_earth_rates) {
    Interval i;
    i.t0 = t;
    i.t1 = t += row;
    i.cage = i.t0 == 0.0;
    i.omega_cmd_p = Vec3(command * detail::earth_rate, 0.0, 0.0);
    timeline.intervals.push_back(i);
  }
  std::string why;
  place_nodes(timeline, {parse_axes(axes, why).value()});
  return timeline;
}
/// At a pole, x up: the middle gimbal turns.
Timeline rows_at_a_pole(std::initializer_list<double> commands_in_earth_rates) {
  return rows_about_the_axis(90.0 * detail::deg, "x=U y=N z=W", commands_in_earth_rates);
}

struct Restrained {
  FilterSpec filter;
  Theta theta = Theta::Zero();
  Layout layout;
  Restrained() {
    filter.coupling = Coupling::eq6;
    filter.active = TermLibrary::completed(only({"P_middle", "P_turn"}));
    for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
      if (filter.active[i]) theta[i] = TermLibrary::specs[i].prior_si().mean();
    for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
      filter.priors[i] = TermLibrary::specs[i].prior_si();
    filter.priors[param("P_turn")] = normal(turn, 0.2 * turn);
    theta[param("P_middle")] = P;
    theta[param("P_turn")] = turn;
    layout = make_layout(filter);
  }
  Eigen::Index column(std::string_view key) const {
    const auto at = std::ranges::find(layout.params, param(key)) - layout.params.begin();
    return static_cast<Eigen::Index>(at);
  }
};

/// Integral of the friction over a row in which the gimbal turns by x at an even rate, and the
/// friction at its end; derivatives by the turn over which it builds up, in d.
struct Row {
  Dual<1> integral, end;
};
Row integral_of_row(const Dual<1>& begin, double x) {
  Dual<1> x_d(turn);
  x_d.d[0] = 1.0;
  const double sign = x > 0.0 ? 1.0 : -1.0;
  const Dual<1> end = sign + (begin - sign) * exp(-std::abs(x) / x_d);
  // dT/dx = (sign - T) / x_d, integrated over the row.
  return {row * (sign - sign * x_d * (end - begin) / x), end};
}

TEST(MemoryMeans, AReversalOfSecondsIsIntegratedExactlyInStepsOfMinutes) {
  // Friction is over in 40 arcsec / 15 arcsec/s; the steps are of 90 s. Free, stopped, reversed.
  const Timeline timeline = rows_at_a_pole({0.0, 1.0, 2.0, 2.0, 0.0});
  const Restrained m;
  const DriftModel model = m.filter.model();
  const Trajectory phi = integrate_fixed(timeline, model, m.theta, {Vec3::Zero()});
  Linearizer linearizer(model, m.layout, {});
  linearizer.set_theta(m.theta);
  MemoryRecord memory(timeline, model);
  memory.trace(m.theta.data());
  StretchJacobians together(timeline, model);
  together.evaluate(0, timeline.intervals.size(), phi.data(), linearizer, &memory);
  const double sigma = m.layout.sigma[m.column("P_middle")],
               sigma_turn = m.layout.sigma[m.column("P_turn")];
  const double x = detail::earth_rate * row;
  const std::array turned{-x, 0.0, x, x, -x};
  Dual<1> T(0.0);
  double angle = 0.0, facing = 0.0;  // of the gimbal's axis along x
  IntervalSensitivity alone, shared;
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    SCOPED_TRACE(i);
    const Interval& interval = timeline.intervals[i];
    Row now{row * T, T};
    if (turned[i] != 0.0) now = integral_of_row(T, turned[i]);
    T = now.end;
    const double change = phi[interval.last_node()].x() - phi[interval.first_node].x();
    if (i == 0) facing = change * now.integral.v < 0.0 ? 1.0 : -1.0;
    angle += -facing * P * now.integral.v;
    // What the nominal path is turned by beside it, 1e-4 of a radian, comes back to second order.
    EXPECT_NEAR(phi[interval.last_node()].x(), angle, 1e-9 * row * P);
    EXPECT_LT(phi[interval.last_node()].tail<2>().norm(), 1e-9 * row * P);
    linearize_interval(interval, timeline, Mat3::Zero(), &phi[interval.first_node],
                       memory.points(interval), linearizer, alone);
    propagate_sensitivity(interval, timeline, together.of(i), shared);
    for (const IntervalSensitivity* s : {&alone, &shared}) {
      const Rows3& G = s->G[interval.node_count() - 1];
      EXPECT_NEAR(G.col(m.column("P_middle")).norm(), std::abs(sigma * now.integral.v),
                  1e-9 * sigma * row);
      EXPECT_NEAR(G.col(m.column("P_turn")).norm(), std::abs(sigma_turn * P * now.integral.d[0]),
                  1e-9 * sigma_turn * P * row / turn);
    }
  }
}

TEST(MemoryMeans, AccelerometersReadAHangOffThatChangesSidesWithinARowAsItWas) {
  // At the equator, x north: the outer gimbal turns, and the platform hangs off about it.
  const Timeline timeline = rows_about_the_axis(0.0, "x=N y=W z=U", {0.0, 1.0, 2.0, 2.0, 0.0});
  constexpr double F = 10.0 * arcsec;
  FilterSpec filter;
  filter.coupling = Coupling::eq6;
  filter.active = TermLibrary::completed(only({"F_outer", "F_turn"}));
  Theta theta = Theta::Zero();
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i) {
    filter.priors[i] = TermLibrary::specs[i].prior_si();
    if (filter.active[i]) theta[i] = filter.priors[i].mean();
  }
  theta[param("F_turn")] = turn;
  Theta hung = theta;
  hung[param("F_outer")] = F;
  const DriftModel model = filter.model();
  const std::vector<Vec3> phi(timeline.nodes.size(), Vec3::Zero());  // no gyro integrates it
  MemoryRecord memory(timeline, model);
  memory.trace(hung.data());
  Linearizer linearizer(model, make_layout(filter), {});
  linearizer.set_theta(hung);
  const double x = detail::earth_rate * row;
  const std::array turned{-x, 0.0, x, x, -x};
  Dual<1> T(0.0);
  IntervalSensitivity sensitivity;
  MeanOutput mean;
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    SCOPED_TRACE(i);
    const Interval& interval = timeline.intervals[i];
    const auto points = [&](std::size_t k) { return memory.points(interval)[2 * k].value.data(); };
    const auto read = [&](const Theta& with) {
      return Instruments{&timeline, &model, with.data()}.accelerometers(
          interval, &phi[interval.first_node], points);
    };
    Row now{row * T, T};
    if (turned[i] != 0.0) now = integral_of_row(T, turned[i]);
    T = now.end;
    const Vec3 simulated = read(hung);
    // The row sees gravity turn by 1.3 % of its length at most, beside what changes in seconds.
    EXPECT_NEAR((simulated - read(theta)).norm(), F * std::abs(now.integral.v) / row, 0.005 * F);
    linearize_interval(interval, timeline, Mat3::Zero(), &phi[interval.first_node],
                       memory.points(interval), linearizer, sensitivity);
    mean_output(interval, sensitivity, mean);
    EXPECT_LT((mean.acc - simulated).norm(), 1e-12);
    // What the gimbals show at the end of the row is of the friction there.
    const std::size_t last = interval.node_count() - 1;
    const int outer = TermLibrary::terms[TermLibrary::find_term("stiction").value()].first_memory;
    EXPECT_NEAR(points(last)[outer], T.v, 1e-9);
  }
}

void expect_moments(const Moments<double>& found, const Moments<double>& expected, double within) {
  for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(found[j], expected[j], within) << j;
}

TEST(MemoryMoments, OfFrictionAreThoseOfItsParts) {
  const double begin = -0.7, x_d = 4e-5;
  // Of an even rate, and of one that comes to rest and reverses: x = 1 - (1 - 2 s)^2, in fours.
  const double a = 3e-5, b = 5e-5, middle = dahl(begin, a, x_d);
  expect_moments(
      joined(a / (a + b), dahl_moments(begin, a, x_d, 1.0), dahl_moments(middle, b, x_d, 1.0)),
      dahl_moments(begin, a + b, x_d, 1.0), 1e-14);
  const double quarter = 0.75 * a;
  expect_moments(joined(0.5, dahl_moments(begin, quarter, x_d, 4.0 / 3.0),
                        dahl_moments(dahl(begin, quarter, x_d), a - quarter, x_d, 2.0)),
                 dahl_moments(begin, a, x_d, 2.0), 1e-14);
}

TEST(MemoryMoments, OfFrictionAreItsIntegrals) {
  const double begin = -0.7, x_d = 4e-5;
  constexpr int parts = 20000;
  // Turns of a millionth to a hundred times what it takes to change sides.
  for (const double turned : {4e-11, -1e-6, 3e-5, -2e-4, 9.59e-4, 9.61e-4, 4e-3})
    for (const double rate : {0.0, 0.6, 1.0, 1.7, 2.0}) {
      SCOPED_TRACE(fmt::format("{} at {}", turned, rate));
      Moments<double> sum{};
      for (int k = 0; k < parts; ++k) {
        const double s = (k + 0.5) / parts;
        const double now = dahl(begin, turned * s * (rate + (1.0 - rate) * s), x_d) / parts;
        for (std::size_t j = 0; j < 3; ++j) sum[j] += now * std::pow(s, static_cast<double>(j));
      }
      // The midpoint rule leaves a 24th of the change of the slope: 200 / parts^2.
      expect_moments(dahl_moments(begin, turned, x_d, rate), sum, 1e-7);
    }
  // What rounding turns a gimbal by, and nothing.
  expect_moments(dahl_moments(begin, 1e-22, x_d, 2.0), {begin, begin / 2.0, begin / 3.0}, 1e-15);
  expect_moments(dahl_moments(begin, 0.0, x_d, 1.0), {begin, begin / 2.0, begin / 3.0}, 1e-16);
}

TEST(MemoryMoments, HaveTheDerivativeToTheTurn) {
  constexpr double x_d = 4e-5, h = 1e-4 * x_d;
  for (const double turned : {1e-12, 3e-5, -1.5e-3})
    for (const double rate : {0.0, 1.0, 2.0}) {
      const auto found = dahl_moments(Dual<1>(0.2), turned, Dual<1>::variable(x_d, 0), rate);
      const auto up = dahl_moments(0.2, turned, x_d + h, rate),
                 down = dahl_moments(0.2, turned, x_d - h, rate);
      for (std::size_t j = 0; j < 3; ++j)
        EXPECT_NEAR(found[j].d[0] * x_d, (up[j] - down[j]) / (2.0 * h) * x_d, 1e-7);
    }
}

TEST(MemoryMeans, InPlansStepsOfMinutesAreAsGoodAsFineOnes) {
  const Restrained m;
  const DriftModel model = m.filter.model();
  // Of a step of 0.1 rad a third power is left, 1e-3, of the seconds that a reversal takes: 1e-3
  // arcsec each at P of 0.03 arcsec/s at most, and some of the dozens of `casespin` add up.
  for (const auto& [preset, mode] : {std::pair{"slew12", CommandLaw::free},
                                     {"slew12", CommandLaw::level},
                                     {"casespin", CommandLaw::level}}) {
    SCOPED_TRACE(preset);
    const Timeline coarse = preset_timeline(preset, mode, 3600.0, row);
    Timeline fine = coarse;
    for (Interval& i : fine.intervals) i.substeps = std::max(i.substeps, 64);
    std::vector<Mat3> R_lp;
    for (const Interval& i : coarse.intervals)
      if (i.cage) R_lp.push_back(coarse.nodes[i.first_node].R_lr);
    place_nodes(fine, R_lp);
    const std::vector<Vec3> psi(R_lp.size(), Vec3::Zero());
    const Trajectory a = integrate_fixed(coarse, model, m.theta, psi),
                     b = integrate_fixed(fine, model, m.theta, psi);
    double worst = 0.0;
    for (std::size_t i = 0; i < coarse.intervals.size(); ++i)
      worst = std::max(
          worst, (a[coarse.intervals[i].last_node()] - b[fine.intervals[i].last_node()]).norm());
    EXPECT_LT(worst, 1e-3 * arcsec);
  }
}

}  // namespace
}  // namespace drift::memory_means_test
