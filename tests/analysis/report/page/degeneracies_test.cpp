#include "analysis/report/page/degeneracies.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <map>
#include <nlohmann/json.hpp>

#include "analysis/report/page/json.hpp"
#include "tests/analysis/report/identify/identification_fixture.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::degeneracies_test {
namespace {

using Combination = std::map<std::string_view, double>;  // in each parameter's unit

Layout layout() {
  return make_layout(test::study().filters[0]);
}

VecX scaled(const Layout& l, const Combination& combination) {
  VecX v = VecX::Zero(static_cast<Eigen::Index>(l.size()));
  for (const auto& [key, c] : combination) {
    const std::size_t param = TermLibrary::find(key).value();
    const auto k = std::ranges::find(l.params, param) - l.params.begin();
    v[k] = c * TermLibrary::specs[param].unit.to_si / l.sigma[k];
  }
  return v;
}

/// What a test does not see: a space spanned by combinations, in an orthonormal basis turned at
/// random, as a decomposition gives it. Of all that is perpendicular to it one prior sigma leaves
/// `signal` sigma.
struct Unseen {
  std::vector<WeakDirection> directions;
  MatX root;
  Excitation excitation;

  Unseen(const Layout& l, const std::vector<Combination>& combinations, double signal = 1e4) {
    const auto n = static_cast<Eigen::Index>(l.size());
    MatX A(n, static_cast<Eigen::Index>(combinations.size()));
    for (std::size_t c = 0; c < combinations.size(); ++c) A.col(c) = scaled(l, combinations[c]);
    const MatX Q = MatX(A.householderQr().householderQ()).leftCols(A.cols());
    Stream stream(7, 0, Purpose::filter_start);
    MatX mix(A.cols(), A.cols());
    for (Eigen::Index i = 0; i < mix.size(); ++i) mix(i) = stream.normal();
    const MatX basis = Q * MatX(mix.householderQr().householderQ());
    for (Eigen::Index c = 0; c < basis.cols(); ++c) directions.push_back({0.0, basis.col(c)});
    root = signal * (MatX::Identity(n, n) - basis * basis.transpose());
  }
  /// A further direction, which leaves less.
  void add(const VecX& unit, double signal) {
    directions.push_back({signal * signal, unit});
    root += (signal * unit - root * unit) * unit.transpose();
  }
  std::vector<report::NamedDirection> named(const Layout& l, Coupling of = Coupling::eq5) const {
    return report::name_degeneracies(l, {}, {directions, root, excitation, of});
  }
};

/// Signal per prior sigma of a direction as it is written [sigma].
double signal_as_written(const Layout& l, const MatX& root, const report::NamedDirection& d) {
  Combination c;
  for (const auto& part : d.parts) c[TermLibrary::specs[part.param].key.view()] = part.coefficient;
  const VecX v = scaled(l, c);
  return (root * v).norm() / v.norm();
}

Layout layout_of(std::initializer_list<std::string_view> keys) {
  ModelSpec spec = test::base_spec(Coupling::eq5);
  spec.active = test::only(keys);
  return make_layout(spec);
}

std::vector<std::string> combinations_of(const std::vector<report::NamedDirection>& directions) {
  std::vector<std::string> all;
  for (const auto& d : directions) all.push_back(d.combination);
  std::ranges::sort(all);
  return all;
}

TEST(NameDegeneracies, FindsReadableDirectionsInATurnedBasis) {
  const Layout l = layout();
  const auto named =
      Unseen(l, {{{"D_F_x", 1.0}, {"D_II_x", -1.0}, {"D_OO_x", -1.0}, {"D_SS_x", -1.0}},
                 {{"D_F_z", 1.0}, {"D_II_z", -1.0}, {"D_OO_z", -1.0}, {"D_SS_z", -1.0}},
                 {{"K1_y", 1.0}, {"K3_y", -1.0}},
                 {{"D_IO_x", 1.0}},
                 {{"K_ip_z", 1.0}},
                 {{"D_I_y", 2.0}, {"K0_x", 200.0}}})
          .named(l);
  EXPECT_EQ(combinations_of(named),
            (std::vector<std::string>{"D_F_x - D_II_x - D_OO_x - D_SS_x",
                                      "D_F_z - D_II_z - D_OO_z - D_SS_z", "D_IO_x",
                                      "D_I_y + 100 K0_x", "K1_y - K3_y", "K_ip_z"}));
  std::map<std::string, std::string> reason;
  for (const auto& d : named) reason[d.combination] = d.reason;
  EXPECT_NE(reason["D_F_x - D_II_x - D_OO_x - D_SS_x"].find("trace"), std::string::npos);
  EXPECT_NE(reason["K1_y - K3_y"].find("cubic"), std::string::npos);
  EXPECT_NE(reason["D_IO_x"].find("product of two axes"), std::string::npos);
  EXPECT_EQ(reason["D_I_y + 100 K0_x"], "");
}

TEST(NameDegeneracies, KnowsTheBiasOfAnAccelerometerWithItsSquares) {
  FilterSpec filter = test::study().filters[0];
  TermMask cross;
  cross.set(TermLibrary::find_term("accelerometer_cross").value());
  filter.active |= TermLibrary::params_of(cross);
  const Layout l = make_layout(filter);
  const auto named =
      Unseen(l, {{{"K0_x", 1.0}, {"K2_x", -1.0}, {"K_pp_x", -1.0}, {"K_oo_x", -1.0}}}).named(l);
  ASSERT_EQ(named.size(), 1u);
  EXPECT_EQ(named[0].combination, "K0_x - K2_x - K_pp_x - K_oo_x");
  EXPECT_NE(named[0].reason.find("a_I^2 + a_O^2 + a_P^2 = 1 g^2"), std::string::npos)
      << named[0].reason;
}

TEST(NameDegeneracies, KnowsTheGaugeOfTheTriads) {
  // Rotation about x of (x,y,z) triads: y tilts to z, z to -y. For gyro Y (I,O,S) = (y,z,x), z is
  // its output axis: xi_y = 1; for Z (z,x,y), y is its spin axis: eta_z = -1. Accelerometers
  // (I,P,O) alike: dP_y = 1, dO_z = -1.
  const Layout l = layout();
  const auto named =
      Unseen(l, {{{"xi_y", 1.0}, {"eta_z", -1.0}, {"dP_y", 1.0}, {"dO_z", -1.0}}}).named(l);
  ASSERT_EQ(named.size(), 1u);
  EXPECT_EQ(named[0].combination, "eta_z - xi_y - dP_y + dO_z");
  EXPECT_NE(named[0].reason.find("gauge"), std::string::npos);
}

TEST(NameDegeneracies, ClaimsNothingThatIsNotInTheSpace) {
  const Layout l = layout();
  const auto named = Unseen(l, {{{"D_F_x", 1.0}, {"D_II_x", -1.0}, {"D_OO_x", -1.0}},
                                {{"K1_x", 1.0}, {"K3_x", 1.0}}})
                         .named(l);
  ASSERT_EQ(named.size(), 2u);
  for (const auto& d : named) EXPECT_EQ(d.reason, "") << d.combination;
}

TEST(NameDegeneracies, CountsEachDirectionOnce) {
  // K1_x and K3_x each without signal: their difference is no third direction, nor one of two.
  const Layout l = layout();
  const auto named = Unseen(l, {{{"K1_x", 1.0}}, {{"K3_x", 1.0}}}).named(l);
  EXPECT_EQ(combinations_of(named), (std::vector<std::string>{"K1_x", "K3_x"}));
  EXPECT_TRUE(report::name_degeneracies(l, {}, {{}, MatX(), {}}).empty());
}

TEST(NameDegeneracies, KeepsASmallPartThatIsSeenAndNoOther) {
  // D_F_x is 1/94.281 of this direction in prior sigmas. Without it 5000/94.3 = 53 sigma would be
  // seen; of D_F_z 5000 * 1e-8 sigma, less than 0.001.
  const Layout l = layout_of({"D_F", "s"});
  const Unseen space(l, {{{"D_F_x", 1.0}, {"s_x", 94281.0}, {"D_F_z", 1e-6}}}, 5e3);
  const auto named = space.named(l);
  ASSERT_EQ(named.size(), 1u);
  EXPECT_EQ(named[0].combination, "D_F_x + 94281 s_x");
  EXPECT_EQ(named[0].reason, "");
  // D_F_z is not written, and misses: 5000 * 1e-6 / |94281 s_x in prior sigmas|.
  EXPECT_EQ(named[0].unrounded, 0.0);
  EXPECT_GT(named[0].signal, 1e-6);
  EXPECT_LT(named[0].signal, 1e-3);
  const double written = signal_as_written(l, space.root, named[0]);
  EXPECT_NEAR(named[0].signal, written, 1e-6 * written);
  EXPECT_NEAR(signal_as_written(l, space.root, {{{test::param("s_x"), 1.0}}, {}, {}}), 53.0, 0.1);
}

TEST(NameDegeneracies, WritesTheDigitsThatTheSignalTakes) {
  // Prior sigmas 2 deg/h/g and 500 ug: a coefficient that is off by c leaves 32 c sigma of 1e4. In
  // six digits, 123.457, that is 0.01.
  const Layout l = layout();
  const Unseen space(l, {{{"D_I_y", 1.0}, {"K0_x", 123.4567}}});
  const auto named = space.named(l);
  ASSERT_EQ(named.size(), 1u);
  EXPECT_EQ(named[0].combination, "D_I_y + 123.4567 K0_x");
  // Text, page and JSON say the same.
  const report::Json json = report::directions_json(named);
  EXPECT_EQ(json[0]["combination"], named[0].combination);
  EXPECT_EQ(json[0]["coefficients"]["K0_x"], 123.4567);
  EXPECT_EQ(json[0]["signal_sigma"], 0.0);
  report::Table table = report::direction_table("");
  report::add_directions(table, named);
  EXPECT_NE(report::text_of(table, 100).find("D_I_y + 123.4567 K0_x"), std::string::npos);
  EXPECT_LT(signal_as_written(l, space.root, named[0]), 1e-3);
}

TEST(NameDegeneracies, TheSignalIsThatOfTheDirectionAsItIsWritten) {
  // In seven digits 123.456749 is 123.4567, which is off by 4.9e-5: 32 sigma for one make 1.6e-3.
  // In eight, 123.45675, it is off by 1e-6: 3e-5.
  const Layout l = layout();
  const Unseen space(l, {{{"D_I_y", 1.0}, {"K0_x", 123.456749}}});
  const auto named = space.named(l);
  ASSERT_EQ(named.size(), 1u);
  EXPECT_EQ(named[0].combination, "D_I_y + 123.45675 K0_x");
  const double written = signal_as_written(l, space.root, named[0]);
  EXPECT_GT(written, 1e-5);
  EXPECT_NEAR(named[0].signal, written, 1e-6 * written);
  EXPECT_EQ(named[0].unrounded, 0.0);
  const report::Json json = report::directions_json(named);
  EXPECT_EQ(json[0]["signal_sigma"], named[0].signal);
  EXPECT_EQ(json[0]["unrounded_signal_sigma"], 0.0);
}

TEST(NameDegeneracies, SaysNoSignalOfWhatHasNoneAlone) {
  const Layout l = layout();
  Unseen space(l, {{{"D_F_x", 1.0}}});
  space.add(scaled(l, {{"K0_x", 1.0}}).normalized(), 5e-4);
  space.add(scaled(l, {{"D_I_y", 1.0}, {"K2_y", -1.0}}).normalized(), 7e-4);
  const auto named = space.named(l);
  ASSERT_EQ(named.size(), 3u);
  EXPECT_EQ(named[0].combination, "D_F_x");
  EXPECT_EQ(named[0].reason, "no signal in this test");
  EXPECT_EQ(named[0].signal, 0.0);
  EXPECT_EQ(named[1].combination, "D_I_y - K2_y");
  EXPECT_EQ(named[1].reason, "");
  EXPECT_NEAR(named[1].signal, 7e-4, 1e-6);
  EXPECT_EQ(named[2].combination, "K0_x");
  EXPECT_EQ(named[2].reason, "hardly any signal in this test");
  EXPECT_NEAR(named[2].signal, 5e-4, 1e-6);
  EXPECT_EQ(report::unseen_text(space.directions, space.root),
            "1 is not seen at all, 2 leave less than 0.001 sigma at a prior sigma");
}

TEST(NameDegeneracies, KnowsThatEquation6TurnsDriftAloneInFreeDrift) {
  // D_I_z = 1.45 deg/h/g turned by eta_x is D_S_x: 206265 / 1.45 arcsec for 1 deg/h/g.
  const Layout l = layout();
  Unseen space(l, {{{"D_S_x", 1.0}, {"eta_x", 142252.0}}, {{"D_S_y", 1.0}, {"K0_x", 10.0}}});
  const auto reason = [&](Coupling coupling, std::string_view first) -> std::string {
    for (const auto& d : space.named(l, coupling))
      if (d.combination.starts_with(first)) return d.reason;
    return "not there";
  };
  EXPECT_NE(reason(Coupling::eq6, "D_S_x").find("turns drift"), std::string::npos);
  EXPECT_EQ(reason(Coupling::eq6, "D_S_y"), "");  // what has no misalignment in it
  EXPECT_EQ(reason(Coupling::eq5, "D_S_x"), "");  // which turns the Earth's rate, too
  space.excitation.commanded[1] = true;           // and so do commands
  EXPECT_EQ(reason(Coupling::eq6, "D_S_x"), "");
}

TEST(NameDegeneracies, GivesAReasonThatTheTestHas) {
  const Layout l = layout_of({"s", "X_S", "D_IO"});
  Unseen space(l, {{{"s_y", 1.0}}, {{"X_S_y", 1.0}}, {{"D_IO_x", 1.0}}});
  const auto reason = [&](std::string_view combination) -> std::string {
    for (const auto& d : space.named(l))
      if (d.combination == combination) return d.reason;
    return "not there";
  };
  const std::string never = "no signal: the gyro is never torqued", none = "no signal in this test";
  EXPECT_EQ(reason("s_y"), never);
  EXPECT_EQ(reason("X_S_y"), never);
  EXPECT_NE(reason("D_IO_x").find("a product of two axes"), std::string::npos);
  space.excitation.commanded = {true, false, true};  // of gyro y the spin axis is x
  EXPECT_EQ(reason("s_y"), never);
  EXPECT_EQ(reason("X_S_y"), none);
  space.excitation.commanded = {false, true, false};
  EXPECT_EQ(reason("s_y"), none);
  EXPECT_EQ(reason("X_S_y"), never);
  space.excitation.along_both[0][1] = true;  // of gyro x the axes I and O
  EXPECT_EQ(reason("D_IO_x"), none);
}

}  // namespace
}  // namespace drift::degeneracies_test
