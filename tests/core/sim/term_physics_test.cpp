// Closed forms of what single effects do to a test.
#include <gtest/gtest.h>

#include "core/physics/memory.hpp"
#include "core/sim/memory_path.hpp"
#include "tests/support/term_scenes.hpp"

namespace drift::term_physics_test {
namespace {

using namespace drift::test;

const double omega = detail::earth_rate;

/// One parameter, and what it does to the attitude in the first `intervals` intervals of a test
/// under eq. (6): rotation vector at their end, platform axes [rad].
struct Effect {
  ParamMask active;
  Theta theta = Theta::Zero();
  Effect(std::string_view key, double value) {
    active = TermLibrary::completed(only({key}));
    for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
      if (active[i]) theta[i] = TermLibrary::specs[i].prior_si().mean();
    theta[param(key)] = value;
  }
  DriftModel model() const { return {Coupling::eq6, TermLibrary::terms_of(active), {}}; }
  Measurements predicted(const Timeline& timeline, Trajectory* phi = nullptr) const {
    return predict(timeline, model(), theta, std::vector<Vec3>(timeline.chains, Vec3::Zero()), {},
                   phi);
  }
  Vec3 phi_after(const Timeline& timeline, std::size_t intervals) const {
    Trajectory phi;
    predicted(timeline, &phi);
    return phi[timeline.intervals[intervals - 1].last_node()];
  }
};

/// x up: position 1 of "six" held level for ten minutes. The commanded Earth rate turns what has
/// drifted about the vertical to the horizontal and back: (Omega cos(latitude) 600 s)^2 / 6
/// = 1.6e-4 of it.
constexpr double turned_away = 3e-4;
Timeline first_position() {
  return scene("six", CommandLaw::level);
}

TEST(MagneticDrift, IsSensitivityTimesFieldAlongTheInputAxis) {
  const Timeline timeline = first_position();
  const double M = 0.01 * deg_per_h / 1e-4;  // 0.01 deg/h/gauss
  // x is up, B_u = -0.48 gauss: w_ip = +0.0048 deg/h about x for 600 s. In level mode nothing else
  // turns.
  const Vec3 phi = Effect("M_x", M).phi_after(timeline, 10);
  EXPECT_NEAR(phi.x(), 0.01 * 0.48 * deg_per_h * 600.0, turned_away * std::abs(phi.x()));
  EXPECT_LT(std::hypot(phi.y(), phi.z()), std::abs(phi.x()) * omega * 600.0);
}

TEST(WarmupDrift, IntegratesToAnExponential) {
  const double W = 0.2 * deg_per_h, tau = 40.0 * 60.0;
  const Vec3 phi = Effect("W_x", W).phi_after(first_position(), 10);
  EXPECT_NEAR(phi.x(), -W * tau * (1.0 - std::exp(-600.0 / tau)), turned_away * W * 600.0);
}

TEST(DriftRamp, IntegratesToAParabola) {
  const double r = 0.01 * deg_per_h / 3600.0;
  EXPECT_NEAR(Effect("ramp_x", r).phi_after(first_position(), 10).x(), -0.5 * r * 600.0 * 600.0,
              turned_away * r * 3.6e5);
}

TEST(TemperatureDrift, FollowsTheRecordedTemperature) {
  const Timeline timeline = first_position();
  const double k = 0.03 * deg_per_h;
  double sum = 0.0;
  for (int i = 0; i < 10; ++i) {
    const Interval& n = timeline.intervals[i];
    sum += 0.5 * (n.around0[covariate("temperature")] + n.around1[covariate("temperature")]) *
           n.length();
  }
  EXPECT_GT(std::abs(sum), 30.0);  // degC s
  EXPECT_NEAR(Effect("kT_x", k).phi_after(timeline, 10).x(), -k * sum,
              turned_away * k * std::abs(sum));
}

/// Integrals over an interval of the first powers of a temperature that is linear in it.
double integral(const Interval& i, int power) {
  const double a = i.around0[covariate("temperature")], b = i.around1[covariate("temperature")];
  double sum = 0.0;
  for (int k = 0; k <= power; ++k) sum += std::pow(a, k) * std::pow(b, power - k);
  return sum * i.length() / (power + 1);
}

TEST(TemperatureDrift, OfHigherOrderIsItsIntegralAndByItsRateItsChange) {
  const Timeline timeline = first_position();
  for (const auto& [key, power] : {std::pair{"kT2_x", 2}, {"kT3_x", 3}}) {
    const double k = TermLibrary::specs[param(key)].prior_si().sigma();
    double sum = 0.0;
    for (int i = 0; i < 10; ++i) sum += integral(timeline.intervals[i], power);
    EXPECT_NEAR(Effect(key, k).phi_after(timeline, 10).x(), -k * sum,
                turned_away * k * std::abs(sum))
        << key;
  }
  const double k = TermLibrary::specs[param("kT_rate_x")].prior_si().sigma();
  const double change = timeline.intervals[9].around1[covariate("temperature")] -
                        timeline.intervals[0].around0[covariate("temperature")];
  EXPECT_GT(std::abs(change), 0.1);
  EXPECT_NEAR(Effect("kT_rate_x", k).phi_after(timeline, 10).x(), -k * change,
              turned_away * k * std::abs(change));
}

TEST(AccelerometerTemperature, OfHigherOrderAndByItsRateIsTheMeanOverARow) {
  const Timeline timeline = first_position();  // x reads 1 g
  const Interval& row = timeline.intervals[7];
  const double rate =
      (row.around1[covariate("temperature")] - row.around0[covariate("temperature")]) /
      row.length();
  const double without = Effect("K0_x", 0.0).predicted(timeline).acc(0, 7);
  for (const auto& [key, mean] : {std::pair{"K0_T2_x", integral(row, 2) / row.length()},
                                  {"K1_T2_x", integral(row, 2) / row.length()},
                                  {"K0_T3_x", integral(row, 3) / row.length()},
                                  {"K1_T3_x", integral(row, 3) / row.length()},
                                  {"K0_T_rate_x", rate}}) {
    const double k = TermLibrary::specs[param(key)].prior_si().sigma();
    EXPECT_NEAR(Effect(key, k).predicted(timeline).acc(0, 7) - without, k * mean,
                1e-15 + 1e-9 * k * std::abs(mean))
        << key;
  }
}

/// A slew by +90 deg about x and back.
Timeline there_and_back() {
  Timeline timeline;
  timeline.site = Site{90.0 * detail::deg};
  timeline.chains = timeline.positions = 1;
  for (int k = 0; k < 36; ++k) {
    Interval i;
    i.t0 = 10.0 * k;
    i.t1 = i.t0 + 10.0;
    i.cage = k == 0;
    i.slew = true;
    i.omega_cmd_p = Vec3(k < 18 ? 0.5 * detail::deg : -0.5 * detail::deg, 0.0, 0.0);
    timeline.intervals.push_back(i);
  }
  std::string why;
  place_nodes(timeline, {parse_axes("x=U y=N z=W", why).value()});
  return timeline;
}

TEST(TorquerAsymmetry, DoesNotCancelInASlewThereAndBack) {
  const Timeline timeline = there_and_back();
  const double s = 100e-6;
  EXPECT_NEAR(Effect("s_a_x", s).phi_after(timeline, 36).x(), s * 180.0 * detail::deg, 1e-9);
  EXPECT_NEAR(Effect("s_x", s).phi_after(timeline, 36).x(), 0.0, 1e-12);
  // At 0.5 deg/s the quadratic term is a scale factor error: it cancels too.
  EXPECT_NEAR(Effect("s_2_x", s).phi_after(timeline, 18).x(), s * 90.0 * detail::deg, 1e-9);
  EXPECT_NEAR(Effect("s_2_x", s).phi_after(timeline, 36).x(), 0.0, 1e-12);
}

TEST(TorquerTemperature, IsAScaleFactorErrorThatGrowsWithTheTemperature) {
  Timeline timeline = there_and_back();
  timeline.carried |= covariate("temperature").set();
  constexpr double warming = 0.02;  // [K/s]
  for (Interval& i : timeline.intervals) {
    i.around0[covariate("temperature")] = warming * i.t0;
    i.around1[covariate("temperature")] = warming * i.t1;
  }
  const double rate = 0.5 * detail::deg;
  for (const auto& [key, power] : {std::pair{"s_T_x", 1}, {"s_T2_x", 2}, {"s_T3_x", 3}}) {
    const double s = TermLibrary::specs[param(key)].prior_si().sigma();
    const double turned =
        s * rate * std::pow(warming, power) * std::pow(180.0, power + 1) / (power + 1);
    EXPECT_NEAR(Effect(key, s).phi_after(timeline, 18).x(), turned, 1e-9 + 1e-6 * turned) << key;
  }
}

TEST(TorquerCrosstalk, TurnsTheSlewAxis) {
  // X gyro: spin axis z, output axis y. A command about x reaches gyro y through its spin axis (x).
  const Timeline timeline = there_and_back();
  const Vec3 phi = Effect("X_S_y", 50e-6).phi_after(timeline, 18);
  // Rotation about an axis tilted by X toward y, seen in the turned platform: X (sin T, 1 - cos T).
  EXPECT_NEAR(std::hypot(phi.y(), phi.z()), 50e-6 * std::sqrt(2.0), 2e-8);
}

TEST(TorquerHeating, IsOneAfterASlewOf90DegLessWhatLeakedAway) {
  const Timeline timeline = there_and_back();
  const Effect effect("heat_x", 0.05 * deg_per_h);
  MemoryPath path(timeline, effect.model());
  for (std::size_t i = 0; i < 18; ++i) path.advance(i, effect.theta.data());
  const double tau = 15.0 * 60.0;
  const auto& info = TermLibrary::terms[TermLibrary::find_term("torquer_heating").value()];
  EXPECT_NEAR(path.points()[2].value[info.first_memory],
              tau / 180.0 * (1.0 - std::exp(-180.0 / tau)), 0.2);
  const std::size_t last = 2 * (timeline.intervals[17].node_count() - 1);
  EXPECT_NEAR(path.points()[last].value[info.first_memory],
              tau / 180.0 * (1.0 - std::exp(-180.0 / tau)), 1e-12);
}

TEST(RepositionTransient, DecaysAfterTheAttitudeChanges) {
  // Position 2 of "six" has x down after x up, caged: a_I changes by -2 g at once.
  const Timeline timeline = first_position();
  const double R = 0.05 * deg_per_h, tau = 600.0;
  const Effect effect("R_x", R);
  EXPECT_NEAR(effect.phi_after(timeline, 10).x(), 0.0, 1e-12);
  EXPECT_NEAR(effect.phi_after(timeline, 20).x(), 2.0 * R * tau * (1.0 - std::exp(-1.0)),
              turned_away * 2.0 * R * 600.0);
}

TEST(Friction, TakesATurnToChangeSides) {
  EXPECT_NEAR(dahl(1.0, -3e-4, 1e-4), -1.0 + 2.0 * std::exp(-3.0), 1e-15);
  EXPECT_EQ(dahl(0.3, 0.0, 1e-4), 0.3);
  // In two parts as in one.
  EXPECT_NEAR(dahl(dahl(0.2, 1e-4, 1e-4), 2e-4, 1e-4), dahl(0.2, 3e-4, 1e-4), 1e-15);
}

TEST(Lag, IsExactForALineOfInput) {
  // m' = (u - m)/tau, u = t/3: particular solution (t - tau)/3.
  const double tau = 7.0, m = lagged(0.0, 0.0, 5.0 / 3.0, 5.0, tau);
  EXPECT_NEAR(m, (5.0 - tau + tau * std::exp(-5.0 / tau)) / 3.0, 1e-14);
  EXPECT_NEAR(lagged(lagged(0.0, 0.0, 1.0, 3.0, tau), 1.0, 5.0 / 3.0, 2.0, tau), m, 1e-14);
}

TEST(LatitudeError, TurnsALevelPlatformAgainstTheLocalAxes) {
  const Timeline timeline = first_position();
  const double d = 100.0 * arcsec;
  const Vec3 psi_l = timeline.nodes.front().R_lr * Effect("d_lat", d).phi_after(timeline, 10);
  const double lat = harbin.latitude;
  const Vec3 expected = -omega * d * 600.0 * Vec3(-std::sin(lat), 0.0, std::cos(lat));
  EXPECT_LT((psi_l - expected).norm(),
            0.05 * expected.norm());  // Earth rate turns the error itself: Omega T = 4 %
  EXPECT_NEAR(psi_l.norm(), omega * d * 600.0, 1e-3 * omega * d * 600.0);
}

TEST(AzimuthError, GivesEarthRateAnEastPart) {
  const Timeline timeline = first_position();
  const double d = 60.0 * arcsec;
  const Vec3 psi_l = timeline.nodes.front().R_lr * Effect("d_az", d).phi_after(timeline, 10);
  const double expected = omega * std::cos(harbin.latitude) * d * 600.0;  // toward West: +
  EXPECT_NEAR(psi_l.y(), expected, 2e-3 * expected);
}

TEST(PierTilt, IsSeenByTheGimbalsAlone) {
  const Timeline timeline = first_position();
  const Effect effect("turn_c", 3.0 * arcsec);
  const Measurements with = effect.predicted(timeline),
                     without = Effect("D_F_x", 0.0).predicted(timeline);
  EXPECT_EQ(with.acc, without.acc);
  // The case turns by +3 arcsec about Up; x is up, so the chain turns back by that about x.
  const double turned = 3.0 * arcsec * std::cos(2.0 * std::numbers::pi * 600.0 / 86400.0);
  const Mat3 before = gimbal_chain(without.gimbal.col(9)), after = gimbal_chain(with.gimbal.col(9));
  EXPECT_LT((rotation_vector(before.transpose() * after) - Vec3(-turned, 0.0, 0.0)).norm(), 1e-12);
}

TEST(EncoderHarmonics, AreFunctionsOfTheAngle) {
  const Timeline timeline = scene("slew12", CommandLaw::free);
  const Measurements without = Effect("D_F_x", 0.0).predicted(timeline);
  Effect effect("enc_s2_inner", 5.0 * arcsec);
  effect.theta[param("enc_cn_outer")] = 2.0 * arcsec;
  const Measurements with = effect.predicted(timeline);
  for (Eigen::Index i = 0; i < with.gimbal.cols(); ++i) {
    const Vec3 d = with.gimbal.col(i) - without.gimbal.col(i), angle = without.gimbal.col(i);
    EXPECT_NEAR(std::remainder(d[2], 2.0 * std::numbers::pi),
                5.0 * arcsec * std::sin(2.0 * angle[2]), 1e-12);
    EXPECT_NEAR(std::remainder(d[0], 2.0 * std::numbers::pi),
                2.0 * arcsec * std::cos(16.0 * angle[0]), 1e-12);
    EXPECT_NEAR(d[1], 0.0, 1e-14);
  }
}

TEST(TimingSkew, IsTheRateOfTheAnglesTimesTheDelay) {
  const Timeline timeline = scene("six", CommandLaw::free);
  const Measurements without = Effect("D_F_x", 0.0).predicted(timeline);
  const Measurements with = Effect("skew", 0.1).predicted(timeline);
  for (Eigen::Index i = 1; i < 9; ++i)
    for (int k = 0; k < 3; ++k) {
      const double rate = (without.gimbal(k, i + 1) - without.gimbal(k, i - 1)) / 120.0;
      // Central difference over 2 x 60 s of angles that turn at Omega: (Omega 60 s)^2 / 6 = 3e-6.
      EXPECT_NEAR(with.gimbal(k, i) - without.gimbal(k, i), 0.1 * rate, 1e-5 * 0.1 * omega);
    }
}

TEST(HangOff, IsSeenByAccelerometersAndGimbalsAlike) {
  const Timeline timeline = first_position();
  const Measurements without = Effect("D_F_x", 0.0).predicted(timeline);
  const Measurements with = Effect("H_u_y", 5.0 * arcsec).predicted(timeline);
  // x up: u x a = u e_y x e_x = -u e_z.
  const Mat3 turn =
      gimbal_chain(without.gimbal.col(3)).transpose() * gimbal_chain(with.gimbal.col(3));
  EXPECT_LT((rotation_vector(turn) - Vec3(0.0, 0.0, -5.0 * arcsec)).norm(), 1e-12);
  // f = R^T up: the platform turned by -u about z sees gravity turned by +u: y gains u.
  EXPECT_NEAR(with.acc(1, 3) - without.acc(1, 3), 5.0 * arcsec, 1e-12);
}

}  // namespace
}  // namespace drift::term_physics_test
