// A platform with magnetic drift in a field that nobody measured, and that is not a dipole's.
#include "analysis/diagnosis/doubts/unknown_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/identification/field_found.hpp"
#include "analysis/identification/identify.hpp"
#include "analysis/preparation/assumed_field.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::diagnosis::unknown_field_test {
namespace {

const double gauss = covariate("field").unit.to_si;
const double M_unit = test::deg_per_h / gauss;

/// Twelve positions of an hour and their study, which declares no field.
struct Scene {
  mc::Study study;
  Recording recording;

  /// M_x [deg/h/gauss], the field [gauss].
  Scene(double M_x, const Vec3& field_gauss) : study(test::six_study(3600.0, 120.0)) {
    PlanDefaults defaults;
    defaults.dwell = 3600.0;
    defaults.sample = 120.0;
    study.plan = preset_plan("twelve", defaults).value();
    mc::Study there = with_field(study, field_gauss * gauss);
    there.truth.active |= test::only({"M_x"});
    Timeline timeline = lay_out(there.plan, there.site);
    set_environment(timeline, there.environment, 1, 0);
    TruthDraw draw = draw_truth(study.truth, timeline.chains, 1, 0);
    draw.theta[test::param("M_x")] = M_x * M_unit;
    recording = make_recording(
        timeline, Simulator(there.truth, there.readout).run(timeline, draw, 1, 0).measured,
        there.readout);
    std::erase_if(recording.channels, [](const Channel& c) { return c.name.starts_with("field"); });
  }
};

TEST(FieldFound, DirectionComesFromTheRecordingAndStrengthFromWhatIsKnownOfTheEarth) {
  const Vec3 truth(0.25, 0.06, -0.47);
  const Scene s(0.04, truth);
  const auto found = identification::field_found(s.study, {s.recording}, s.study.filters.front());
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->assumed_l.isApprox(preparation::dipole_field_l(s.study.site.latitude)));
  const Vec3 field = found->field_l / gauss;
  const Mat3 covariance = found->covariance / (gauss * gauss);
  // All three at once: chi-square of three degrees, 21 in one of 10^4.
  const Vec3 off = field - truth;
  EXPECT_LT(off.dot(covariance.inverse() * off), 21.0) << field.transpose();
  // Where the gyro's axis goes through North and West, the two are known against each other.
  const double slope = field.y() / field.x();
  const Vec3 of_slope(-slope / field.x(), 1.0 / field.x(), 0.0);
  const double sigma = std::sqrt(of_slope.dot(covariance * of_slope));
  EXPECT_LT(sigma, 0.05);
  EXPECT_NEAR(slope, truth.y() / truth.x(), 4.0 * sigma);
  // No recording tells a strong field from a large effect.
  const double spread = preparation::beside_dipole / gauss;
  EXPECT_NEAR(std::sqrt(covariance(0, 0)), spread, 0.05 * spread);
  EXPECT_TRUE(found->another()) << found->log_evidence;
}

TEST(FieldFound, AnErrorOfTheFieldIsOneOfTheSizeInInverseProportion) {
  const Scene s(0.03, Vec3(0.25, 0.0, -0.47));
  const auto found = identification::field_found(s.study, {s.recording}, s.study.filters.front());
  ASSERT_TRUE(found);
  // Seen is the product of size and horizontal field: their relative errors are one.
  const double size = 0.03 * M_unit * 0.25 * gauss / found->field_l.x();
  const double expected = size * std::sqrt(found->covariance(0, 0)) / found->field_l.x();
  EXPECT_NEAR(found->sigma_of(test::param("M_x")), expected, 0.1 * expected);
  EXPECT_EQ(found->sigma_of(test::param("D_F_x")), 0.0);
}

TEST(FieldFound, WhereNothingFollowsItNothingIsLearned) {
  const Scene s(0.0, Vec3(0.25, 0.03, -0.47));
  const auto found = identification::field_found(s.study, {s.recording}, s.study.filters.front());
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->log_evidence, 0.0, 0.1);
  const Vec3 sigmas = found->covariance.diagonal().cwiseSqrt();
  EXPECT_LT((found->field_l - found->assumed_l).cwiseQuotient(sigmas).norm(), 4.0);
}

