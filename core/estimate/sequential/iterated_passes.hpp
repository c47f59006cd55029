#pragma once

#include <limits>

#include "core/estimate/sequential/filter_estimate.hpp"
#include "core/estimate/sequential/interval_rows.hpp"
#include "core/estimate/sequential/reference_path.hpp"
#include "core/sim/measurements.hpp"

namespace drift {

/// An EKF that relinearises in blocks, then the same measurements once more, linearised about what
/// was found.
///
/// Both passes make whitened rows of a static least squares problem (AttitudeFilter) and solve it
/// in information form. The first relinearises about the running estimate after
/// blocks of twice as many samples each from the beginning of every stretch on; in between its
/// solution is exact. An EKF takes Jacobians at estimates that are still poor, and where parameters
/// enter as products (misalignment times drift or command) it ends surer than it should be
/// (physics.md 5.9). The second pass is linear in the deviations from a reference: the first one's
/// final parameters, and the attitude integrated back with them from its estimate at the end of
/// each chain. Its result is that of a Gauss-Newton step on all data at once, its cost at the
/// minimum is chi-square. While a pass moves some parameter by a posterior sigma or more there is
/// another, sixteen at most; mostly there is one. If the last still does, the filter has not
/// converged.
///
/// Where a drift or the attitude walks so far that no path of the parameters alone stays near
/// (IntervalRows::strays()), the reference of a linear pass is the filtered attitude itself, taken
/// over at the end of every block. After a caging it begins where the first sample of the pass
/// before has put it: less is known of it there than of a path that ends where all samples say.
class IteratedPasses : public FilterEstimate {
 public:
  static constexpr int most_passes = 16;  ///< linear ones

  /// The timeline must outlive the filter. start: library values of the initial estimate.
  IteratedPasses(const FilterSpec& filter, const Timeline& timeline, const Readout& readout,
                 const Theta& start);

  /// As if built anew from this start, over a whole recording. The estimate stays until the next
  /// run. Allocates nothing from the second time on. ContractError if the recording has other
  /// columns than the timeline intervals.
  const FilterEstimate& run(const Measurements& measured, const Theta& start);
  const Layout& layout() const { return rows_.layout(); }
  /// Why a filter has not converged, step: of its last pass, in posterior sigmas.
  static std::string still_moves(double step);

 private:
  enum class Pass { first, linear };
  bool first_pass(const Measurements& measured, const Theta& start);
  bool linear_pass(const Measurements& measured);
  bool along_reference(const Measurements& measured);
  bool along_filtered(const Measurements& measured);
  std::size_t end_of_block(std::size_t first, std::size_t& samples) const;
  bool take(std::size_t i, const Measurements& measured, const Vec3* path, Pass pass);
  bool take_block(std::size_t first, std::size_t end, const Measurements& measured, Vec3& phi,
                  Pass pass);
  void keep_start(std::size_t first, std::size_t end, const Vec3& phi);
  void add_rows();
  bool solve_block(const Interval& interval, Vec3& phi);
  bool diverged(bool finite, double t, Pass pass);
  double largest_step();  ///< of the last pass, in posterior sigmas
  void finish();
  void measure_lag();
  double* row(std::size_t k) { return store_.data() + k * rows_.width(); }

  const Timeline& timeline_;
  IntervalRows rows_;
  Information information_;
  PathInLanes lanes_;
  ReferencePath reference_;
  bool gated_, strays_;
  std::vector<double> store_;  ///< all rows of a pass
  /// Of three rows: their channel, and whether the interval before has some of it too; then (when
  /// lags are measured) the three rows before and after them, and whether they stand for both
  /// pairs.
  struct Neighbour {
    IntervalRows::Channel channel;
    bool follows;
    bool in_the_middle = false;
    std::size_t before = 0, after = 0;
  };
  std::vector<Neighbour> neighbours_;
  static constexpr std::size_t held_at_most = 24;   ///< rows that fit the first cache twice
  std::vector<double> residual_, middle_, beside_;  ///< work of measure_lag()
  /// Never the interval before another one: one more is no index.
  static constexpr std::size_t nothing_measured = std::numeric_limits<std::size_t>::max() - 1;
  std::size_t measured_last_[2] = {nothing_measured, nothing_measured};  ///< interval, by channel
  std::size_t triples_ = 0, summed_ = 0;  ///< rows by threes; summed up so far
  std::vector<AttitudeFilter> ends_;      ///< at the end of each chain
  VecX x_start_, x_reference_;
  VecX moved_;  ///< of the reference from the start; of the estimate from the reference
  VecX prior_, step_, nothing_;  ///< work
  std::vector<Vec3> path_;       ///< of a pass that follows the estimate, at every node
  std::vector<Vec3> starts_;     ///< where it begins after each caging
};

}  // namespace drift
