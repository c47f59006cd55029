#pragma once

#include "core/estimate/measured_test.hpp"
#include "core/estimate/sequential/interval_step.hpp"

namespace drift {

/// How an EKF run went, one entry per interval.
struct EkfHistory {
  std::vector<double> t;     ///< [s]
  MatX estimate;             ///< parameters in layout order, SI, shape (size, intervals)
  MatX sigma;                ///< shape (size, intervals)
  std::vector<double> nis;   ///< normalised innovation squared of the interval
  std::vector<int> scalars;  ///< measured scalars it sums over
};

/// Whether an EKF writes down how it went.
enum class KeepHistory { yes, no };

/// Continuous-discrete extended Kalman filter over 3 attitude errors and the layout's parameters:
/// between samples the platform equation is integrated at the running estimate (IntervalStep).
class Ekf {
 public:
  /// The timeline must outlive the filter. start: library values of the initial estimate.
  Ekf(const FilterSpec& filter, const Timeline& timeline, const Readout& readout,
      const Theta& start, KeepHistory keep = KeepHistory::yes);

  /// As if built anew from this start; allocates nothing.
  void reset(const Theta& start);

  /// Takes in the measurements of interval i; intervals come in order. ContractError if the
  /// timeline has no such interval.
  void process(std::size_t i, const Vec3& acc, const Vec3& gimbal);

  EstimateResult result() const;
  const EkfHistory& history() const { return history_; }  ///< empty unless kept
  const InnovationSums& innovations() const { return step_.innovations(); }
  double nis() const { return innovations().nis; }
  std::size_t scalars() const { return innovations().scalars; }
  double lag1() const { return innovations().lag1(); }
  EstimateStatus status() const { return step_.status(); }
  const std::string& cause() const { return step_.cause(); }
  double t_diverged() const { return step_.t_diverged(); }      ///< [s]
  double sigma(std::size_t k) const { return step_.sigma(k); }  ///< of state k, SI
  const VecX& x() const { return step_.x(); }                   ///< as IntervalStep::x()
  const Covariance& covariance() const { return step_.covariance(); }
  /// Covariance of x(), without a copy. At the end of a run.
  auto settled_covariance() {
    step_.covariance().settle();
    return step_.covariance().settled();
  }
  const Theta& theta() const { return step_.theta(); }

 private:
  const Timeline& timeline_;
  IntervalStep step_;
  VecX start_;
  EkfHistory history_;
  KeepHistory keep_;
};

/// Runs the filter over a whole recording. ContractError if what was measured has other columns
/// than the timeline intervals.
EstimateResult run_ekf(const FilterSpec& filter, const MeasuredTest& test, const Theta& start,
                       EkfHistory* history = nullptr);

}  // namespace drift
