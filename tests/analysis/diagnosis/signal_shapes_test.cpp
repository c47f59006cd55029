// Shapes of a recovered signal: by the clock of each recording, and in one of them alone.
#include "analysis/diagnosis/signal_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/report/diagnosis/words/sentence.hpp"
#include "tests/support/model_builders.hpp"
#include "tests/support/two_recordings.hpp"

namespace drift::diagnosis::signal_shapes_test {
namespace {

using Kind = Shape::Kind;

constexpr int per_position = 4;

/// Six positions of 20 minutes in bins of five, and the same recorded twice.
struct Scene {
  Timeline once = test::preset_timeline("six", CommandLaw::free, 1200.0, 60.0),
           both = test::twice(once);

  static InputEstimate input(const Timeline& timeline) {
    InputEstimate out;
    const std::size_t rows = 20 / per_position;
    for (std::size_t i = 0; i + rows <= timeline.intervals.size(); i += rows)
      out.bins.emplace_back(i, i + rows);
    return out;
  }
  /// Seen without anything that absorbs it, or beside a constant of the model that does.
  static InputEstimate seen(const Timeline& timeline, const VecX& signal, bool constant_absorbed) {
    InputEstimate out = input(timeline);
    const auto n = static_cast<Eigen::Index>(out.bins.size());
    out.C = MatX::Identity(n, n);
    if (constant_absorbed) out.C -= MatX::Constant(n, n, 1.0 / static_cast<double>(n));
    out.g = out.C * signal;
    out.smoother = MatX::Identity(n, n);
    out.value = out.g;
    out.sigma = VecX::Ones(n);
    return out;
  }
};

const ShapeColumns* first_of(const std::vector<ShapeColumns>& all, Kind kind) {
  const auto at =
      std::ranges::find_if(all, [&](const ShapeColumns& s) { return s.shape.kind == kind; });
  return at == all.end() ? nullptr : &*at;
}

TEST(SignalShapes, OfTimeBeginAnewWithEachRecording) {
  const Scene s;
  const auto input = Scene::input(s.both);
  const auto all = signal_shapes(input, s.both, {});
  const auto half = static_cast<Eigen::Index>(input.bins.size() / 2);
  for (const Kind kind :
       {Kind::ramp, Kind::decay_from_start, Kind::decay_in_position, Kind::period}) {
    const ShapeColumns* shape = first_of(all, kind);
    ASSERT_NE(shape, nullptr);
    EXPECT_LT((shape->columns.topRows(half) - shape->columns.bottomRows(half)).norm(), 1e-9)
        << static_cast<int>(kind);
  }
  EXPECT_NEAR(first_of(all, Kind::ramp)->columns(half - 1, 0), 1.0, 0.05);
}

TEST(SignalShapes, ASwingIsThereTwiceInTheLongestRecordingAtLeast) {
  const Scene s;
  const double length = s.once.intervals.back().t1 - s.once.intervals.front().t0;
  for (const Timeline* timeline : {&s.once, &s.both}) {
    double longest = 0.0;
    for (const ShapeColumns& shape : signal_shapes(Scene::input(*timeline), *timeline, {}))
      if (shape.shape.kind == Kind::period) longest = std::max(longest, shape.shape.seconds);
    EXPECT_NEAR(longest, 0.5 * length, 1e-6);
  }
}

TEST(SignalShapes, OnePositionThatEndsARecordingAndBeginsTheNextIsTwo) {
  Scene s;
  for (std::size_t k = 0; k < s.once.intervals.size(); ++k)
    s.both.intervals[s.once.intervals.size() + k].position = s.once.intervals.back().position;
  const auto input = Scene::input(s.both);
  const auto all = signal_shapes(input, s.both, {});
  const ShapeColumns* decay = first_of(all, Kind::decay_in_position);
  ASSERT_NE(decay, nullptr);
  const auto half = static_cast<Eigen::Index>(input.bins.size() / 2);
  EXPECT_NEAR(decay->columns(half, 0), decay->columns(0, 0), 1e-9);
}

TEST(SignalShapes, OneRecordingAloneIsAShapeOfSeveral) {
  const Scene s;
  EXPECT_EQ(first_of(signal_shapes(Scene::input(s.once), s.once, {}), Kind::one_recording),
            nullptr);
  const auto input = Scene::input(s.both);
  const auto n = static_cast<Eigen::Index>(input.bins.size());
  VecX in_first = VecX::Zero(n), in_second = VecX::Zero(n);
  in_first.head(n / 2).setOnes();
  in_second.tail(n / 2).setOnes();
  const auto shape_of = [&](const VecX& signal, bool constant_absorbed) {
    return recovered_signal(Scene::seen(s.both, signal, constant_absorbed), s.both, {}, {},
                            ShapeFrom::signal);
  };
  const RecoveredSignal alone = shape_of(in_first, false);
  EXPECT_EQ(alone.shape.kind, Kind::one_recording);
  EXPECT_EQ(alone.shape.recording, 1);
  const std::vector<RecordingSpan> spans{{"a.csv", 0.0, 7200.0, 0.0},
                                         {"b.csv", 7200.0, 14400.0, 7200.0}};
  EXPECT_EQ(report::shape_text(alone, spans),
            "is present in recording 1 (a.csv) alone (correlation 1.00)");
  // Where a constant is absorbed nobody can tell it from what begins with the second.
  for (const RecoveredSignal& from : {shape_of(in_second, false), shape_of(in_first, true)}) {
    EXPECT_EQ(from.shape.kind, Kind::onset);
    EXPECT_EQ(from.shape.seconds, s.both.intervals[s.once.intervals.size()].t0);
  }
}

TEST(SignalShapes, AreToldOfEachRecordingWhereThereAreSeveral) {
  const std::vector<RecordingSpan> spans{{"a.csv", 0.0, 900.0, 0.0},
                                         {"b.csv", 900.0, 1800.0, 900.0}};
  RecoveredSignal s;
  s.correlation = 0.9;
  s.shape = {Kind::ramp};
  EXPECT_EQ(report::shape_text(s, spans),
            "grows evenly with time in each recording (correlation 0.90)");
  s.shape = {Kind::decay_from_start, 600.0};
  EXPECT_EQ(report::shape_text(s, spans),
            "dies away from the start of each recording with a time constant of about 10 min "
            "(correlation 0.90)");
  EXPECT_EQ(report::shape_text(s, {}),
            "dies away from the start of the test with a time constant of about 10 min "
            "(correlation 0.90)");
}

}  // namespace
}  // namespace drift::diagnosis::signal_shapes_test
