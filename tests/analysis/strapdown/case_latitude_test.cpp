// Gyros that see the Earth know the latitude: a wrong one of the study is said, and nothing else is
// taken for it.
#include "analysis/strapdown/case_latitude.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "analysis/strapdown/case_diagnose.hpp"
#include "analysis/strapdown/consumer_grade.hpp"
#include "core/config/load.hpp"
#include "tests/support/case_unit.hpp"
#include "tests/support/drawn_unit.hpp"
#include "tests/support/recordings_by_others.hpp"

namespace drift::strapdown::case_latitude_test {
namespace {

mc::Study study_at(double latitude_deg) {
  return mc::read_study_tree(
      config::parse_document(
          fmt::format("schema = 1\n[site]\nlatitude = \"{} deg\"\ngravity = \"9.8 m/s^2\"\n[plan]\n"
                      "kind = \"strapdown\"\n[[filter]]\nname = \"unit\"\ncoupling = \"eq5\"\n"
                      "terms = [\"fixed_drift\", \"gyro_misalignment\", \"torquer_scale\", \"K0\", "
                      "\"K1\", \"dP\", \"dO\"]\n",
                      latitude_deg),
          "study.toml"),
      "study.toml");
}

const double truth_deg = case_unit::site.latitude / unit::deg.to_si;

diagnosis::Diagnosis diagnosed(const mc::Study& study, const Recording& recording) {
  return diagnose_case(study, identify_case(study, recording));
}

TEST(CaseLatitude, AWrongOneIsSaidAndNoDriftIsNamedForIt) {
  const Recording recording = strapdown_recording(case_unit::script(41), case_unit::sensors());
  EXPECT_FALSE(identify_case(study_at(truth_deg), recording).latitude);
  // Near, on the other hemisphere, and so far off that the gyros do not seem to see the Earth.
  for (const double latitude : {truth_deg - 1.0, -truth_deg, 70.0}) {
    const mc::Study study = study_at(latitude);
    const CaseIdentification id = identify_case(study, recording);
    ASSERT_TRUE(id.latitude) << latitude;
    EXPECT_LT(std::abs(id.latitude->latitude - case_unit::site.latitude), 4.0 * id.latitude->sigma)
        << latitude;
    EXPECT_LT(id.latitude->sigma, 0.3 * unit::deg.to_si);
    EXPECT_EQ(id.latitude->mirrored, latitude < 0.0);
    const diagnosis::Diagnosis d = diagnose_case(study, id);
    EXPECT_TRUE(d.wrong_study()) << latitude;
    EXPECT_TRUE(d.site_doubt && d.site_doubt->alone()) << latitude;
  }
}

/// Drift with the input axis that all gyros have alike turns as the Earth does about Up; with it
/// the whole is not the Earth's.
TEST(CaseLatitude, DriftThatFollowsGravityIsNone) {
  Theta theta = case_unit::sensors();
  for (const char* key : {"D_I_x", "D_I_y", "D_I_z"}) test::set(theta, key, 3.0);
  const diagnosis::Diagnosis d =
      diagnosed(study_at(truth_deg), strapdown_recording(case_unit::script(42), theta));
  EXPECT_FALSE(d.site_doubt || d.other_latitude);
  EXPECT_EQ(d.verdict, diagnosis::Verdict::named);
  ASSERT_FALSE(d.causes.empty());
  EXPECT_EQ(d.causes.front().term, "g_drift");
}

/// The latitudes that are doubted of units at the declared one. The rule allows one in a thousand.
int doubted(std::uint64_t first, std::uint64_t last) {
  const mc::Study study = study_at(truth_deg);
  int count = 0;
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    test::StrapdownScript unit = case_unit::script(seed);
    Theta theta = test::drawn_unit(study.filters.front(), seed);
    if (seed % 3 == 0)  // drift that follows gravity and is in no model, of usual sizes
      for (const char* key : {"D_I_x", "D_I_y", "D_I_z", "D_O_x", "D_S_y"})
        test::set(theta, key, 0.2 * static_cast<double>(seed % 7));
    count += identify_case(study, strapdown_recording(unit, theta)).latitude ? 1 : 0;
    // A consumer's, by gyros that see the Earth, feel it, and do not.
    unit.rest = 8.0;
    unit.turn = 2.5;
    unit.gyro_noise = std::array{3e-5, 1e-4, 3e-4, 9e-4}[seed % 4];
    const Theta cheap = test::drawn_unit(study.filters.front(), seed, consumer_prior);
    count += identify_case(study, strapdown_recording(unit, cheap)).latitude ? 1 : 0;
  }
  return count;
}

TEST(CaseLatitude, OfFourUnitsOfEitherKindNoneIsDoubted) {
  EXPECT_EQ(doubted(61, 64), 0);
}

TEST(CaseLatitudeNightly, OfFortyUnitsOfEitherKindNoneIsDoubted) {
  EXPECT_EQ(doubted(101, 140), 0);
}

TEST(CaseLatitude, OfPsinsIsThatOfItsMaker) {
  NEEDS_RECORDING("psins19.csv");
  mc::Study study = mc::read_study(DRIFT_SOURCE_DIR "/configs/strapdown_psins.toml");
  const Recording recording =
      read_recording(test::path_of("psins19.csv"), RecordingKind::strapdown, study.site.gravity);
  for (const double latitude : {-34.0, 33.5}) {
    study.site.latitude = latitude * unit::deg.to_si;
    const auto found = identify_case(study, recording).latitude;
    ASSERT_TRUE(found) << latitude;
    EXPECT_LT(std::abs(found->latitude - 34.0 * unit::deg.to_si), 3.0 * found->sigma) << latitude;
    EXPECT_LT(found->sigma, 0.02 * unit::deg.to_si);
  }
}

}  // namespace
}  // namespace drift::strapdown::case_latitude_test
