#pragma once

#include <array>
#include <deque>
#include <vector>

#include "core/estimate/compressed/polynomial_projection.hpp"
#include "core/estimate/measured_test.hpp"

namespace drift {

/// How one axis is read along a stretch.
struct AxisReading {
  std::vector<std::size_t> samples;  ///< of the stretch, those that were measured
  VecX sigma;                        ///< of each [unit]
  PolynomialProjection projection;
  MatX neighbours;  ///< sum of basis_k^T basis_{k+1} over samples that follow each other
};

/// What three axes of one kind have read along a stretch.
struct StretchChannel {
  struct Axis {
    const AxisReading* how = nullptr;  ///< null: nothing was measured
    VecX measured;                     ///< projections, whitened
    VecX left;                         ///< whitened samples less their smooth part
    Eigen::Index rows() const { return how ? measured.size() : 0; }
  };
  std::array<Axis, 3> axes;
  Vec3 reference = Vec3::Zero();  ///< what readings count from

  Eigen::Index rows() const { return axes[0].rows() + axes[1].rows() + axes[2].rows(); }
};

/// The readings of a stretch in which one thing is commanded.
struct StretchReadings {
  StretchChannel accelerometers;  ///< means [g]
  StretchChannel gimbals;         ///< angles at the ends of samples [rad]
  MatX integral;                  ///< from the beginning to each node, of values there [s]
};

/// A timeline whose long stretches of constant command are one interval each, and what was measured
/// along it: of a stretch, the projections of all its samples on a few polynomials of the time.
/// Along such a stretch everything turns with the Earth and the command, by an angle a that is
/// known, and what is predicted is made of products of up to three directions (g^2 terms, turned):
/// coefficients of degree k fall like (3 a / 4)^k / k!, and as many are kept as exceed 1e-10, and
/// two. What is left of the readings does not depend on the model: a constant of the
/// cost. Exact where noise is white and the model's terms ask for attitude and command alone; what
/// follows the clock, gimbal angles or the past, as far as so many polynomials follow it, which
/// StretchRows::tail tells.
class CompressedTest {
 public:
  /// Whether a model sees no more of a stretch than its beginning and end say. Covariates go from
  /// sample to sample as they like, and so does the turn of a case; friction remembers which way
  /// the gimbals turned, which may change between nodes that lie far apart.
  static bool can(const DriftModel& model) {
    const Needs needs = TermLibrary::needs(model.terms);
    return needs.covariates == 0 && !needs.turning && !(needs.memory && needs.gimbals);
  }
  /// Stretches as long as they are; or cut into pieces of which each is twice as long as the one
  /// before (first_block), for who looks anew from piece to piece.
  enum class Cut { nowhere, doubling };
  struct Options {
    std::vector<std::size_t> leave = {};  ///< first intervals of stretches that stay as they are
    int fewer = 2;  ///< a stretch stays as it is if its nodes do not become fewer by this factor
    Cut cut = Cut::nowhere;
  };
  /// The timeline and the readout must outlive it.
  CompressedTest(const Timeline& timeline, const Readout& readout, const Options& options);
  CompressedTest(const CompressedTest&) = delete;
  CompressedTest& operator=(const CompressedTest&) = delete;

  /// Whether anything was taken together.
  bool any() const { return !stretches_.empty(); }
  /// The stretches are intervals of it.
  const Timeline& timeline() const { return timeline_; }
  const Readout& readout() const { return readout_; }
  /// Takes in what was measured along the whole timeline. Allocates nothing from the second time on
  /// where nothing is missing.
  void read(const Measurements& measured);

  /// What was read, in stretches nothing.
  MeasuredTest test() const { return {timeline_, readout_, measured_}; }
  /// The readings of interval i if it is a stretch, else null.
  const StretchReadings* readings(std::size_t i) const {
    return of_interval_[i] < 0 ? nullptr
                               : &stretches_[static_cast<std::size_t>(of_interval_[i])].readings;
  }
  /// How an axis of interval i, which is a stretch, is read where nothing is missing.
  const AxisReading& complete(std::size_t i, Reading what) const {
    const Stretch& stretch = stretches_[static_cast<std::size_t>(of_interval_[i])];
    return what == Reading::mean ? stretch.means : stretch.ends;
  }
  /// The first of the intervals of the whole timeline that interval i stands for.
  std::size_t first(std::size_t i) const { return first_[i]; }
  /// How many of them.
  std::size_t samples(std::size_t i) const {
    return (i + 1 < first_.size() ? first_[i + 1] : whole_.intervals.size()) - first_[i];
  }
  /// Sum of squares of what no polynomial reaches.
  double left_over() const { return left_over_; }
  /// Scalars that were measured, all of them.
  std::size_t scalars() const { return scalars_; }

 private:
  struct Stretch {
    std::size_t first, end;  ///< intervals of the whole timeline
    std::size_t polynomials;
    MatX fit;
    AxisReading means, ends;  ///< where nothing is missing
    StretchReadings readings;
  };
  void take_alone(std::size_t i);
  void take_together(std::size_t first, std::size_t end, std::size_t polynomials, int substeps);
  void read_at_nodes(Stretch& stretch, const Interval& interval);
  AxisReading how_to_read(const Stretch& stretch, Reading what,
                          std::vector<std::size_t> samples) const;
  void read_channel(const Stretch& stretch, Reading what, const Mat3X& measured,
                    StretchChannel& channel);

  const Timeline& whole_;
  Readout readout_;
  Timeline timeline_;
  Measurements measured_;
  std::vector<std::size_t> first_;
  std::vector<int> of_interval_;
  std::vector<Stretch> stretches_;
  std::deque<AxisReading> with_gaps_;
  std::vector<double> values_;  ///< work: whitened readings
  double left_over_ = 0.0;
  std::size_t scalars_ = 0;
};

}  // namespace drift
