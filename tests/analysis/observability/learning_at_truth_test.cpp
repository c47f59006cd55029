#include "analysis/observability/learning_at_truth.hpp"

#include <gtest/gtest.h>

#include "analysis/observability/ranking.hpp"
#include "tests/support/few_slews.hpp"

namespace drift::observability::learning_at_truth_test {
namespace {

using namespace drift::test;

RankedModel model_of(const ModelSpec& spec) {
  RankedModel m = ranked_model(spec, nullptr, in_the_south,
                               {.accelerometer_noise = 3e-5, .gimbal_noise = 8.0 * arcsec});
  m.nominal = draw_parameters(spec, 3, 0, Purpose::parameters);
  return m;
}

TEST(LearningAtTruth, IsThatOfTheInformationWhereNoLambdaIsEstimated) {
  const RankedModel m = model_of(base_filter(Coupling::eq5));
  const Ranking linear = rank_parameters(linearise(few_slews(), m));
  const std::vector<double> ratios = learning_at_truth(few_slews(), m);
  for (std::size_t k = 0; k < ratios.size(); ++k) EXPECT_EQ(ratios[k], linear.learning_ratio(k));
}

TEST(LearningAtTruth, OfLambdaIsWhatIsLeftInTheWholeValley) {
  const ModelSpec spec = with_lambda(base_filter(Coupling::lambda));
  const RankedModel m = model_of(spec);
  const Ranking linear = rank_parameters(linearise(few_slews(), m));
  const std::vector<double> ratios = learning_at_truth(few_slews(), m);
  double of_the_valley = 0.0, of_a_point = 0.0;  // of the misalignments, squared
  for (std::size_t k = 0; k < ratios.size(); ++k) {
    EXPECT_LE(ratios[k], 1.1) << k;  // a posterior may be wider than the prior, by little
    if (TermLibrary::owner(linear.layout.params[k]).key != "gyro_misalignment") continue;
    of_the_valley += ratios[k] * ratios[k];
    of_a_point += std::pow(linear.learning_ratio(k), 2);
  }
  // Of six misalignments and lambda the three positions show six products: along the valley all
  // may be scaled together.
  EXPECT_GT(of_the_valley, 1.5 * of_a_point);
}

}  // namespace
}  // namespace drift::observability::learning_at_truth_test
