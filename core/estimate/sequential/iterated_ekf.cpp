#include "core/estimate/sequential/iterated_ekf.hpp"

#include "core/estimate/sequential/drift_walk.hpp"
#include "core/physics/stochastic.hpp"

namespace drift {
namespace {

bool white(const FilterSpec& filter) {
  return filter.noise.angle_random_walk == 0.0 &&
         walking_states(filter, make_layout(filter)).empty() && !has_outliers(filter.model().terms);
}

}  // namespace

IteratedEkf::IteratedEkf(const FilterSpec& filter, const Timeline& timeline, const Readout& readout,
                         const Theta& start)
    : filter_(filter), timeline_(timeline), readout_(readout), start_(start) {
  // With half of the nodes a run takes as long as before.
  CompressedTest::Options pays{.fewer = 4};
  if (white(filter) && all_in_lanes(filter.model().terms))
    test_ = std::make_unique<CompressedTest>(timeline, readout_, pays);
  if (!test_ || !test_->any()) {
    last_ = &sample_by_sample();
    return;
  }
  through_polynomials_ = std::make_unique<IteratedPasses>(filter, *test_, readout_, start);
  last_ = through_polynomials_.get();
  pays.cut = CompressedTest::Cut::doubling;
  pieces_ = std::make_unique<CompressedTest>(timeline, readout_, pays);
  if (pieces_->any())
    piece_by_piece_ = std::make_unique<IteratedPasses>(filter, *pieces_, readout_, start);
}

IteratedPasses& IteratedEkf::sample_by_sample() {
  if (!sample_by_sample_)
    sample_by_sample_ = std::make_unique<IteratedPasses>(filter_, timeline_, readout_, start_);
  return *sample_by_sample_;
}

/// The first pass relinearises after 1, 2, 4, ... samples from the beginning of each stretch on.
bool IteratedEkf::begin(const Measurements& measured, const Theta& start) {
  if (piece_by_piece_) pieces_->read(measured);
  IteratedPasses& first = piece_by_piece_ ? *piece_by_piece_ : sample_by_sample();
  const bool begun = first.begin(piece_by_piece_ ? pieces_->test().measured : measured, start);
  last_->begin_as(first);
  return begun;
}

const FilterEstimate& IteratedEkf::run(const Measurements& measured, const Theta& start) {
  if (through_polynomials_) {
    last_ = through_polynomials_.get();
    test_->read(measured);
    if (begin(measured, start)) {
      last_->settle(test_->test().measured);
      if (last_->status() == EstimateStatus::ok && last_->smooth()) return *last_;
    }
  }
  last_ = &sample_by_sample();
  last_->run(measured, start);
  return *last_;
}

}  // namespace drift
