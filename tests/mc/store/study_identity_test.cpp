// What a study's results depend on, and what it asks the engine for: without the program.
#include "mc/store/study_identity.hpp"

#include <gtest/gtest.h>

#include "core/base/check.hpp"
#include "mc/engine/study_work.hpp"
#include "tests/mc/small_study.hpp"

namespace drift::study_identity_test {
namespace {

using namespace drift::test;

std::string hash_of(const mc::Overrides& overrides) {
  return mc::identity_of(read_text(small_study, overrides)).hash();
}

TEST(StudyIdentity, IsThatOfEveryRunHoweverManyThereAre) {
  const std::string one = hash_of({});
  EXPECT_EQ(hash_of({{"monte_carlo.runs", "77"}}), one);
  EXPECT_EQ(hash_of({{"monte_carlo.allowed_failures", "3"}}), one);
  EXPECT_NE(hash_of({{"monte_carlo.seed", "77"}}), one);
  EXPECT_NE(hash_of({{"readout.gimbal_noise", "\"7 arcsec\""}}), one);
  const mc::Overrides stratified = {{"monte_carlo.design", "\"latin_hypercube\""}};
  mc::Overrides more = stratified;
  more.emplace_back("monte_carlo.runs", "77");
  EXPECT_NE(hash_of(stratified), hash_of(more)) << "whose strata are as many as its runs";
}

TEST(StudyWork, HasTheTasksOfAllPoints) {
  const mc::StudyWork one = mc::work_of(read_text(small_study));
  ASSERT_EQ(one.points.size(), 1u);
  EXPECT_FALSE(one.points.front().task->columns().empty());
  EXPECT_FALSE(one.stop_rules);
  const mc::StudyWork two = mc::work_of(read_text(
      small_study + "[sweep]\n\"readout.gimbal_noise\" = [\"1 arcsec\", \"9 arcsec\"]\n"));
  ASSERT_EQ(two.points.size(), 2u);
  EXPECT_EQ(two.points.back().label, "readout.gimbal_noise = 9 arcsec");
  mc::Study none = read_text(small_study);
  none.filters.clear();
  EXPECT_THROW(mc::work_of(none), InputError);
}

}  // namespace
}  // namespace drift::study_identity_test
