// Units whose gyros see the Earth, drawn from what is believed of them; and one that never moved.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "analysis/strapdown/case_diagnose.hpp"
#include "analysis/strapdown/case_identify.hpp"
#include "analysis/strapdown/sensed.hpp"
#include "tests/support/drawn_unit.hpp"
#include "tests/support/program.hpp"
#include "tests/support/pulls.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::strapdown::case_units_test {
namespace {

const std::string study_file = DRIFT_SOURCE_DIR "/configs/strapdown_psins.toml";

/// Without the cubic and cross terms of the accelerometers, which the simulator does not make.
mc::Study study_of_units() {
  mc::Study study = mc::read_study(study_file);
  FilterSpec& filter = study.filters.front();
  for (std::size_t p = 0; p < TermLibrary::num_params; ++p)
    if (const auto group = TermLibrary::specs[p].group.view(); group == "K3" || group == "K_ip")
      filter.active.reset(p);
  return study;
}

test::StrapdownScript script(const mc::Study& study, std::uint64_t seed) {
  test::StrapdownScript s;
  s.dwells = 16;
  s.rest = 20.0;
  s.turn = 8.0;
  s.gyro_noise = 3e-6;
  s.acc_noise = 1e-4;
  s.omega_ie_l = study.site.omega_ie_l();
  s.gravity = study.site.gravity;
  s.seed = seed;
  return s;
}

test::Pulls pulls_of_units(std::uint64_t first, std::uint64_t last) {
  const mc::Study study = study_of_units();
  test::Pulls pulls;
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    const Theta truth = test::drawn_unit(study.filters.front(), seed);
    const CaseStudy of = case_study(study, strapdown_recording(script(study, seed), truth));
    EXPECT_TRUE(of.compass.sees_earth) << seed;
    const FilterSpec filter = case_filter(study.filters.front(), of);
    const BatchResult fit = fit_batch(filter, of.measured(), start_of(filter, of));
    EXPECT_EQ(fit.estimate.status, EstimateStatus::ok) << seed;
    pulls.add(as_sensed(fit.estimate), truth);
  }
  return pulls;
}

/// A unit that stands askew for half an hour.
struct Resting {
  mc::Study study = mc::read_study(study_file);
  Mat3 attitude = rotation(Vec3(0.0, 0.0, 0.7)) * rotation(Vec3(0.035, -0.05, 0.0));
  Theta theta = Theta::Zero();

  Resting() {
    test::set(theta, "D_F_x", 0.2);
    test::set(theta, "D_F_y", -0.1);
    test::set(theta, "D_F_z", 0.1);
  }
  Recording recording() const {
    test::StrapdownScript s = script(study, 4);
    s.dwells = 1;
    s.rest = 1800.0;
    s.attitude = attitude;
    return strapdown_recording(s, theta);
  }
};

/// All that a rest can show: drift about the vertical by the latitude, of the horizontal drift what
/// is across to the North that the gyros show, a sum of the accelerometers' errors.
void expect_what_a_rest_shows(const Resting& unit, const CaseFit& fit) {
  bool vertical = false, horizontal = false;
  const auto drift = [&](char axis) {
    const std::size_t p = *TermLibrary::find(std::string("D_F_") + axis);
    return unit.theta[static_cast<Eigen::Index>(p)] / TermLibrary::specs[p].unit.to_si;
  };
  for (const StrapdownParameter& p : fit.parameters) {
    SCOPED_TRACE(p.key);
    for (const char* none : {"s_", "eta_", "xi_", "D_I", "D_O", "D_S"})
      EXPECT_EQ(p.key.find(none), std::string::npos);
    char one = 0, sign = 0, other = 0;
    double times = 0.0;
    double truth = 0.0;  // of accelerometers
    if (p.key == "D_F_z") {
      vertical = true;
      truth = drift('z');
    } else if (std::sscanf(p.key.c_str(), "D_F_%c %c %lf D_F_%c", &one, &sign, &times, &other) ==
               4) {
      horizontal = true;
      truth = drift(one) + (sign == '-' ? -times : times) * drift(other);
    } else {
      EXPECT_TRUE(p.key.starts_with("K0_z + ") || p.key.starts_with("K1_z + "));
    }
    EXPECT_LT(std::abs(p.value - truth), 4.0 * p.sigma) << p.value << " +- " << p.sigma;
    if (p.key.starts_with("D_F")) {
      EXPECT_LT(p.sigma, 0.1);
    }
  }
  EXPECT_TRUE(vertical && horizontal);
  EXPECT_LE(fit.parameters.size(), 3u);
}

void expect_half_an_hour(const Resting& unit, const Recording& recording) {
  const CaseStudy of = case_study(unit.study, recording);
  ASSERT_TRUE(of.compass.sees_earth);
  ASSERT_EQ(of.search.dwells.size(), 1u);
  EXPECT_TRUE(of.test.ways.empty()) << "a turn where there was none";
  const Vec3 up = unit.attitude.transpose() * Vec3::UnitZ();
  EXPECT_LT((of.search.dwells.front().acc.normalized() - up).norm(), 1e-5);
  const CaseIdentification id = identify_case(unit.study, of);
  expect_what_a_rest_shows(unit, id.fits.front());
  const diagnosis::Diagnosis d = diagnose_case(unit.study, id);
  EXPECT_EQ(d.verdict, diagnosis::Verdict::consistent);
  EXPECT_TRUE(d.causes.empty());

  const test::ScratchFolder folder;
  write_recording(recording, folder.file("rest.csv"));
  for (const char* command : {"identify", "diagnose"}) {
    const test::Answer answer = test::run_program(
        DRIFT_PROGRAM, fmt::format("{} {} {} -o {} --threads 1", command, study_file,
                                   folder.file("rest.csv"), folder.file(command)));
    EXPECT_EQ(answer.code, 0) << answer.err;
    const std::string said = answer.out + answer.err;
    for (const char* wrong : {"stuck", "saturated", "nan", "inf"})
      EXPECT_EQ(said.find(wrong), std::string::npos) << said;
    const bool identified = command == std::string("identify");
    for (const char* words :
         {"one rest of 1799 s and no turn", "1 of 30 parameters is learned, and 2 sums",
          "The gyros see the Earth: North to", "Up is x 2.8"})
      EXPECT_EQ(said.find(words) != std::string::npos, identified) << words << "\n" << said;
  }
}

}  // namespace

TEST(StrapdownUnits, ErrorsOfFiveUnitsAreAsLargeAsTheirSigmas) {
  test::expect_as_large_as_sigmas(pulls_of_units(1, 5));
}

TEST(StrapdownUnitsNightly, ErrorsOfFiftyUnitsAreAsLargeAsTheirSigmas) {
  test::expect_as_large_as_sigmas(pulls_of_units(101, 150));
}

TEST(StrapdownRest, OfHalfAnHourSaysDriftAsFarAsItShowsAndWhereUpAndNorthAre) {
  const Resting unit;
  expect_half_an_hour(unit, unit.recording());
}

/// Counts of an arc second and half a millimetre per second: a row holds one of them or none.
TEST(StrapdownRest, OfHalfAnHourInCountsSaysTheSame) {
  const Resting unit;
  expect_half_an_hour(
      unit, test::in_counts(unit.recording(), unit::arcsec.to_si, 5e-4 / unit.study.site.gravity));
}

}  // namespace drift::strapdown::case_units_test
