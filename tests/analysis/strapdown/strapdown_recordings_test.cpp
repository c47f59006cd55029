// The real recordings of ../shared/recordings, where that folder is there. Expected are the numbers
// of an independent analysis, written in the README beside them.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "analysis/strapdown/identify.hpp"
#include "tests/support/recordings_by_others.hpp"

namespace drift::strapdown_recordings_test {
namespace {

using strapdown::Trial;
using strapdown::Verdict;

const strapdown::StrapdownResult& identified(const std::string& name) {
  static std::map<std::string, strapdown::StrapdownResult> results;
  const auto known = results.find(name);
  if (known != results.end()) return known->second;
  const auto recording = read_recording(test::path_of(name), RecordingKind::strapdown, 9.80665);
  return results.emplace(name, strapdown::identify_strapdown(recording, {})).first->second;
}

const strapdown::Trial& trial(const std::vector<strapdown::Trial>& trials, std::string_view name,
                              std::string_view equation = "any") {
  const auto at = std::find_if(trials.begin(), trials.end(), [&](const strapdown::Trial& t) {
    return t.name == name && t.equation == equation;
  });
  if (at == trials.end()) throw std::runtime_error("not tried: " + std::string(name));
  return *at;
}

constexpr double share = 0.15;  // by which dwell bounds, folds and seeds may move a number

TEST(StrapdownRecordings, XsensDwells) {
  NEEDS_RECORDING("xsens_mti.csv");
  const auto& dwells = identified("xsens_mti.csv").search.dwells;
  ASSERT_EQ(dwells.size(), 38u);
  EXPECT_NEAR(dwells[0].duration(), 51.9, share * 51.9);
  std::vector<double> lengths;
  for (const auto& d : dwells) lengths.push_back(d.duration());
  std::sort(lengths.begin(), lengths.end());
  EXPECT_NEAR(lengths[19], 8.2, share * 8.2);
}

TEST(StrapdownRecordings, XsensAccelerometers) {
  NEEDS_RECORDING("xsens_mti.csv");
  const auto& trials = identified("xsens_mti.csv").accelerometer_trials;
  EXPECT_NEAR(trial(trials, "bias + scale").gravity->held_out, 0.0382, share * 0.0382);
  const strapdown::Trial& misaligned = trial(trials, "bias + scale + misalignment");
  EXPECT_NEAR(misaligned.gravity->held_out, 0.0016, share * 0.0016);
  EXPECT_EQ(misaligned.verdict, strapdown::Verdict::accepted);
  const strapdown::Trial& quadratic = trial(trials, "bias + scale + misalignment + quadratic");
  EXPECT_EQ(quadratic.verdict, strapdown::Verdict::rejected);
  EXPECT_GT(quadratic.gravity->held_out, misaligned.gravity->held_out);
}

TEST(StrapdownRecordings, XsensDriftInDwells) {
  NEEDS_RECORDING("xsens_mti.csv");
  const auto& trials = identified("xsens_mti.csv").gyro_trials;
  const std::string base = "bias + scale + misalignment";
  EXPECT_NEAR(trial(trials, "bias").dwell->held_out, 0.0724, share * 0.0724);
  const strapdown::Trial& input_axis = trial(trials, base + " + input-axis g-drift", "eq5");
  EXPECT_NEAR(input_axis.dwell->held_out, 0.073, share * 0.073);
  EXPECT_EQ(input_axis.verdict, strapdown::Verdict::rejected);
  EXPECT_NEAR(trial(trials, base + " + g-drift", "eq5").dwell->held_out, 0.0173, share * 0.0173);
  const strapdown::Trial& second = trial(trials, base + " + g-drift + g^2-drift", "eq5");
  EXPECT_GT(second.dwell->held_out, 0.0178);
  EXPECT_EQ(second.verdict, strapdown::Verdict::rejected);
}

TEST(StrapdownRecordings, XsensRotations) {
  NEEDS_RECORDING("xsens_mti.csv");
  const auto& result = identified("xsens_mti.csv");
  const auto& trials = result.gyro_trials;
  const std::string base = "bias + scale + misalignment";
  EXPECT_NEAR(trial(trials, "bias").rotation->held_out, 3.34, share * 3.34);
  EXPECT_NEAR(trial(trials, "bias + scale").rotation->held_out, 3.46, share * 3.46);
  EXPECT_NEAR(trial(trials, base, "eq5").rotation->held_out, 0.538, share * 0.538);
  EXPECT_NEAR(trial(trials, base + " + g-drift", "eq5").rotation->held_out, 0.142, share * 0.142);
  EXPECT_EQ(result.accepted[0].name, base + " + g-drift");
  // Eq. (6) does no better with misalignment than without.
  EXPECT_EQ(trial(trials, base, "eq6").rotation->errors,
            trial(trials, "bias + scale").rotation->errors);
  EXPECT_GT(result.contest[0].z, 5.0);
}

TEST(StrapdownRecordings, XsensMisalignmentTheOtherWayRoundIsTwiceAsWrong) {
  NEEDS_RECORDING("xsens_mti.csv");
  using namespace strapdown;
  const auto& result = identified("xsens_mti.csv");
  const auto recording =
      read_recording(test::path_of("xsens_mti.csv"), RecordingKind::strapdown, 9.80665);
  const auto& fitted = result.accepted[0].fitted;
  Theta inverse = fitted.turning.theta;
  for (const auto& g : {group<"eta">(), group<"xi">()})
    for (const std::size_t p : g) inverse[p] = -inverse[p];
  const strapdown::SpecificForce force(fitted.accelerometer.theta);
  std::vector<double> errors;
  for (const strapdown::Rotation& turn :
       strapdown::find_rotations(strapdown::signals_of(recording), result.search.dwells).all)
    errors.push_back(strapdown::prediction_error(
        strapdown::calibrated(turn, result.search.dwells, force), Coupling::eq5, inverse));
  EXPECT_NEAR(strapdown::root_mean_square(errors) / detail::deg, 6.7, share * 6.7);
}

TEST(StrapdownRecordings, MpuHasMisalignmentAndNoGSensitivityToClaim) {
  for (const char* name : {"mpu9150_0.csv", "mpu9150_1.csv"}) {
    NEEDS_RECORDING(name);
    const auto& result = identified(name);
    EXPECT_NEAR(static_cast<double>(result.search.dwells.size()), 20.0, 3.0);
    EXPECT_EQ(result.accepted[0].name.substr(0, 5), "bias ");
    EXPECT_NE(result.accepted[0].name.find("misalignment"), std::string::npos) << name;
    EXPECT_EQ(result.accepted[0].name.find("drift"), std::string::npos) << name;
    EXPECT_GT(result.contest[0].eq6.held_out, 1.8 * result.contest[0].eq5.held_out) << name;
    for (const auto& p : result.parameters) {
      EXPECT_NE(p.key.substr(0, 3), "D_I") << name;
      EXPECT_NE(p.key.substr(0, 3), "D_O") << name;
      EXPECT_NE(p.key.substr(0, 3), "D_S") << name;
    }
  }
}

}  // namespace
}  // namespace drift::strapdown_recordings_test
