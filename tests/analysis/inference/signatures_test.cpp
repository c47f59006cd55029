// Columns of candidates taken over from a fit nearby.
#include "analysis/inference/signatures.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/inference/candidate.hpp"
#include "analysis/inference/thresholds.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"
#include "tests/support/term_scenes.hpp"

namespace drift::inference::signatures_test {
namespace {

/// A fit, and the same with the gyros turned by so much; the columns there, worked out anew and
/// with those of the fit known.
struct TurnedBy {
  std::vector<SignatureSpec> specs;  ///< there
  MatX before, fresh, taken;

  explicit TurnedBy(double angle) {
    const Timeline timeline = test::scene("twelve", CommandLaw::level);
    FilterSpec filter = test::base_filter(Coupling::eq5);
    TruthSpec truth = test::base_truth(Coupling::eq5);
    filter.active = truth.active = test::only({"D_F", "D_I", "eta", "K0", "K1"});
    const Readout readout;
    const Measurements measured = Simulator(truth, readout).run(timeline, 3, 0).measured;
    const MeasuredTest test{timeline, readout, measured};
    const BatchResult fit = fit_batch(filter, test, make_layout(filter).theta);
    const auto specs_at = [&](const BatchResult& f) {
      return library_candidates(filter, theta_of(filter, f), timeline).signatures;
    };
    const std::vector<SignatureSpec> specs_before = specs_at(fit);
    before = linear_problem(filter, test, fit, specs_before).extra;
    const KnownSignatures known{filter, fit, specs_before, before};
    BatchResult turned = fit;
    for (ParameterEstimate& p : turned.estimate.parameters)
      if (p.param == test::param("eta_x")) p.value += angle;
    specs = specs_at(turned);
    fresh = linear_problem(filter, test, turned, specs).extra;
    taken = linear_problem(filter, test, turned, specs, &known).extra;
  }
};

TEST(Signatures, OfAFitNearbyAreThoseWorkedOutAnewToTheAngleBetween) {
  const TurnedBy t(0.5 * EffortLimits::turned);
  std::size_t same = 0;
  for (std::size_t k = 0; k < t.specs.size(); ++k) {
    SCOPED_TRACE(TermLibrary::specs[t.specs[k].param].key.view());
    const auto column = static_cast<Eigen::Index>(k);
    const double apart = (t.taken.col(column) - t.fresh.col(column)).norm();
    // Several times the angle where a term is not smooth (a dead zone); a column shorter than one
    // sigma of all rows shows nothing that could be told.
    EXPECT_LE(apart, 10.0 * EffortLimits::turned * std::max(1.0, t.fresh.col(column).norm()));
    same += t.taken.col(column) == t.before.col(column);
  }
  EXPECT_GT(same, t.specs.size() - 9);  // they were taken over
}

TEST(Signatures, OfLambdaGoWithTheMisalignmentsAndAreWorkedOutAnew) {
  const TurnedBy t(0.5 * EffortLimits::turned);
  const auto lambda = std::ranges::find(t.specs, closure_param, &SignatureSpec::param);
  ASSERT_NE(lambda, t.specs.end());
  const Eigen::Index column = lambda - t.specs.begin();
  // To the last bits: of more columns at once sums are made in another order.
  EXPECT_LT((t.taken.col(column) - t.fresh.col(column)).norm(), 1e-14 * t.fresh.col(column).norm());
  EXPECT_GT((t.taken.col(column) - t.before.col(column)).norm(), 0.1 * t.fresh.col(column).norm());
}

TEST(Signatures, OfAFitFarAwayAreWorkedOutAnew) {
  const TurnedBy t(2.0 * EffortLimits::turned);
  EXPECT_EQ(t.taken, t.fresh);
  EXPECT_NE(t.taken, t.before);
}

}  // namespace
}  // namespace drift::inference::signatures_test
