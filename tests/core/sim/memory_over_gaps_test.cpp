// What is not known of a term's memory where a recording leaves out when the platform was turned.
#include "core/sim/memory_over_gaps.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/model_builders.hpp"

namespace drift::memory_over_gaps_test {
namespace {

using namespace drift::test;

constexpr double row = 60.0;  // [s]

/// Three positions of one row each: a gap in front of the second, none in front of the third.
Timeline timeline(double gap, std::string_view second = "x=N y=W z=U") {
  Timeline t;
  t.site = harbin;
  t.chains = t.positions = 3;
  double t0 = 0.0;
  for (int k = 0; k < 3; ++k) {
    Interval i;
    i.t0 = t0 + (k == 1 ? gap : 0.0);
    t0 = i.t1 = i.t0 + row;
    i.position = i.chain = k;
    i.cage = true;
    t.intervals.push_back(i);
  }
  std::string why;
  const auto attitude = [&](std::string_view axes) { return parse_axes(axes, why).value(); };
  const Mat3 up = attitude("x=U y=N z=W");
  place_nodes(t, {up, attitude(second), up});
  return t;
}

std::vector<MemoryOverGap> gaps(const Timeline& t,
                                std::initializer_list<std::string_view> amplitudes = {"R"}) {
  const ParamMask active = TermLibrary::completed(only(amplitudes));
  Theta theta = Theta::Zero();
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    if (active[i]) theta[i] = TermLibrary::specs[i].prior_si().mean();
  return memory_over_gaps(t, {Coupling::eq6, TermLibrary::terms_of(active), {}}, theta);
}

TEST(MemoryOverGaps, LeaveWhatALagLeavesOfATurnAtTheirBegin) {
  const double tau = 600.0;  // R_tau [s]
  for (const double gap : {1.0, 66.0, 300.0, 3600.0}) {
    const auto all = gaps(timeline(gap));
    ASSERT_EQ(all.size(), 1u) << gap;
    EXPECT_EQ(all.front().term, "reposition_transient");
    EXPECT_EQ(all.front().from, 0);
    EXPECT_EQ(all.front().to, 1);
    EXPECT_NEAR(all.front().length, gap, 1e-9);
    EXPECT_NEAR(all.front().left, std::exp(-gap / tau), 1e-12);
  }
}

TEST(MemoryOverGaps, LeaveNothingOpenWhereThereAreNoneOrTheAttitudeStays) {
  EXPECT_TRUE(gaps(timeline(0.0)).empty());
  // Caged anew where it was, less the 0.25 deg of a minute of free drift.
  EXPECT_TRUE(gaps(timeline(300.0, "x=U y=N z=W")).empty());
}

TEST(MemoryOverGaps, AreNoneBetweenRecordingsAndOfACase) {
  Timeline two = timeline(300.0);
  two.intervals[1].begins = true;
  EXPECT_TRUE(gaps(two).empty());
  Timeline of_case = timeline(300.0);
  of_case.of_case = true;
  EXPECT_TRUE(gaps(of_case).empty());
}

TEST(MemoryOverGaps, DoNotMatterToWhatIsDrivenByCommandsOrByTheWayOfTheGimbals) {
  EXPECT_TRUE(gaps(timeline(300.0), {"heat", "F"}).empty());
}

}  // namespace
}  // namespace drift::memory_over_gaps_test