/// The first filter of a study with M_x in its model, its estimates from one start.
identification::Identification identified_with_M_x(mc::Study study, const Recording& recording) {
  study.filters.resize(1);
  study.filters.front().active |= test::only({"M_x"});
  study.filters.front().starts.clear();
  study.filters.front().drawn_starts = 1;
  return identification::identify_recordings(study, {recording}, 1);
}

TEST(ConsideredField, IsInTheSigmaAsMuchAsAnotherFieldChangesTheEstimate) {
  const double truth = 0.03 * M_unit;
  const Scene s(0.03, Vec3(0.25, 0.06, -0.47));
  const auto id = identified_with_M_x(s.study, s.recording);
  ASSERT_TRUE(id.summaries.front().field_considered);
  const std::size_t M_x = test::param("M_x");
  const auto estimate = [&](const identification::Identification& of) {
    return *of.runs.front().batch.estimate.find(M_x);
  };
  // The same by declared fields, a tenth of a sigma to both sides.
  const Vec3 dipole_l = preparation::dipole_field_l(s.study.site.latitude);
  const auto at = [&](const Vec3& field_l) {
    const auto other = identified_with_M_x(with_field(s.study, field_l), s.recording);
    EXPECT_FALSE(other.summaries.front().field_considered);
    return estimate(other);
  };
  double squares = std::pow(at(dipole_l).sigma, 2);
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 step = 0.1 * preparation::beside_dipole * Vec3::Unit(axis);
    squares += std::pow((at(dipole_l + step).value - at(dipole_l - step).value) / 0.2, 2);
  }
  const ParameterEstimate found = estimate(id);
  EXPECT_NEAR(found.sigma, std::sqrt(squares), 0.05 * found.sigma);
  // With the dipole's field alone the estimate is wrong and sure of it.
  EXPECT_GT(std::abs(found.value - truth), 5.0 * at(dipole_l).sigma);
  EXPECT_LT(std::abs(found.value - truth), 3.0 * found.sigma);
  // Both estimators, and sigma and covariance, agree.
  const identification::FilterRun& run = id.runs.front();
  EXPECT_NEAR(run.ekf.find(M_x)->sigma, found.sigma, 0.1 * found.sigma);
  for (std::size_t k = 0; k < run.ekf.parameters.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const ParameterEstimate& p = run.batch.estimate.parameters[k];
    EXPECT_NEAR(p.sigma, p.prior_sigma * std::sqrt(run.batch.estimate.covariance(i, i)),
                1e-9 * p.prior_sigma);
  }
}

class UnknownField : public ::testing::Test {
 protected:
  static DiagnoseOptions options() {
    DiagnoseOptions o;
    o.starts = 1;
    o.whiteness_draws = 0;
    o.profiles = Profiles::left_out;
    return o;
  }
};

TEST_F(UnknownField, ItsErrorIsInTheIntervalAndHidesNoEffectThatFollowsIt) {
  const double truth = 0.02;
  const Scene s(truth, Vec3(0.25, 0.06, -0.47));
  const Diagnosis first = diagnose(s.study, {s.recording}, options());
  const auto size = [](const Diagnosis& d) {
    const auto found = std::ranges::find(d.causes, "magnetic_drift", &search::Cause::term);
    return found == d.causes.end() ? search::CauseParameter{} : found->parameters.front();
  };
  // With a dipole's field, which heads due North, something else is named without a doubt.
  EXPECT_EQ(first.verdict, Verdict::named) << report::sentence(first);
  EXPECT_EQ(size(first).key, "") << report::sentence(first);

  const Diagnosis d = with_error_of_field(first, s.study, {s.recording}, options());
  ASSERT_TRUE(d.field) << report::sentence(d);
  ASSERT_EQ(size(d).key, "M_x") << report::sentence(d);
  EXPECT_LT(size(d).low(), truth);
  EXPECT_GT(size(d).high(), truth);
  EXPECT_NE(report::sentence(d).find("The magnetic field was not measured"), std::string::npos)
      << report::sentence(d);
}

TEST_F(UnknownField, ADeclaredOneIsTaken) {
  Scene s(0.03, Vec3(0.25, 0.0, -0.47));
  s.study = with_field(std::move(s.study), Vec3(0.25, 0.0, -0.47) * gauss);
  const Diagnosis d = with_error_of_field(diagnose(s.study, {s.recording}, options()), s.study,
                                          {s.recording}, options());
  EXPECT_FALSE(d.field);
}

}  // namespace
}  // namespace drift::diagnosis::unknown_field_test
