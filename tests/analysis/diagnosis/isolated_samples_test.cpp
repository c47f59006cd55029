// Isolated samples: which are taken out, and that motion and noise alone are not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/identification/spikes.hpp"
#include "core/base/rng.hpp"
#include "core/plan/timeline.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::isolated_samples_test {
namespace {

using identification::without_spikes;

/// A dwell, a slew of `slewing` rows and a dwell, in one chain.
Timeline dwell_slew_dwell(int slewing) {
  constexpr int dwelling = 20;
  Timeline timeline;
  timeline.intervals.resize(static_cast<std::size_t>(2 * dwelling + slewing));
  for (int k = 0; k < static_cast<int>(timeline.intervals.size()); ++k) {
    Interval& i = timeline.intervals[static_cast<std::size_t>(k)];
    i.position = k < dwelling ? 0 : 1;
    i.slew = k >= dwelling && k < dwelling + slewing;
  }
  return timeline;
}

std::size_t spikes_in(const Timeline& timeline, const Mat3X& acc_residual) {
  BatchResult fit;
  fit.acc_residual = acc_residual;
  Readout readout;
  readout.gimbals = false;
  const auto n = acc_residual.cols();
  return without_spikes({Mat3X::Zero(3, n), Mat3X::Zero(3, n)}, timeline, readout, fit)
      .spikes.size();
}

TEST(IsolatedSamples, InASlewIsFoundAmongQuietRowsWhereverItIs) {
  for (const int slewing : {3, 4, 9})
    for (int at = 20; at < 20 + slewing; ++at) {
      const Timeline timeline = dwell_slew_dwell(slewing);
      Mat3X residual = Mat3X::Zero(3, static_cast<int>(timeline.intervals.size()));
      residual(1, at) = 8.1;
      EXPECT_EQ(spikes_in(timeline, residual), 1u) << slewing << " " << at;
      residual(1, at) = 7.9;
      EXPECT_EQ(spikes_in(timeline, residual), 0u) << slewing << " " << at;
    }
}

TEST(IsolatedSamples, ARowOfZerosThatBeginsOneDwellIsNoDecayOfSeveral) {
  const Timeline timeline = dwell_slew_dwell(9);
  Mat3X residual = Mat3X::Zero(3, static_cast<int>(timeline.intervals.size()));
  residual.col(29).setConstant(50.0);
  EXPECT_EQ(spikes_in(timeline, residual), 3u) << "three channels of one row";
  residual.col(0).setConstant(50.0);
  EXPECT_EQ(spikes_in(timeline, residual), 0u) << "what begins two dwells";
}

TEST(IsolatedSamples, AMotionInASlewIsNone) {
  // What a wrong equation leaves of one slew, and what a slew of two rows or one may be.
  const std::vector<std::vector<double>> slews{
      {-70.2, -46.2, -37.3, -37.5}, {-7.8, -13.8, -37.6, -85.0}, {30.0, 80.0}, {80.0}};
  for (const auto& slew : slews) {
    const Timeline timeline = dwell_slew_dwell(static_cast<int>(slew.size()));
    Mat3X residual = Mat3X::Zero(3, static_cast<int>(timeline.intervals.size()));
    residual.row(2).head(20).setConstant(slew.size() < 3 ? 0.0 : slew.front());
    residual.row(2).tail(20).setConstant(slew.size() < 3 ? 0.0 : slew.back());
    for (std::size_t k = 0; k < slew.size(); ++k) residual(2, static_cast<int>(20 + k)) = slew[k];
    EXPECT_EQ(spikes_in(timeline, residual), 0u) << slew.front();
  }
}

TEST(IsolatedSamples, NoMotionIsOneThatRisesOrFallsOrTurnsOnce) {
  Stream stream(5, 0, Purpose::test, 0);
  for (int trial = 0; trial < 2000; ++trial) {
    constexpr int n = 9;
    Timeline timeline;
    timeline.intervals.resize(n);
    for (Interval& i : timeline.intervals) i.slew = true;
    Mat3X residual = Mat3X::Zero(3, n);
    // Slopes that grow: a curve of one bend, of any size; where it does not turn it only rises.
    std::vector<double> slopes;
    for (int k = 0; k < n; ++k) slopes.push_back(std::pow(10.0, 3.0 * stream.normal()));
    std::ranges::sort(slopes);
    const double turn = trial % 2 == 0 ? 0.0 : slopes[static_cast<std::size_t>(n / 2)];
    for (int k = 1; k < n; ++k)
      residual(0, k) = residual(0, k - 1) + slopes[static_cast<std::size_t>(k)] - turn;
    ASSERT_EQ(spikes_in(timeline, residual), 0u) << trial;
  }
}

/// The limit is 8 for samples whose neighbours are quiet but for the other one of the two.
TEST(IsolatedSamples, TwoBesideEachOtherInADwellAreBothFound) {
  const Timeline timeline = dwell_slew_dwell(9);
  for (const int apart : {1, 2})
    for (const double other : {8.1, -8.1, 2000.0}) {
      Mat3X residual = Mat3X::Zero(3, static_cast<int>(timeline.intervals.size()));
      residual(1, 8) = 8.1;
      residual(1, 8 + apart) = other;
      EXPECT_EQ(spikes_in(timeline, residual), 2u) << apart << " " << other;
      residual(1, 8) = 0.0;
      EXPECT_EQ(spikes_in(timeline, residual), 1u) << apart << " " << other;
    }
}

/// What decays from the begin of every dwell, however fast, and a curve of one bend but for its
/// ends, where nobody knows how it went on.
TEST(IsolatedSamples, NoMotionOfADwellIsOne) {
  const Timeline timeline = dwell_slew_dwell(9);
  const auto n = static_cast<int>(timeline.intervals.size());
  for (const double each : {0.01, 0.1, 0.4, 0.7, 0.95}) {
    Mat3X residual = Mat3X::Zero(3, n);
    for (const int begin : {0, 29})
      for (int k = 0; k < 20; ++k) residual(0, begin + k) = 1e6 * std::pow(each, k);
    EXPECT_EQ(spikes_in(timeline, residual), 0u) << each;
  }
  BatchResult fit;
  Readout readout;
  readout.gimbals = false;
  Stream stream(6, 0, Purpose::test, 0);
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<double> slopes;
    for (int k = 0; k < 20; ++k) slopes.push_back(std::pow(10.0, 3.0 * stream.normal()));
    std::ranges::sort(slopes);
    const double turn = trial % 2 == 0 ? 0.0 : slopes[10];
    fit.acc_residual = Mat3X::Zero(3, n);
    for (int k = 1; k < 20; ++k)
      fit.acc_residual(0, k) =
          fit.acc_residual(0, k - 1) + slopes[static_cast<std::size_t>(k)] - turn;
    const auto clean =
        without_spikes({Mat3X::Zero(3, n), Mat3X::Zero(3, n)}, timeline, readout, fit);
    EXPECT_TRUE(clean.measured.acc.row(0).segment(2, 16).array().isFinite().all()) << trial;
  }
}

