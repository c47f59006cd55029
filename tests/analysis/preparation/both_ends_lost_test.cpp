// A caged position whose first and last rows are both missing.
#include <gtest/gtest.h>

#include "analysis/preparation/prepare.hpp"
#include "tests/support/rows_at_any_distance.hpp"

namespace drift::preparation::both_ends_lost_test {
namespace {

mc::Study study() {
  mc::Study s = test::slewing_study(600.0, Coupling::eq5, Coupling::eq5);
  s.plan = preset_plan("six", {.dwell = 600.0, .sample = 60.0}).value();
  return s;
}

Recording recording() {
  const mc::Study s = study();
  const Timeline timeline = lay_out(s.plan, s.site);
  const TruthDraw draw = draw_truth(s.truth, timeline.chains, 1, 0);
  return make_recording(timeline, Simulator(s.truth, s.readout).run(timeline, draw, 1, 0).measured,
                        s.readout);
}

/// Without the rows of a position that its numbers, from 0, name.
Recording without(Recording r, double position, const std::vector<std::size_t>& rows) {
  const auto& at = r.find("position")->values;
  const auto first = static_cast<std::size_t>(std::ranges::find(at, position) - at.begin());
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    const auto k = static_cast<std::ptrdiff_t>(first + *row);
    for (Channel& c : r.channels) c.values.erase(c.values.begin() + k);
    r.lines.erase(r.lines.begin() + k);
  }
  return r;
}

/// When the position begins, by what was made ready [s].
double begin_of(const Prepared& p, double position) {
  const Recording& r = p.recordings.front();
  const auto& at = r.find("position")->values;
  const auto row = static_cast<std::size_t>(std::ranges::find(at, position) - at.begin());
  return r.begins.empty() ? r.find("time")->values[row] - 60.0 : r.begins[row];
}

TEST(BothEndsLost, APositionBeginsWhereTheOneBeforeEndedIfItsDwellIsWhatIsBetween) {
  // 3 s of free drift turn the platform by 45 arcsec: a minute missed is 4.5 priors of 200.
  for (const auto& lost : std::vector<std::vector<std::size_t>>{{0, 9}, {0, 1, 9}, {0, 8, 9}}) {
    Recording r = without(recording(), 4.0, lost);
    EXPECT_DOUBLE_EQ(begin_of(prepare(study(), {r}), 4.0), 3.0 * 600.0) << lost.size();
    // That of the next one is known by its end.
    r = without(std::move(r), 5.0, {0});
    EXPECT_DOUBLE_EQ(begin_of(prepare(study(), {r}), 4.0), 3.0 * 600.0) << lost.size();
  }
}

TEST(BothEndsLost, ElseItIsOneRowBeforeItsFirst) {
  // A pause before the next one: nobody knows what of it was the dwell's.
  Recording r = without(recording(), 4.0, {0, 9});
  auto& time = std::ranges::find(r.channels, "time", &Channel::name)->values;
  const auto& at = r.find("position")->values;
  for (std::size_t k = 0; k < time.size(); ++k)
    if (at[k] > 4.0) time[k] += 137.0;
  EXPECT_DOUBLE_EQ(begin_of(prepare(study(), {r}), 4.0), 3.0 * 600.0 + 60.0);
}

TEST(BothEndsLost, OfPositionsThatAreAllShorterTheDwellThatWouldExplainItIsSaid) {
  Recording r = recording();
  for (double position = 1.0; position <= 6.0; position += 1.0) r = without(r, position, {9});
  // Times alone do not tell a caged minute behind each position from one in front of it.
  const Prepared p = prepare(study(), {r});
  EXPECT_DOUBLE_EQ(begin_of(p, 4.0), 3.0 * 600.0 - 60.0);
  const auto says = [](const Prepared& of, std::string_view text) {
    return std::ranges::any_of(
        of.remarks, [&](const auto& remark) { return remark.find(text) != std::string::npos; });
  };
  EXPECT_TRUE(says(p, "the first row of 5 caged positions is longer than is usual"));
  EXPECT_TRUE(says(p, "the dwell is 9 min, and plan.dwell is to say so"));
  const Prepared one = prepare(study(), {without(recording(), 4.0, {0})});
  EXPECT_TRUE(says(one, "the first row of 1 caged position is longer than is usual"));
  EXPECT_FALSE(says(one, "plan.dwell")) << "the dwell of one is not that of the plan";
  mc::Study shorter = study();
  shorter.plan = preset_plan("six", {.dwell = 540.0, .sample = 60.0}).value();
  const Prepared q = prepare(shorter, {r});
  EXPECT_DOUBLE_EQ(begin_of(q, 4.0), 3.0 * 600.0);
  EXPECT_FALSE(says(q, "longer than is usual"));
}

}  // namespace
}  // namespace drift::preparation::both_ends_lost_test
