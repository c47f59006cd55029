#include "mc/task/unmodelled.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/estimate/layout.hpp"
#include "core/physics/stochastic.hpp"
#include "tests/mc/small_study.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::unmodelled_test {
namespace {

using namespace drift::test;

FilterSpec filter_with(std::initializer_list<std::string_view> terms, Coupling coupling) {
  FilterSpec filter = base_filter(coupling);
  filter.active.reset();
  for (const std::string_view term : terms) filter.active |= params_named(term);
  return filter;
}

/// Of the only message, or of none.
std::string refusal(mc::EstimatorKind estimator, const FilterSpec& filter) {
  const std::vector<std::string> messages = mc::unmodelled(estimator, filter);
  EXPECT_LE(messages.size(), 1u);
  return messages.empty() ? "" : messages.front();
}

void expect_said(const std::string& message, std::initializer_list<std::string_view> words) {
  for (const std::string_view word : words)
    EXPECT_NE(message.find(word), std::string::npos) << word << " in: " << message;
}

TEST(Unmodelled, BaseTermsAreModelledByEveryEstimator) {
  for (const Coupling coupling : {Coupling::eq5, Coupling::eq6})
    for (const auto& estimator : mc::estimators)
      EXPECT_EQ(refusal(estimator.value, base_filter(coupling)), "") << estimator.name;
}

TEST(Unmodelled, ProcessNoiseIsNotModelledByABatchFit) {
  for (const std::string_view term : {"drift_random_walk", "bistable_drift"}) {
    const FilterSpec filter = filter_with({"fixed_drift", term}, Coupling::eq6);
    expect_said(refusal(mc::EstimatorKind::batch, filter),
                {"filter \"filter\"", term, "\"batch\"", "(expected", "Set monte_carlo.estimator"});
    EXPECT_EQ(refusal(mc::EstimatorKind::ekf, filter), "");
    EXPECT_EQ(refusal(mc::EstimatorKind::iterated, filter), "");
  }
  FilterSpec filter = base_filter(Coupling::eq6);
  filter.noise = {.angle_random_walk = 1e-6, .drift_random_walk = 1e-9};
  const std::string said = refusal(mc::EstimatorKind::batch, filter);
  expect_said(said, {"'drift_random_walk'"});
  EXPECT_EQ(said.find("angle_random_walk"), std::string::npos);  // it is in the fit's weights
  EXPECT_EQ(refusal(mc::EstimatorKind::iterated, filter), "");
}

TEST(Unmodelled, IsInABatchFitWhateverLetsADriftVary) {
  for (std::size_t t = 0; t < TermLibrary::terms.size(); ++t) {
    const std::string_view term = TermLibrary::terms[t].key;
    const FilterSpec filter = filter_with({"fixed_drift", term}, Coupling::eq6);
    const TermMask terms = filter.model().terms;
    const double variance = drift_variance({}, terms, make_layout(filter).theta, 0, 60.0);
    EXPECT_EQ(drift_varies({}, terms), variance > 0.0) << term;
    const std::string said = refusal(mc::EstimatorKind::batch, filter);
    EXPECT_EQ(said.find(fmt::format("(term '{}')", term)) != std::string::npos, variance > 0.0)
        << term << ": " << said;
  }
}

TEST(Unmodelled, NoiseOfNoSizeIsNone) {
  FilterSpec filter = filter_with({"fixed_drift", "bistable_drift"}, Coupling::eq6);
  for (const char* key : {"B_x", "B_y", "B_z"}) filter.priors[param(key)] = fixed(0.0);
  EXPECT_EQ(refusal(mc::EstimatorKind::batch, filter), "");
}

TEST(Unmodelled, ADriftThatVariesMustBeEstimated) {
  FilterSpec filter = filter_with({"fixed_drift", "g_drift", "drift_random_walk"}, Coupling::eq6);
  filter.priors[param("D_F_y")] = fixed(0.0);
  for (const auto estimator : {mc::EstimatorKind::ekf, mc::EstimatorKind::iterated}) {
    expect_said(refusal(estimator, filter),
                {"drift_random_walk", "D_F_y", "(expected", "Add term"});
    FilterSpec still = filter;
    still.priors[param("q_y")] = fixed(0.0);  // the gyro whose drift is known has no noise
    EXPECT_EQ(refusal(estimator, still), "");
  }
}

TEST(Unmodelled, LambdaBesideMisalignmentsIsForTheBatchFit) {
  FilterSpec filter =
      filter_with({"fixed_drift", "gyro_misalignment", "frame_closure"}, Coupling::lambda);
  EXPECT_EQ(refusal(mc::EstimatorKind::batch, filter), "");
  for (const auto estimator : {mc::EstimatorKind::ekf, mc::EstimatorKind::iterated}) {
    expect_said(refusal(estimator, filter),
                {"lambda", "frame_closure", key_of(estimator), "Set monte_carlo.estimator"});
    FilterSpec known = filter;
    known.priors[param("lambda")] = fixed(0.5);
    EXPECT_EQ(refusal(estimator, known), "");
    known = filter;
    for (const char* group : {"eta", "xi"})
      for (const char axis : {'x', 'y', 'z'})
        known.priors[param(fmt::format("{}_{}", group, axis))] = fixed(1e-4);
    EXPECT_EQ(refusal(estimator, known), "");
  }
}

TEST(Unmodelled, IsRefusedBeforeTheFirstRunForEveryFilter) {
  try {
    const mc::StudyTask task(read_text(
        small_study, {{"monte_carlo.estimator", "batch"},
                      {"filter.right.terms", "[\"fixed_drift\", \"bistable_drift\"]"},
                      {"filter.wrong.terms", "[\"fixed_drift\", \"drift_random_walk\"]"}}));
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::config);
    ASSERT_EQ(error.messages().size(), 2u);
    expect_said(error.messages()[0], {"study.toml: ", "\"right\"", "bistable_drift"});
    expect_said(error.messages()[1], {"study.toml: ", "\"wrong\"", "drift_random_walk"});
  }
}

}  // namespace
}  // namespace drift::unmodelled_test