/// Tests of fifty platforms with slews, each with noise of its own; how many have isolated samples
/// under a model of eq. (5).
int of_fifty(Coupling truth_coupling) {
  const Timeline timeline = test::preset_timeline("slew12", CommandLaw::free, 3600.0, 60.0);
  const FilterSpec filter = test::base_filter(Coupling::eq5);
  const TruthSpec truth = test::base_truth(truth_coupling);
  const Readout readout;
  int with_spikes = 0;
  for (std::uint64_t run = 0; run < 50; ++run) {
    const TruthDraw draw = draw_truth(truth, timeline.chains, 3, run);
    const Measurements measured = Simulator(truth, readout).run(timeline, draw, 3, run).measured;
    const BatchResult fit =
        fit_batch(filter, {timeline, readout, measured}, make_layout(filter).theta);
    with_spikes += without_spikes(measured, timeline, readout, fit).spikes.empty() ? 0 : 1;
  }
  return with_spikes;
}

TEST(IsolatedSamplesOfSlews, AreNoneUnderTheRightModel) {
  EXPECT_EQ(of_fifty(Coupling::eq5), 0);
}

TEST(IsolatedSamplesOfSlews, AreNoneUnderTheOtherEquation) {
  EXPECT_EQ(of_fifty(Coupling::eq6), 0);
}

}  // namespace
}  // namespace drift::isolated_samples_test
