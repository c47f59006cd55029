// The same kind of error in two gyros, in different directions: no candidate has just these, and
// the pair is weighed as any other.
#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::diagnosis::two_gyros_test {
namespace {

using namespace drift::test;

/// 24 free positions of a unit with two values of the mass unbalance [deg/h/g], of which the
/// nominal model knows nothing.
Diagnosis of_unbalance(std::uint64_t seed, const char* one, double value, const char* other,
                       double other_value) {
  const Timeline timeline = preset_timeline("twentyfour", CommandLaw::free, 1800.0, 120.0);
  const TruthSpec truth = base_truth(Coupling::eq6);
  const Readout readout;
  TruthDraw draw = draw_truth(truth, timeline.chains, seed, 0);
  const ParamMask unbalance = params_named("g_drift");
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    if (unbalance[i]) draw.theta[static_cast<Eigen::Index>(i)] = 0.0;
  draw.theta[param(one)] = value * TermLibrary::specs[param(one)].unit.to_si;
  draw.theta[param(other)] = other_value * TermLibrary::specs[param(other)].unit.to_si;
  const Measurements measured = Simulator(truth, readout).run(timeline, draw, seed, 0).measured;
  FilterSpec filter = base_filter(Coupling::eq6);
  filter.active &= ~unbalance;
  DiagnoseOptions options;
  options.folds = FoldMethod::linear;
  options.whiteness_draws = 0;
  return diagnose(filter, {timeline, readout, measured}, {}, {}, options);
}

/// The axes of the most probable set of causes, all of them of the unbalance; else what it is.
std::string axes_of(const Diagnosis& d) {
  std::vector<std::string> axes;
  for (const search::Cause& cause : d.causes)
    if (cause.set == 0) axes.push_back(cause.term == "g_drift" ? cause.axis : cause.term);
  std::ranges::sort(axes);
  std::string text;
  for (const std::string& axis : axes) text += axis;
  return text;
}

TEST(TwoGyros, WithUnbalanceInDifferentDirectionsAreBothNamed) {
  const Diagnosis a = of_unbalance(5, "D_O_x", 0.05, "D_I_z", -0.04);
  EXPECT_EQ(axes_of(a), "xz") << report::sentence(a);
  const Diagnosis b = of_unbalance(9, "D_S_x", 0.05, "D_I_y", 0.03);
  EXPECT_EQ(axes_of(b), "xy") << report::sentence(b);
}

TEST(TwoGyros, OfOneGyroItStaysOneCause) {
  const Diagnosis d = of_unbalance(6, "D_I_x", 0.05, "D_O_x", 0.04);
  EXPECT_EQ(axes_of(d), "x") << report::sentence(d);
}

}  // namespace
}  // namespace drift::diagnosis::two_gyros_test
