#include "analysis/report/page/degeneracies.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <map>

#include "tests/analysis/report/identify/identification_fixture.hpp"

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

/// The space spanned by combinations, in an orthonormal basis turned at random, as an eigenvalue
/// decomposition gives it.
std::vector<WeakDirection> turned_space(const Layout& l,
                                        const std::vector<Combination>& combinations) {
  MatX A(static_cast<Eigen::Index>(l.size()), static_cast<Eigen::Index>(combinations.size()));
  for (std::size_t c = 0; c < combinations.size(); ++c) A.col(c) = scaled(l, combinations[c]);
  const MatX Q = MatX(A.householderQr().householderQ()).leftCols(A.cols());
  Stream stream(7, 0, Purpose::filter_start);
  MatX mix(A.cols(), A.cols());
  for (Eigen::Index i = 0; i < mix.size(); ++i) mix(i) = stream.normal();
  const MatX basis = Q * MatX(mix.householderQr().householderQ());
  std::vector<WeakDirection> space;
  for (Eigen::Index c = 0; c < basis.cols(); ++c) space.push_back({0.0, basis.col(c)});
  return space;
}

std::vector<std::string> combinations_of(const std::vector<report::NamedDirection>& directions) {
  std::vector<std::string> all;
  for (const auto& d : directions) all.push_back(d.combination);
  std::ranges::sort(all);
  return all;
}

TEST(NameDegeneracies, FindsReadableDirectionsInATurnedBasis) {
  const Layout l = layout();
  const auto named = report::name_degeneracies(
      l, {},
      turned_space(l, {{{"D_F_x", 1.0}, {"D_II_x", -1.0}, {"D_OO_x", -1.0}, {"D_SS_x", -1.0}},
                       {{"D_F_z", 1.0}, {"D_II_z", -1.0}, {"D_OO_z", -1.0}, {"D_SS_z", -1.0}},
                       {{"K1_y", 1.0}, {"K3_y", -1.0}},
                       {{"D_IO_x", 1.0}},
                       {{"K_ip_z", 1.0}},
                       {{"D_I_y", 2.0}, {"K0_x", 200.0}}}));
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
  const auto named = report::name_degeneracies(
      l, {},
      turned_space(l, {{{"K0_x", 1.0}, {"K2_x", -1.0}, {"K_pp_x", -1.0}, {"K_oo_x", -1.0}}}));
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
  const auto named = report::name_degeneracies(
      l, {}, turned_space(l, {{{"xi_y", 1.0}, {"eta_z", -1.0}, {"dP_y", 1.0}, {"dO_z", -1.0}}}));
  ASSERT_EQ(named.size(), 1u);
  EXPECT_EQ(named[0].combination, "eta_z - xi_y - dP_y + dO_z");
  EXPECT_NE(named[0].reason.find("gauge"), std::string::npos);
}

TEST(NameDegeneracies, ClaimsNothingThatIsNotInTheSpace) {
  const Layout l = layout();
  const auto named = report::name_degeneracies(
      l, {},
      turned_space(l, {{{"D_F_x", 1.0}, {"D_II_x", -1.0}, {"D_OO_x", -1.0}},
                       {{"K1_x", 1.0}, {"K3_x", 1.0}}}));
  ASSERT_EQ(named.size(), 2u);
  for (const auto& d : named) EXPECT_EQ(d.reason, "") << d.combination;
}

TEST(NameDegeneracies, CountsEachDirectionOnce) {
  // K1_x and K3_x each without signal: their difference is no third direction.
  const Layout l = layout();
  const auto named =
      report::name_degeneracies(l, {}, turned_space(l, {{{"K1_x", 1.0}}, {{"K3_x", 1.0}}}));
  ASSERT_EQ(named.size(), 2u);
  EXPECT_TRUE(report::name_degeneracies(l, {}, {}).empty());
}

}  // namespace
}  // namespace drift::degeneracies_test
