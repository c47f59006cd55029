#include "analysis/diagnosis/advice/patched_study.hpp"

#include <gtest/gtest.h>

#include "core/base/check.hpp"
#include "tests/analysis/report/diagnosis/diagnosis_fixture.hpp"

namespace drift::diagnosis::patched_study_test {
namespace {

using test::nominal_study;
using test::read_text;

search::CauseParameter parameter(std::string_view key, double value, bool profiled = false) {
  const auto index = TermLibrary::find(key).value();
  return {std::string(key),
          index,
          value,
          0.01,
          std::string(TermLibrary::specs[index].unit.symbol.view()),
          profiled};
}

/// What a patched filter says must be what its file says.
void expect_same_model(const FilterSpec& read, const FilterSpec& meant) {
  EXPECT_EQ(read.active, meant.active);
  EXPECT_EQ(read.coupling, meant.coupling);
  EXPECT_EQ(read.name, meant.name);
  EXPECT_EQ(read.drawn_starts, meant.drawn_starts);
  EXPECT_DOUBLE_EQ(read.initial_attitude, meant.initial_attitude);
  EXPECT_DOUBLE_EQ(read.noise.angle_random_walk, meant.noise.angle_random_walk);
  EXPECT_DOUBLE_EQ(read.noise.drift_random_walk, meant.noise.drift_random_walk);
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i) {
    if (!meant.active[i]) continue;
    EXPECT_EQ(read.priors[i].kind, meant.priors[i].kind) << TermLibrary::specs[i].key.view();
    EXPECT_NEAR(read.priors[i].a, meant.priors[i].a, 1e-12 * std::abs(meant.priors[i].a));
    EXPECT_NEAR(read.priors[i].b, meant.priors[i].b, 1e-12 * std::abs(meant.priors[i].b));
  }
}

TEST(PatchedStudy, ReadsBackAsTheNominalFilterWithTheCauses) {
  const test::ScratchFolder folder;
  const mc::Study study = read_text(folder, "s.toml", nominal_study);
  search::Cause drift, scale;
  drift.term = "g_drift";
  drift.parameters = {parameter("D_S_y", 0.25),
                      parameter("D_I_y", 55.0)};  // 55: far outside its prior
  scale.term = "torquer_scale";
  scale.parameters = {parameter("s_x", 800.0), parameter("s_z", -1200.5, true)};
  FilterSpec patched = patched_filter(study.filters.front(), {drift, scale});
  patched.noise.drift_random_walk = 0.02 * unit::deg_per_h_per_sqrt_h.to_si;
  EXPECT_DOUBLE_EQ(patched.priors[TermLibrary::find("D_I_y").value()].b,
                   55.0 * unit::deg_per_h_per_g.to_si);
  EXPECT_EQ(patched.priors[TermLibrary::find("s_z").value()], fixed(-1200.5 * 1e-6));

  const mc::Study again = read_text(folder, "patched.toml", patched_study(study, patched));
  ASSERT_EQ(again.filters.size(), 2u);
  expect_same_model(again.filters[0], patched);
  expect_same_model(again.filters[1], study.filters[1]);
  EXPECT_EQ(again.title, study.title);
  EXPECT_EQ(again.plan.preset, "six");
  EXPECT_EQ(again.plan.positions.size(), study.plan.positions.size());
  EXPECT_EQ(again.monte_carlo.seed, 3u);
}

TEST(PatchedStudy, WhatIsFarFromLinearStartsWhereItWasFound) {
  const test::ScratchFolder folder;
  const mc::Study study = read_text(folder, "s.toml", nominal_study);
  search::Cause step, other;
  step.term = "mass_unbalance_step";
  step.parameters = {parameter("dD_I_y", 0.15), parameter("dD_t0", 7.3, true)};
  other.term = "g_drift";
  other.set = 1;  // an alternative: not in the model
  other.parameters = {parameter("D_S_y", 0.25)};
  FilterSpec patched = patched_filter(study.filters.front(), {step});
  EXPECT_EQ(started_where_found(patched, {step, other}).starts,
            patched.starts);  // the onset is held: nothing to start
  const auto t0 = TermLibrary::find("dD_t0").value();
  patched.priors[t0] = normal(8.0 * 3600.0, 2.0 * 3600.0);
  patched = started_where_found(patched, {step, other});
  ASSERT_EQ(patched.starts.size(), 1u);
  const mc::Study again = read_text(folder, "patched.toml", patched_study(study, patched));
  expect_same_model(again.filters[0], patched);
  ASSERT_EQ(again.filters[0].starts.size(), 1u);
  const Start& start = again.filters[0].starts[0];
  ASSERT_EQ(start.size(), 2u);
  EXPECT_EQ(start[1].first, t0);
  EXPECT_NEAR(start[1].second, 7.3 * 3600.0, 1e-6);
  // What is linear starts as the study says.
  search::Cause drift;
  drift.term = "g_drift";
  drift.parameters = {parameter("D_S_y", 0.25)};
  EXPECT_TRUE(
      started_where_found(patched_filter(study.filters.front(), {drift}), {drift}).starts.empty());
}

TEST(PatchedStudy, AStartLiesWithinItsPrior) {
  const test::ScratchFolder folder;
  const mc::Study study = read_text(folder, "s.toml", nominal_study);
  for (const auto& [found, start] : {std::pair{-0.169, 0.0}, {0.31, 0.31}, {1.08, 1.0}}) {
    search::Cause closure;
    closure.term = "frame_closure";
    closure.parameters = {parameter("lambda", found)};
    FilterSpec patched = patched_filter(study.filters.front(), {closure});
    patched = started_where_found(patched, {closure});
    ASSERT_EQ(patched.priors[closure.parameters[0].param].kind, Prior::Kind::uniform);
    ASSERT_EQ(patched.starts.size(), 1u);
    ASSERT_EQ(patched.starts[0].size(), 1u);
    EXPECT_DOUBLE_EQ(patched.starts[0][0].second, start);
  }
}

TEST(PatchedStudy, ACauseBeyondItsPriorHasOneAsWideAsWhatWasFound) {
  const test::ScratchFolder folder;
  const mc::Study study = read_text(folder, "s.toml", nominal_study);
  const auto M_y = TermLibrary::find("M_y").value(), M_z = TermLibrary::find("M_z").value();
  search::Cause magnetic, other;
  magnetic.term = other.term = "magnetic_drift";
  magnetic.parameters = {parameter("M_y", 0.06), parameter("M_z", 0.02)};  // library: 0.01
  other.set = 1;                                                           // not in the model
  other.parameters = {parameter("M_z", 0.09)};
  FilterSpec filter = study.filters.front();  // as a refit leaves it
  for (const std::size_t i : {M_y, M_z}) {
    filter.active.set(i);
    filter.priors[i] = TermLibrary::specs[i].prior_si();
  }
  const FilterSpec patched = with_room_for_causes(filter, {magnetic, other});
  EXPECT_DOUBLE_EQ(patched.priors[M_y].b, 0.06 * TermLibrary::specs[M_y].unit.to_si);
  EXPECT_EQ(patched.priors[M_z], TermLibrary::specs[M_z].prior_si());
}

TEST(PatchedStudy, LambdaMakesTheCouplingLambda) {
  const test::ScratchFolder folder;
  const mc::Study study = read_text(folder, "s.toml", nominal_study);
  search::Cause closure;
  closure.term = "frame_closure";
  closure.parameters = {parameter("lambda", 1.0)};
  const FilterSpec patched = patched_filter(study.filters.front(), {closure});
  const mc::Study again = read_text(folder, "patched.toml", patched_study(study, patched));
  EXPECT_EQ(again.filters[0].coupling, Coupling::lambda);
  expect_same_model(again.filters[0], patched);
}

TEST(PatchedStudy, EveryParameterOfTheLibraryCanBeAdded) {
  const test::ScratchFolder folder;
  const mc::Study study = read_text(folder, "s.toml", nominal_study);
  for (std::size_t i = 0; i < TermLibrary::specs.size(); ++i) {
    const auto& spec = TermLibrary::specs[i];
    if (study.filters.front().active[i]) continue;
    for (const bool profiled : {false, true}) {
      search::Cause cause;
      cause.parameters = {
          parameter(spec.key.view(),
                    0.7 * (spec.prior.sigma() > 0.0 ? spec.prior.sigma() : 1.0) + spec.prior.mean(),
                    profiled)};
      const FilterSpec patched = patched_filter(study.filters.front(), {cause});
      expect_same_model(read_text(folder, "patched.toml", patched_study(study, patched)).filters[0],
                        patched);
    }
  }
}

TEST(PatchedStudy, OfAStudyWithoutFilterIsRefused) {
  const test::ScratchFolder folder;
  std::string text = nominal_study;
  text.erase(text.find("[[filter]]"), text.find("[monte_carlo]") - text.find("[[filter]]"));
  const mc::Study study = read_text(folder, "s.toml", text);
  EXPECT_THROW(patched_study(study, FilterSpec{}), InputError);
}

TEST(PatchedStudy, AFieldThatWasFoundIsDeclared) {
  const test::ScratchFolder folder;
  mc::Study study = read_text(folder, "s.toml", nominal_study);
  const Vec3 field_l(2.5e-5, -3e-6, -4.7e-5);
  study.text = study_with_field(study, field_l);
  const mc::Study read =
      read_text(folder, "there.toml", patched_study(study, study.filters.front()));
  const CovariateCourse& declared = read.environment[covariate("field")];
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(declared.mean[static_cast<std::size_t>(k)]);
    EXPECT_NEAR(*declared.mean[static_cast<std::size_t>(k)], field_l[k],
                0.5e-8);  // four digits of gauss
  }
  expect_same_model(read.filters.front(), study.filters.front());
}

}  // namespace
}  // namespace drift::diagnosis::patched_study_test
