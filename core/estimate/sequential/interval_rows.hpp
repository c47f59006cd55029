#pragma once

#include "core/estimate/linearize.hpp"
#include "core/estimate/sequential/attitude_filter.hpp"
#include "core/estimate/stretch_jacobians.hpp"

namespace drift {

/// Makes whitened rows of what a sample interval has measured: linearises it about a given path,
/// and passes it through the filter of the attitude. Time, the memory of terms, terms in the
/// gimbals, drift noise and outliers are dealt with here. The mean specific force is taken in at
/// the middle of its interval, as the mean over the path through that attitude; the gimbal angles,
/// or what stands for them at rest (predict_rest_rate), at its end.
class IntervalRows {
 public:
  /// The timeline must outlive it.
  IntervalRows(const FilterSpec& filter, const Timeline& timeline, const Readout& readout);

  /// Of all intervals: triples of rows, at most.
  std::size_t most_triples() const { return 2 * timeline_.intervals.size(); }

  const Layout& layout() const { return layout_; }
  const DriftModel& model() const { return model_; }
  AttitudeFilter& attitude() { return attitude_; }
  const AttitudeFilter& attitude() const { return attitude_; }
  std::size_t width() const { return attitude_.width(); }  ///< of a row
  /// Whether what drives the platform at random may take it farther off the path of constant
  /// parameters, between two cagings and about one axis, than its attitude is unknown after them:
  /// one sigma of the drift that it has walked to by then, all the way.
  bool strays() const;

  /// Before the first interval. theta: what is linearised about.
  void reset(const Theta& theta);
  /// From here on, linearise about other parameters; the past is as if they had held all along.
  void set_theta(const Theta& theta);
  /// Moves the memory of the terms on over interval i, in order; that of its steps, null where
  /// there is none.
  const StepMemory* enter(std::size_t i);
  /// Linearises the intervals first to end - 1 beforehand, together, where that is possible. path:
  /// rotation vector at every node of the timeline [rad].
  void look_ahead(std::size_t first, std::size_t end, const Vec3* path);
  /// A new attitude at the beginning of an interval: nominal within the prior, the path begins at
  /// phi.
  void cage(const Interval& interval, const Vec3& phi);

  /// Three rows of a channel.
  enum Channel : unsigned char { accelerometers = 0, gimbals = 1 };
  struct Taken {
    std::size_t triples = 0;  ///< of rows: none, one or two
    Channel channel[2] = {};  ///< of each
    std::size_t scalars = 0;  ///< measured and not gated
    bool ok = true;           ///< false: an innovation covariance is not positive definite
  };
  /// Rows of interval i, entered before and looked ahead to, about the same path. gate: null where
  /// nothing is gated.
  Taken take(std::size_t i, const Vec3& acc, const Vec3& gimbal, const Vec3* path,
             const AttitudeFilter::Gate* gate, double* rows);

 private:
  void take_triple(Channel channel, const AttitudeFilter::Scalars& scalars,
                   const AttitudeFilter::Gate* gate, double* rows, Taken& taken);

  FilterSpec filter_;
  const Timeline& timeline_;
  Readout readout_;
  DriftModel model_;
  Layout layout_;
  Linearizer linearizer_;
  bool together_;
  StretchJacobians jacobians_;
  IntervalSensitivity sensitivity_;
  MemoryPath memory_;
  AttitudeFilter attitude_;
  Theta theta_;
  MeanOutput mean_;
  Rows3 rest_G_;
};

}  // namespace drift
