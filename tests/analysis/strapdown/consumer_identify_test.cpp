// Units whose gyros do not see the Earth.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report/strapdown/case_report.hpp"
#include "analysis/strapdown/case_identify.hpp"
#include "analysis/strapdown/consumer_grade.hpp"
#include "analysis/strapdown/sensed.hpp"
#include "core/base/check.hpp"
#include "core/config/load.hpp"
#include "tests/support/drawn_unit.hpp"
#include "tests/support/pulls.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::strapdown::consumer_identify_test {
namespace {

constexpr std::string_view all_of_it =
    R"("fixed_drift", "g_drift", "gyro_misalignment", "torquer_scale", "K0", "K1", "dP", "dO")";

mc::Study study_with(const std::vector<std::string>& couplings, std::string_view terms) {
  std::string text = "schema = 1\n[site]\nlatitude = \"45.75 deg\"\n[plan]\nkind = \"strapdown\"\n";
  for (const std::string& c : couplings)
    text +=
        fmt::format("[[filter]]\nname = \"{0}\"\ncoupling = \"{0}\"\nterms = [{1}]\n", c, terms);
  return mc::read_study_tree(config::parse_document(text, "study.toml"), "study.toml");
}

/// Of one sample [rad/s]: 0.3 deg/sqrt(h), which in a dwell knows as much as the Earth turns; and
/// ten times that.
constexpr double quiet = 9e-4, loud = 0.01;

Recording recorded(const mc::Study& study, const Theta& theta, std::size_t dwells,
                   std::uint64_t seed, double gyro_noise = loud) {
  test::StrapdownScript script;
  script.dwells = dwells;
  script.gyro_noise = gyro_noise;
  script.omega_ie_l = study.site.omega_ie_l();
  script.seed = seed;
  return strapdown_recording(script, theta);
}

Theta tilted() {
  Theta theta = Theta::Zero();
  for (const auto& [key, value] :
       std::initializer_list<std::pair<const char*, double>>{{"D_F_x", 900},
                                                             {"D_F_y", -2500},
                                                             {"s_x", 8000},
                                                             {"K0_x", 9000},
                                                             {"eta_x", 2500},
                                                             {"xi_y", 3000},
                                                             {"xi_z", -2200}})
    test::set(theta, key, value);
  return theta;
}

test::Pulls pulls_of_units(std::uint64_t first, std::uint64_t last, double gyro_noise = loud) {
  const mc::Study study = study_with({"eq5"}, all_of_it);
  test::Pulls pulls;
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    const Theta truth = test::drawn_unit(study.filters.front(), seed, consumer_prior);
    const CaseStudy of = case_study(study, recorded(study, truth, 30, seed, gyro_noise));
    EXPECT_FALSE(of.compass.sees_earth);
    const FilterSpec filter = case_filter(study.filters.front(), of);
    const BatchResult fit = fit_batch(filter, of.measured(), start_of(filter, of));
    EXPECT_EQ(fit.estimate.status, EstimateStatus::ok) << seed;
    pulls.add(as_sensed(fit.estimate), truth);
  }
  return pulls;
}

TEST(ConsumerIdentify, ErrorsOfTenUnitsAreAsLargeAsTheirSigmas) {
  test::expect_as_large_as_sigmas(pulls_of_units(1, 10));
}

TEST(ConsumerIdentifyNightly, ErrorsOfFiftyUnitsAreAsLargeAsTheirSigmas) {
  test::expect_as_large_as_sigmas(pulls_of_units(101, 150));
}

/// Where North is nobody knows, and these gyros feel the Earth turn about it.
TEST(ConsumerIdentify, TheUnknownNorthIsInTheSigmasOfTenQuietUnits) {
  test::expect_as_large_as_sigmas(pulls_of_units(251, 260, quiet));
}

TEST(ConsumerIdentifyNightly, TheUnknownNorthIsInTheSigmasOfFiftyQuietUnits) {
  test::expect_as_large_as_sigmas(pulls_of_units(401, 450, quiet));
}

