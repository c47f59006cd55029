// What holds for every term of the library, whatever it is.
#include <gtest/gtest.h>

#include <cctype>
#include <map>
#include <set>

#include "core/base/dual.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::terms_test {
namespace {

using namespace drift::test;
using D = Dual<1>;

struct Scene {
  Mounting mounting;
  CaseTurn turn{Vec3(0.1, -0.2, 0.3), Mat3::Constant(0.1)};
  /// An attitude, an hour and a place at which every term has something to do.
  template <class S>
  Surroundings<S> around(const std::array<S, TermLibrary::num_memory>& memory) const {
    Surroundings<S> s;
    s.now = {5000.0,
             1000.0,
             false,
             0.3,
             harbin.omega_ie_l(),
             covariates_of_a_scene(),
             covariates_of_a_scene(1e-4),
             &turn};
    s.R_lp = rotation<double>(Vec3(0.4, -0.3, 0.8)).cast<S>();
    s.gimbal = Vec3(0.5, -0.4, 1.1).cast<S>();
    s.memory = memory.data();
    return s;
  }
  template <class S>
  Inputs<S> inputs(const Surroundings<S>& around) const {
    Inputs<S> in;
    in.around = &around;
    in.mounting = &mounting;
    in.f_p = Vec3(0.48, -0.36, 0.80).cast<S>();
    in.omega_ic_p = Vec3(3e-5, -5e-5, 4e-5).cast<S>();
    in.omega_cmd_p = Vec3(2e-3, -1e-3, 3e-3);
    return in;
  }
};

DriftModel everything(Coupling coupling) {
  DriftModel model{coupling, {}, {}};
  model.terms.set();
  return model;
}

/// Rate, accelerometers and gimbals, stacked; what a recording can depend on. Memory: something.
template <class S>
Eigen::Matrix<S, 9, 1> outputs(const Scene& scene, const DriftModel& model, const S* theta) {
  std::array<S, TermLibrary::num_memory> memory;
  for (std::size_t k = 0; k < memory.size(); ++k) memory[k] = S(0.3 + 0.1 * static_cast<double>(k));
  const Surroundings<S> around = scene.around<S>(memory);
  const Inputs<S> in = scene.inputs<S>(around);
  Eigen::Matrix<S, 9, 1> y;
  y << platform_rate(model, in, theta, Mat3::Zero()), accelerometer_output(model, in, theta),
      gimbal_output<S>(model, in, around.R_lp, 0.3, theta);
  return y;
}

/// Every amplitude at something, everything nonlinear at its default.
Theta scene_theta() {
  Theta theta = random_theta(17);
  for (std::size_t i = 0; i < TermLibrary::specs.size(); ++i) {
    const ParamSpec& spec = TermLibrary::specs[i];
    if (TermLibrary::owner(i).first > param("lambda"))
      theta[i] = spec.prior_si().mean() + (i % 2 ? 0.7 : -1.1) * spec.prior_si().sigma();
  }
  theta[param("lambda")] = 0.4;
  theta[param("dD_t0")] = 4900.0;  // the scene is at 5000 s
  theta[param("Z_width")] = 0.5;   // [g]: the scene is far from zero
  return theta;
}

/// Parameters whose derivative is felt through memory alone, or that have none.
bool without_derivative(std::size_t i) {
  const ParamKind kind = TermLibrary::specs[i].kind;
  const TermInfo& term = TermLibrary::owner(i);
  return kind == ParamKind::discrete || kind == ParamKind::noise ||
         (TermLibrary::specs[i].continuous() && term.memory > 0);
}

TEST(EveryTerm, DerivativesByDualNumbersAreThoseByDifferences) {
  const Scene scene;
  const DriftModel model = everything(Coupling::lambda);
  const Theta theta = scene_theta();
  for (std::size_t i = 0; i < TermLibrary::specs.size(); ++i) {
    std::array<D, TermLibrary::num_params> t;
    for (std::size_t k = 0; k < t.size(); ++k) t[k] = D(theta[k]);
    t[i].d[0] = 1.0;
    if (without_derivative(i)) continue;
    const auto y = outputs<D>(scene, model, t.data());
    // Central differences: truncation h^2/6 f''' (f''' ~ f for angles), rounding 1e-16/h.
    const Prior prior = TermLibrary::specs[i].prior_si();
    const double h = std::max({1e-8, 1e-2 * prior.sigma(), 1e-5 * std::abs(prior.mean())});
    Theta up = theta, down = theta;
    up[i] += h;
    down[i] -= h;
    const auto difference =
        ((outputs<double>(scene, model, up.data()) - outputs<double>(scene, model, down.data())) /
         (2.0 * h))
            .eval();
    double largest = 0.0;
    for (int r = 0; r < 9; ++r) {
      const double scale = r < 3 ? 5e-3 / h : 2.0 / h;
      EXPECT_NEAR(y[r].d[0], difference[r], 1e-6 * std::abs(difference[r]) + 1e-14 * scale)
          << TermLibrary::specs[i].key.view() << " output " << r;
      largest = std::max(largest, std::abs(y[r].d[0]));
    }
    EXPECT_GT(largest, 0.0) << TermLibrary::specs[i].key.view() << " reaches no output";
  }
}

/// What mc/task/left_out.cpp goes by: equations close over misalignments, and over nothing else.
TEST(EveryTerm, EquationsDifferByMisalignmentsAlone) {
  const Scene scene;
  const Theta theta = scene_theta();
  for (std::size_t t = 0; t < TermLibrary::terms.size(); ++t) {
    if (TermLibrary::terms[t].key == closure_term) continue;
    const auto rate = [&](Coupling coupling) -> Vec3 {
      return outputs<double>(scene, {coupling, TermMask().set(t), {}}, theta.data()).head<3>();
    };
    const double apart = (rate(Coupling::eq5) - rate(Coupling::eq6)).norm();
    const bool misaligns = TermLibrary::terms[t].key == "gyro_misalignment" ||
                           TermLibrary::terms[t].key == "misalignment_creep";
    EXPECT_EQ(apart > 1e-14 * rate(Coupling::eq5).norm(), misaligns) << TermLibrary::terms[t].key;
  }
}

TEST(EveryTerm, ZeroParametersMeanNoEffect) {
  // No amplitude; time constants and the like at zero too, which must do no harm.
  const Scene scene;
  const Theta zero = Theta::Zero();
  const DriftModel none{Coupling::eq5, {}, {}};
  const auto with = outputs<double>(scene, everything(Coupling::eq5), zero.data());
  const auto without = outputs<double>(scene, none, zero.data());
  // The gimbals' angles come out of one more product of rotations: 1 ulp.
  EXPECT_EQ(with.head<6>(), without.head<6>());
  EXPECT_LT((with - without).cwiseAbs().maxCoeff(), 4e-16);
  EXPECT_EQ(without.head<3>(), Vec3(2e-3, -1e-3, 3e-3));  // the command
}

TEST(EveryTerm, IsDocumented) {
  for (const TermInfo& term : TermLibrary::terms) {
    EXPECT_FALSE(term.title.empty() || term.equation.empty() || term.source.empty()) << term.key;
    for (std::size_t i = term.first; term.stochastic() && i < term.first + term.count; ++i)
      EXPECT_EQ(TermLibrary::specs[i].kind, ParamKind::noise) << term.key << " acts on nothing";
    EXPECT_GT(term.count, 0u) << term.key;
  }
}

TEST(TermLibrary, Holds60BaseParameters13PerGyro7PerAccelerometer) {
  std::map<char, int> gyro, accelerometer;
  for (std::size_t i = 0; i < TermLibrary::specs.size(); ++i) {
    const std::string_view key = TermLibrary::specs[i].key;
    if (!base_parameters()[i]) continue;
    (TermLibrary::owner(i).key == "accelerometer" ? accelerometer : gyro)[key.back()]++;
  }
  for (const char axis : {'x', 'y', 'z'}) {
    EXPECT_EQ(gyro[axis], 13);
    EXPECT_EQ(accelerometer[axis], 7);
  }
}

TEST(TermLibrary, HoldsEveryCandidateOfTheInterface) {
  // The keys that studies and other programs rely on: none is ever renamed.
  for (const char* key : {"drift_ramp",
                          "warmup_drift",
                          "reposition_transient",
                          "temperature_drift",
                          "temperature_g_drift",
                          "mass_unbalance_step",
                          "bistable_drift",
                          "drift_random_walk",
                          "cubic_g_drift",
                          "sag",
                          "gimbal_angle_drift",
                          "magnetic_drift",
                          "torquer_asymmetry",
                          "torquer_nonlinearity",
                          "torquer_heating",
                          "torquer_crosstalk",
                          "hang_off",
                          "stiction",
                          "servo_lag",
                          "float_restraint",
                          "output_axis_acceleration",
                          "base_motion_leak",
                          "misalignment_creep",
                          "latitude_error",
                          "azimuth_error",
                          "pier_tilt",
                          "pier_azimuth",
                          "encoder_harmonics",
                          "gimbal_nonorthogonality",
                          "timing_skew",
                          "accelerometer_temperature",
                          "accelerometer_asymmetry",
                          "accelerometer_cross",
                          "accelerometer_dead_zone",
                          "accelerometer_ramp",
                          "outliers",
                          "frame_closure",
                          "inner_lever_arm",
                          "accelerometer_delay",
                          "temperature_drift_curve",
                          "temperature_rate_drift",
                          "torquer_temperature",
                          "accelerometer_temperature_curve",
                          "accelerometer_temperature_rate",
                          "gimbal_zero"})
    EXPECT_TRUE(TermLibrary::find_term(key).has_value()) << key;
}

TEST(TermLibrary, KeysDifferInMoreThanCase) {
  // Result stores and MATLAB users do not tell q_x from Q_x.
  std::set<std::string> keys;
  for (const auto& spec : TermLibrary::specs) {
    std::string key(spec.key.view());
    for (char& c : key) c = static_cast<char>(std::tolower(c));
    EXPECT_TRUE(keys.insert(key).second) << spec.key.view();
  }
}

TEST(TermLibrary, WhatIsProfiledIsKnownByDefaultAndHasAGrid) {
  for (const auto& spec : TermLibrary::specs) {
    const bool of_the_test = spec.kind == ParamKind::moment;  // whose grid is the test
    EXPECT_EQ(spec.setting() && !of_the_test, spec.grid.size > 0) << spec.key.view();
    if (spec.setting()) {
      EXPECT_EQ(spec.prior.kind, Prior::Kind::fixed) << spec.key.view();
    }
    if (spec.amplitude()) {
      EXPECT_GT(spec.prior.sigma(), 0.0) << spec.key.view();
      EXPECT_EQ(spec.prior.mean() == 0.0, spec.key.view() != "lambda") << spec.key.view();
    }
  }
}

TEST(TermLibrary, TheAxisOfAParameterIsTheEndOfItsKey) {
  for (const auto& spec : TermLibrary::specs) {
    const std::string key =
        std::string(spec.group.view()) + (spec.axis.empty() ? "" : "_" + std::string(spec.axis));
    EXPECT_EQ(spec.key.view(), key);
  }
}

TEST(TermLibrary, OneAxisOfATermBringsItsTimeConstant) {
  EXPECT_EQ(params_named("warmup_drift.x"), only({"W_x", "W_tau"}));
  EXPECT_EQ(TermLibrary::completed(only({"heat_y"})), only({"heat_y", "heat_tau"}));
  EXPECT_EQ(TermLibrary::completed(only({"D_I_y"})), only({"D_I_y"}));
  const auto text = terms_text(params_named("warmup_drift.x") | params_named("warmup_drift.y"));
  EXPECT_EQ(text, (std::vector<std::string>{"warmup_drift.x", "warmup_drift.y"}));
}

TEST(TermLibrary, EveryParameterHasAStreamOfItsOwn) {
  std::set<std::uint32_t> indices;
  for (const auto& spec : TermLibrary::specs) indices.insert(stream_index(spec.key));
  EXPECT_EQ(indices.size(), TermLibrary::specs.size());
}

TEST(TermLibrary, DefaultPriorsAreThoseOfTheInterface) {
  const auto check = [](const char* key, double sigma, const char* unit) {
    const ParamSpec& spec = TermLibrary::specs[param(key)];
    EXPECT_EQ(spec.prior, normal(0.0, sigma)) << key;
    EXPECT_EQ(spec.unit.symbol.view(), unit) << key;
  };
  check("D_F_x", 1.0, "deg/h");
  check("D_I_y", 2.0, "deg/h/g");
  check("D_O_z", 0.3, "deg/h/g");
  check("D_S_x", 2.0, "deg/h/g");
  for (const char* key : {"D_II_x", "D_OO_y", "D_SS_z", "D_IO_x", "D_IS_y", "D_OS_z"})
    check(key, 0.1, "deg/h/g^2");
  check("eta_x", 200.0, "arcsec");
  check("xi_z", 200.0, "arcsec");
  check("s_y", 1000.0, "ppm");
  check("K0_x", 500.0, "ug");
  check("K1_y", 500.0, "ppm");
  check("K2_z", 50.0, "ug/g^2");
  check("K3_x", 20.0, "ug/g^3");
  check("K_ip_y", 50.0, "ug/g^2");
  check("dP_z", 100.0, "arcsec");
  check("dO_x", 100.0, "arcsec");
  EXPECT_EQ(TermLibrary::specs[param("lambda")].prior, uniform(0.0, 1.0));
}

}  // namespace
}  // namespace drift::terms_test
