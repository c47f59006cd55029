#include "core/estimate/sequential/in_lanes/iterated_stretches.hpp"

namespace drift {
namespace {

/// With half of the nodes a run is a tenth quicker.
constexpr int fewer_nodes = 2;

}  // namespace

std::unique_ptr<IteratedStretches> IteratedStretches::of(const FilterSpec& filter,
                                                         const Timeline& timeline,
                                                         const Readout& readout) {
  if (!CompressedTest::can(filter.model())) return nullptr;
  if (!CompressedTest(timeline, readout, {.fewer = fewer_nodes}).any()) return nullptr;
  return std::make_unique<IteratedStretches>(filter, timeline, readout);
}

IteratedStretches::IteratedStretches(const FilterSpec& filter, const Timeline& timeline,
                                     const Readout& readout)
    : whole_(timeline, readout, {.fewer = fewer_nodes}),
      pieces_(timeline, readout, {.fewer = fewer_nodes, .cut = CompressedTest::Cut::doubling}),
      first_(pieces_.any() ? LaneIntervals(filter, pieces_, readout)
                           : LaneIntervals(filter, timeline, readout)),
      lag_(whole_, first_.layout().size(), first_.layout().num_rate, first_.readout_states()) {}

std::ptrdiff_t IteratedStretches::take(const Measurements& measured) {
  if (recordings_ == recorded_.size()) recorded_.emplace_back();
  Recorded& now = recorded_[recordings_];
  if (!now.whole.take(whole_, measured) || !now.pieces.take(pieces_, measured)) return -1;
  return static_cast<std::ptrdiff_t>(recordings_++);
}

}  // namespace drift