TEST(ConsumerIdentify, SaysWhatItCannotSeeWithoutANumberAndTheSameForTheSameSeed) {
  const mc::Study study = study_with({"eq5"}, all_of_it);
  const auto identified = [&] {
    return identify_case(study, case_study(study, recorded(study, tilted(), 16, 1)));
  };
  const CaseIdentification id = identified();
  const auto json = report::to_json(id, study.site.gravity);
  std::string all;
  for (const auto& u : json.at("unobservable")) {
    all += u.at("what").get<std::string>() + "\n";
    for (const auto& [key, value] : u.items()) EXPECT_TRUE(value.is_string()) << key;
  }
  for (const char* what : {"isotropic", "Earth rate", "azimuth", "temperature", "lambda"})
    EXPECT_NE(all.find(what), std::string::npos) << what;
  double common = 0.0;
  int members = 0;
  for (const auto& p : json.at("parameters"))
    if (p.at("key").get<std::string>().starts_with("D_I_")) {
      common += p.at("value").get<double>();
      ++members;
    }
  EXPECT_EQ(members, 3);
  EXPECT_NEAR(common, 0.0, 1e-9);
  EXPECT_FALSE(json.at("earth_seen").get<bool>());
  EXPECT_TRUE(json.at("azimuth_sigma_deg").is_null());
  EXPECT_EQ(json.at("dwells").at("count"), 16);
  EXPECT_EQ(json.dump(), report::to_json(identified(), study.site.gravity).dump());
}

TEST(ConsumerIdentify, EquationSixFailsOnATiltedSensor) {
  const mc::Study study = study_with({"eq5", "eq6"}, all_of_it);
  const CaseIdentification id =
      identify_case(study, case_study(study, recorded(study, tilted(), 20, 1)));
  EXPECT_GT(id.eq5_gain, 4.0);
  EXPECT_GT(id.fits[1].up.held_out, 3.0 * id.fits[0].up.held_out);
}

TEST(ConsumerIdentify, FewDwellsAreNotHeldOut) {
  const mc::Study study = study_with({"eq5"}, all_of_it);
  const CaseIdentification id =
      identify_case(study, case_study(study, recorded(study, tilted(), 4, 1)));
  EXPECT_EQ(id.division.folds, 0);
  EXPECT_EQ(id.fits.front().up.count, 0u);
  EXPECT_TRUE(std::ranges::any_of(id.fits.front().unobservable,
                                  [](const Unobservable& u) { return u.what == "dO_y"; }));
}

TEST(ConsumerIdentify, OnlyEquationsFiveAndSixApply) {
  for (const auto& couplings : {std::vector<std::string>{}, std::vector<std::string>{"lambda"}}) {
    const mc::Study study = study_with(couplings, all_of_it);
    try {
      identify_case(study, case_study(study, recorded(study, tilted(), 8, 1)));
      FAIL() << "accepted";
    } catch (const InputError& e) {
      EXPECT_EQ(e.code(), ExitCode::config);
    }
  }
}

TEST(Sensed, IsTheInverseOfWhatThePlatformIsTold) {
  // reading = (1 + s) w + D  <=>  w = (1 + S) reading - w'.
  const double s = 0.03, D = 0.002, w = 0.5;
  const double S = 1.0 / (1.0 + s) - 1.0, drift = D / (1.0 + s);
  EXPECT_NEAR((1.0 + S) * ((1.0 + s) * w + D) - drift, w, 1e-15);
  const Vec3 scales(S, 0.0, 0.0);
  EXPECT_NEAR(as_sensed(TermLibrary::index("s_x"), S, scales), s, 1e-15);
  EXPECT_NEAR(as_sensed(TermLibrary::index("D_F_x"), drift, scales), D, 1e-15);
  EXPECT_EQ(as_sensed(TermLibrary::index("eta_x"), 0.01, scales), 0.01);
}

}  // namespace
}  // namespace drift::strapdown::consumer_identify_test
