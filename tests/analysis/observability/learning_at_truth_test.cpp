#include "analysis/observability/learning_at_truth.hpp"

#include <gtest/gtest.h>

#include "analysis/observability/ranking.hpp"
#include "core/estimate/closure/closure_posterior.hpp"
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

TEST(LearningAtTruth, OfLambdaIsWhatEstimatesScatterBy) {
  // Over truths of the prior and their data the mean of the variances is that of squared errors;
  // a test without noise stands for those with it.
  constexpr std::size_t runs = 100;
  TruthSpec truth = with_lambda(base_truth(Coupling::lambda));
  const FilterSpec filter = with_lambda(base_filter(Coupling::lambda));
  RankedModel m = model_of(filter);
  const Timeline timeline = lay_out(few_slews(), in_the_south);
  double more = 0.0, square = 0.0, of_a_point = 0.0, of_the_valley = 0.0;
  for (std::size_t run = 0; run < runs; ++run) {
    const Simulation sim = Simulator(truth, m.readout).run(timeline, 5, run);
    m.nominal = sim.draw.theta;
    const MeasuredTest test{timeline, m.readout, sim.measured};
    const EstimateResult e =
        over_closure(filter, test, fit_batch(filter, test, make_layout(filter).theta));
    const std::vector<double> ratios = learning_at_truth(few_slews(), m);
    const Ranking linear = rank_parameters(linearise(few_slews(), m));
    double off = 0.0;
    for (std::size_t k = 0; k < ratios.size(); ++k) {
      const ParameterEstimate& p = e.parameters[k];
      if (TermLibrary::owner(p.param).key != "gyro_misalignment") continue;
      off += ratios[k] * ratios[k] - std::pow((p.value - m.nominal[p.param]) / p.prior_sigma, 2);
      of_the_valley += ratios[k] * ratios[k] / runs;
      of_a_point += std::pow(linear.learning_ratio(k), 2) / runs;
    }
    more += off / runs;
    square += off * off / runs;
  }
  const double of_the_mean = std::sqrt((square - more * more) / runs);
  std::printf("variances %.3f, %.3f +- %.3f more than squared errors; by information %.3f\n",
              of_the_valley, more, of_the_mean, of_a_point);
  EXPECT_NEAR(more, 0.0, 4.0 * of_the_mean);
  EXPECT_LT(of_the_mean, 0.15 * of_the_valley);
}

}  // namespace
}  // namespace drift::observability::learning_at_truth_test
