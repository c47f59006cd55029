// What holds for every term of the library, whatever it is.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/base/dual.hpp"
#include "tests/support/model_builders.hpp"

namespace drift {
namespace {

using namespace drift::test;
using D = Dual<1>;

struct Scene {
  Mounting mounting;
  template <class S>
  Inputs<S> inputs() const {
    Inputs<S> in;
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

/// Rate and readout, stacked; what a recording can depend on.
template <class S>
Eigen::Matrix<S, 6, 1> outputs(const DriftModel& model, const Inputs<S>& in, const S* theta) {
  Eigen::Matrix<S, 6, 1> y;
  y << platform_rate(model, in, theta, Mat3::Zero()), accelerometer_output(model, in, theta);
  return y;
}

Theta scene_theta() {
  Theta theta = random_theta(17);
  theta[param("lambda")] = 0.4;
  return theta;
}

TEST(EveryTerm, DerivativesByDualNumbersAreThoseByDifferences) {
  const Scene scene;
  const DriftModel model = everything(Coupling::lambda);
  const Theta theta = scene_theta();
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i) {
    std::array<D, TermLibrary::num_params> t;
    for (std::size_t k = 0; k < t.size(); ++k) t[k] = D(theta[k]);
    t[i].d[0] = 1.0;
    const auto y = outputs(model, scene.inputs<D>(), t.data());
    // Central differences: truncation h^2/6 f''' (f''' ~ f for angles), rounding 1e-16/h.
    const double h = 1e-2 * std::max(1e-8, TermLibrary::specs[i].prior_si().sigma());
    Theta up = theta, down = theta;
    up[i] += h;
    down[i] -= h;
    const auto difference = ((outputs(model, scene.inputs<double>(), up.data()) -
                              outputs(model, scene.inputs<double>(), down.data())) / (2.0 * h)).eval();
    double largest = 0.0;
    for (int r = 0; r < 6; ++r) {
      const double scale = r < 3 ? 5e-3 / h : 2.0 / h;
      EXPECT_NEAR(y[r].d[0], difference[r], 1e-6 * std::abs(difference[r]) + 1e-14 * scale)
          << TermLibrary::specs[i].key.view() << " output " << r;
      largest = std::max(largest, std::abs(y[r].d[0]));
    }
    EXPECT_GT(largest, 0.0) << TermLibrary::specs[i].key.view() << " reaches no output";
  }
}

TEST(EveryTerm, ZeroParametersMeanNoEffect) {
  const Scene scene;
  const Theta zero = Theta::Zero();
  const auto in = scene.inputs<double>();
  const DriftModel none{Coupling::eq5, {}, {}};
  EXPECT_EQ(outputs(everything(Coupling::eq5), in, zero.data()), outputs(none, in, zero.data()));
  EXPECT_EQ(platform_rate(none, in, zero.data(), Mat3::Zero()), in.omega_cmd_p);
}

TEST(EveryTerm, IsDocumented) {
  for (const TermInfo& term : TermLibrary::terms) {
    EXPECT_FALSE(term.title.empty() || term.equation.empty() || term.source.empty()) << term.key;
    EXPECT_TRUE(term.in_rates || term.in_readout) << term.key;
    EXPECT_GT(term.count, 0u) << term.key;
  }
}

TEST(TermLibrary, Holds60BaseParameters13PerGyro7PerAccelerometer) {
  std::map<char, int> gyro, accelerometer;
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i) {
    const std::string_view key = TermLibrary::specs[i].key;
    if (key == "lambda") continue;
    (TermLibrary::owner(i).key == "accelerometer" ? accelerometer : gyro)[key.back()]++;
  }
  for (const char axis : {'x', 'y', 'z'}) {
    EXPECT_EQ(gyro[axis], 13);
    EXPECT_EQ(accelerometer[axis], 7);
  }
}

TEST(TermLibrary, EveryParameterHasAStreamOfItsOwn) {
  std::set<std::uint32_t> indices;
  for (const auto& spec : TermLibrary::specs) indices.insert(stream_index(spec.key));
  EXPECT_EQ(indices.size(), TermLibrary::num_params);
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
}  // namespace drift
