// What a filter says its noise is, by its keys or by its terms.
#include <gtest/gtest.h>

#include "analysis/identification/identify.hpp"
#include "analysis/search/fitted.hpp"
#include "core/estimate/layout.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::filter_noise_test {
namespace {

using namespace drift::test;

/// A filter of these terms, their parameters at the library's priors.
FilterSpec filter_with(std::initializer_list<const char*> terms) {
  FilterSpec filter;
  for (const char* key : terms) {
    const TermInfo& term = TermLibrary::terms[*TermLibrary::find_term(key)];
    for (std::size_t i = term.first; i < term.first + term.count; ++i) {
      filter.active.set(i);
      filter.priors[i] = TermLibrary::specs[i].prior_si();
    }
  }
  return filter;
}

TEST(DeclaredNoiseOfAFilter, IsTheSameByKeyAndByTerm) {
  FilterSpec by_term = filter_with({"fixed_drift", "drift_random_walk"}),
             by_key = filter_with({"fixed_drift"});
  by_key.noise.drift_random_walk = 0.003 * unit::deg_per_h_per_sqrt_h.to_si;
  for (const char* q : {"q_x", "q_y", "q_z"})
    by_term.priors[*TermLibrary::find(q)] = fixed(by_key.noise.drift_random_walk);
  const inference::NoiseModel term = search::declared_noise(by_term),
                              key = search::declared_noise(by_key);
  EXPECT_NEAR(term.drift_random_walk, key.drift_random_walk, 1e-15 * key.drift_random_walk);
  EXPECT_TRUE(term.gyros.isApprox(key.gyros, 1e-14));
  EXPECT_TRUE(term.driven());
}

TEST(DeclaredNoiseOfAFilter, GivesEachGyroItsOwnWalk) {
  FilterSpec filter = filter_with({"fixed_drift", "drift_random_walk"});
  const Vec3 q = Vec3(1.0, 2.0, 5.0) * 1e-3 * unit::deg_per_h_per_sqrt_h.to_si;
  for (int k = 0; k < 3; ++k)
    filter.priors[TermLibrary::index("q_x") + static_cast<std::size_t>(k)] = fixed(q[k]);
  const inference::NoiseModel m = search::declared_noise(filter);
  EXPECT_TRUE((m.drift_random_walk * m.gyros).isApprox(q, 1e-14));
}

TEST(DeclaredNoiseOfAFilter, TakesTwoLevelsForAMarkovProcessOfTheSameCorrelation) {
  FilterSpec filter = filter_with({"fixed_drift", "bistable_drift"});
  const double B = 0.02 * unit::deg_per_h.to_si;
  for (const char* key : {"B_x", "B_y", "B_z"}) filter.priors[*TermLibrary::find(key)] = fixed(B);
  const inference::NoiseModel m = search::declared_noise(filter);
  EXPECT_NEAR(m.markov_drift, B, 1e-14 * B);
  EXPECT_EQ(m.markov_tau, 1200.0);  // half of the 40 min that a level lasts
}

TEST(DeclaredNoiseOfAFilter, WhereItMovesTheDriftTheBatchFitDoesNotCount) {
  identification::FilterRun run;
  run.ekf.statistic = 1.0;
  run.batch.estimate.statistic = 2.0;
  const auto counts = [&](const FilterSpec& filter) {
    return &identification::judged(filter, run) == &run.ekf ? "ekf" : "batch";
  };
  FilterSpec plain = filter_with({"fixed_drift"});
  EXPECT_STREQ(counts(plain), "batch");
  EXPECT_STREQ(counts(filter_with({"fixed_drift", "drift_random_walk"})), "ekf");
  EXPECT_STREQ(counts(filter_with({"fixed_drift", "bistable_drift"})), "ekf");
  plain.noise.angle_random_walk = 1e-6;  // the batch fit whitens it
  EXPECT_STREQ(counts(plain), "batch");
}

}  // namespace
}  // namespace drift::filter_noise_test
