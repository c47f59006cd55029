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
  /// time on, where no sample is missing in a stretch.
  void run(const Measurements& measured, const Theta& start);

  EstimateStatus status() const { return passes().status(); }
  const std::string& cause() const { return passes().cause(); }
  double t_diverged() const { return passes().t_diverged(); }  ///< [s]
  double nis() const { return passes().nis(); }                ///< minimum of data and prior cost
  std::size_t scalars() const { return passes().scalars(); }   ///< measured scalars it sums over
  double lag1() const { return passes().lag1(); }              ///< see IteratedPasses
  const VecX& x() const {
    return passes().x();
  }  ///< deviations from the prior means, in their sigmas
  const Theta& theta() const { return passes().theta(); }
  const Layout& layout() const { return passes().layout(); }
  /// Of state k, SI.
  double sigma(std::size_t k) const { return passes().sigma(k); }
  /// Covariance of the states in prior sigmas, shape (size, size).
  const MatX& settled_covariance() const { return passes().settled_covariance(); }
  /// Whether the last run has seen some stretch through polynomials.
  bool compressed() const { return last_ == through_polynomials_.get(); }

 private:
  const IteratedPasses& passes() const { return *last_; }
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
