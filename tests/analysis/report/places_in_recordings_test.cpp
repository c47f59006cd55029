// Places in one of several recordings: which file, and when by its own clock.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "analysis/identification/identify.hpp"
#include "analysis/preparation/recorded_test.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/diagnosis/words/doubts.hpp"
#include "analysis/report/diagnosis/words/words.hpp"
#include "analysis/report/identify/sections.hpp"
#include "core/plan/stretches_and_chains.hpp"
#include "core/sim/memory_over_gaps.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::places_in_recordings_test {
namespace {

using identification::Spike;

/// Two recordings of one study, b.csv with a spike of gimbal_outer in its row `at`.
std::vector<Recording> with_spike_in_second(const mc::Study& study, std::size_t at) {
  std::vector<Recording> two{test::simulated(study), test::simulated(study)};
  two[0].source = "logs/a.csv";
  two[1].source = "logs/b.csv";
  test::channel(two[1], "gimbal_outer")[at] += 200.0 * study.readout.gimbal_noise;
  return two;
}

TEST(PlacesInRecordings, OfASpikeAreItsFileAndTheTimeInThat) {
  const mc::Study study = test::six_study();
  constexpr std::size_t at = 70;
  const std::vector<Recording> two = with_spike_in_second(study, at);
  const auto id = identification::identify_recordings(study, two, 1, {});
  ASSERT_EQ(id.spikes.size(), 1u);
  EXPECT_EQ(id.spikes.front().recording, 2u);
  EXPECT_NEAR(id.spikes.front().t, two[1].find("time")->values[at], 1e-9);
  std::string all;
  for (const std::string& text : report::identification_in_brief(study, id).more.texts())
    all += text + "\n";
  const std::string place =
      fmt::format("(gimbal_outer in position {:.0f} at {:.6g} s of b.csv)",
                  two[1].find("position")->values[at], two[1].find("time")->values[at]);
  EXPECT_NE(all.find(place), std::string::npos) << all;
}

TEST(PlacesInRecordings, OffsetsAreThoseByWhichTheyWereMoved) {
  const mc::Study study = test::six_study();
  Recording late = test::simulated(study);
  for (double& t : test::channel(late, "time")) t += 500.0;
  const auto made = preparation::recorded_test(study, {test::simulated(study), late});
  ASSERT_EQ(made.timeline.recordings.size(), 2u);
  EXPECT_EQ(made.timeline.recordings[0].offset, 0.0);
  const std::size_t first = made.ends.front();
  EXPECT_NEAR(made.timeline.intervals[first].t1 - made.timeline.recordings[1].offset,
              late.find("time")->values.front(), 1e-9);
  const std::vector<std::size_t> numbers = recording_of_each(made.timeline);
  EXPECT_EQ(numbers[first - 1], 0u);
  EXPECT_EQ(numbers[first], 1u);
  EXPECT_EQ(numbers.back(), 1u);
}

TEST(PlacesInRecordings, LateLabelsAreCountedInEachOfThem) {
  const std::vector<Spike> spikes{
      {0, 60.0, 1, true, 1}, {0, 60.0, 1, true, 2}, {0, 120.0, 2, true, 2}};
  EXPECT_EQ(identification::late_labels(spikes), 3u);
  EXPECT_EQ(report::late_labels_text(spikes, {"a.csv", "b.csv"})
                .find("In the last row of 3 positions, and in no other, readings stand out (acc_x "
                      "in position 1 at 60 s of a.csv, acc_x in position 1 at 60 s of b.csv and 1 "
                      "more)"),
            0u);
}

TEST(PlacesInRecordings, AreToldByADiagnosisToo) {
  diagnosis::Diagnosis d;
  d.where.recordings = {{"a.csv", 0.0, 900.0, 0.0}, {"b.csv", 900.0, 3600.0, 900.0}};
  d.remarks.emplace_back(diagnosis::remark::SamplesLeftOut{{Spike{3, 6060.0, 4, false, 2}}, 0});
  d.remarks.emplace_back(
      diagnosis::remark::MemoryOff{{}, {{{"reposition_transient", 4, 8, 3600.0, 0.1, 2}, 1}}});
  const std::string spike = "gimbal_outer in position 4 at 6060 s of b.csv",
                    gap = "Between positions 5 and 9 of b.csv, 60 min are not recorded";
  for (const std::string& place : {spike, gap}) {
    std::string doubts, remarks;
    for (const auto& [head, sentence] : report::doubts_of(d)) doubts += sentence;
    for (const std::string& text : report::remarks_of(d)) remarks += text;
    EXPECT_NE(doubts.find(place), std::string::npos) << doubts;
    EXPECT_NE(remarks.find(place), std::string::npos) << remarks;
  }
  d.where.recordings.clear();
  EXPECT_NE(report::doubts_of(d).back().second.find("at 6060 s)"), std::string::npos);
}

TEST(PlacesInRecordings, AreKnownOfAGapThatAMemoryHangsOn) {
  Timeline t;
  t.site = test::harbin;
  t.chains = t.positions = 3;
  double t0 = 0.0;
  for (int k = 0; k < 3; ++k) {
    Interval i;
    i.t0 = t0 + (k == 2 ? 300.0 : 0.0);
    t0 = i.t1 = i.t0 + 60.0;
    i.position = i.chain = k;
    i.cage = true;
    i.begins = k == 1;
    t.intervals.push_back(i);
  }
  std::string why;
  const Mat3 up = parse_axes("x=U y=N z=W", why).value();
  place_nodes(t, {up, up, parse_axes("x=N y=W z=U", why).value()});
  const ParamMask active = TermLibrary::completed(test::only({"R"}));
  Theta theta = Theta::Zero();
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    if (active[i]) theta[i] = TermLibrary::specs[i].prior_si().mean();
  const auto gaps = memory_over_gaps(t, {Coupling::eq6, TermLibrary::terms_of(active), {}}, theta);
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_EQ(gaps.front().recording, 2u);
}

}  // namespace
}  // namespace drift::places_in_recordings_test
