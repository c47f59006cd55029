// Nothing is missing but a right prior: it is told so, with the value that the test has.
#include <gtest/gtest.h>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::diagnosis::wrong_prior_test {
namespace {

using namespace drift::test;

/// A diagnosis of a unit of the nominal model, of one of whose parameters so much more was believed
/// than it has.
struct WrongBelief {
  std::size_t i;
  double truth = 0.0, sigma = 0.0;
  Diagnosis d;

  WrongBelief(const char* key, double off, double believed_sigma) : i(param(key)) {
    const double unit = TermLibrary::specs[i].unit.to_si;
    const Timeline timeline = preset_timeline("twelve", CommandLaw::free, 1800.0, 300.0);
    const TruthSpec unit_of_test = base_truth(Coupling::eq6);
    const Readout readout;
    const TruthDraw draw = draw_truth(unit_of_test, timeline.chains, 11, 0);
    truth = draw.theta[static_cast<Eigen::Index>(i)];
    sigma = believed_sigma * unit;
    FilterSpec filter = base_filter(Coupling::eq6);
    filter.priors[i] = normal(truth + off * unit, sigma);
    const Measurements measured =
        Simulator(unit_of_test, readout).run(timeline, draw, 11, 0).measured;
    DiagnoseOptions options;
    options.folds = FoldMethod::linear;
    options.whiteness_draws = 0;
    d = diagnose(filter, {timeline, readout, measured}, {}, {}, options);
  }
};

void expect_told(const WrongBelief& w, const std::string& key) {
  const std::string said = report::diagnosis_in_brief(w.d).verdict;
  const auto* beyond = remark_in<remark::BeyondPrior>(w.d);
  ASSERT_NE(beyond, nullptr) << said;
  EXPECT_TRUE(beyond->explains) << said;
  ASSERT_EQ(beyond->parameters.size(), 1u) << said;
  const ParameterEstimate& e = beyond->parameters.front().estimate;
  EXPECT_EQ(e.param, w.i);
  EXPECT_LT(std::abs(e.value - w.truth), 4.0 * e.sigma) << "one of a few: 6e-5 each";
  EXPECT_NE(said.find("the prior of " + key + ": with more room"), std::string::npos) << said;
  EXPECT_FALSE(w.d.proposal) << "of what is explained no form is offered";
  EXPECT_NE(report::diagnosis_in_brief(w.d).next.find("correct the prior of " + key),
            std::string::npos);
}

TEST(WrongPrior, OfAnAccelerometerIsToldWhereAnEffectCouldTakeItUp) {
  for (const double off : {300.0, -5000.0}) {  // ug: 15 and 250 times as sure as it is right
    SCOPED_TRACE(off);
    expect_told(WrongBelief("K0_x", off, 20.0), "K0_x");
  }
}

TEST(WrongPrior, ThatHoldsItsParameterBackIsToldAsWell) {
  expect_told(WrongBelief("K1_x", 5000.0, 20.0), "K1_x");  // ppm
}

TEST(WrongPrior, OfAGyroIsToldWhereTheTestIsFitted) {
  const WrongBelief w("D_I_z", -4.5, 0.1);
  EXPECT_EQ(w.d.verdict, Verdict::consistent);
  expect_told(w, "D_I_z");
}

TEST(WrongPrior, IsNoneWhereAllAreRight) {
  const WrongBelief w("K0_x", 10.0, 20.0);
  EXPECT_EQ(w.d.verdict, Verdict::consistent);
  EXPECT_EQ(remark_in<remark::BeyondPrior>(w.d), nullptr);
}

}  // namespace
}  // namespace drift::diagnosis::wrong_prior_test
