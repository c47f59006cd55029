#pragma once

#include "core/estimate/sequential/iterated_passes.hpp"

namespace drift {

/// The iterated EKF of a whole recording (IteratedPasses). Where the noise is white and the terms
/// ask for attitude and command alone, it sees long stretches through polynomials (CompressedTest);
/// a recording for which that is too rough, or in which it fails, it sees sample by sample.
class IteratedEkf {
 public:
  /// The timeline must outlive the filter. start: library values of the initial estimate.
  IteratedEkf(const FilterSpec& filter, const Timeline& timeline, const Readout& readout,
              const Theta& start);

  /// As if built anew from this start, over a whole recording. Allocates nothing from the second
  /// time on, where no sample is missing in a stretch. The estimate stays until the next run.
  const FilterEstimate& run(const Measurements& measured, const Theta& start);

  /// Whether the last run has seen some stretch through polynomials.
  bool compressed() const { return last_ == through_polynomials_.get(); }

 private:
  IteratedPasses& sample_by_sample();
  bool begin(const Measurements& measured, const Theta& start);

  FilterSpec filter_;
  const Timeline& timeline_;
  Readout readout_;
  Theta start_;
  std::unique_ptr<CompressedTest> test_, pieces_;
  std::unique_ptr<IteratedPasses> through_polynomials_, piece_by_piece_, sample_by_sample_;
  IteratedPasses* last_ = nullptr;
};

}  // namespace drift
