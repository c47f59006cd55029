#pragma once

#include <memory>
#include <optional>

#include "core/estimate/batch_equations.hpp"
#include "core/estimate/measurement_equations.hpp"
#include "core/sim/path_in_lanes.hpp"

namespace drift {

/// A test linearised at one point.
struct Evaluation {
  VecX x;                 ///< scaled parameters
  std::vector<Vec3> psi;  ///< attitude errors, scaled by their prior sigma
  std::vector<ChainEquations> rows;
  double cost = 0.0;       ///< data + prior
  double left_over = 0.0;  ///< of the data's cost: not in the rows

  double data_cost() const;
};

/// The rows of each chain by their triangles.
BatchEquations compressed(const Evaluation& e);

/// Rows of a test about the path of some parameters and attitudes.
class RowsAlongPath {
 public:
  /// The test must outlive it. Test: sample by sample or compressed.
  template <class Test>
  RowsAlongPath(const Test& test, const Timeline& timeline, const FilterSpec& filter);

  const Layout& layout() const { return equations_.layout(); }
  /// psi0_l: attitude error of each chain at its caging, local axes [rad].
  std::vector<ChainEquations> at(const Theta& theta, const std::vector<Vec3>& psi0_l);
  const std::vector<std::size_t>& too_rough() const { return equations_.too_rough(); }

 private:
  const Timeline& timeline_;
  DriftModel model_;
  MeasurementEquations equations_;
  PathInLanes lanes_;
  bool in_lanes_;
  Trajectory phi_;
};

/// A filter's model and a test: the cost that a batch fit lowers. Where the noise is white and the
/// terms allow it, on the way down long dwells are looked at through polynomials (CompressedTest).
class BatchProblem {
 public:
  /// The test must outlive it.
  BatchProblem(const FilterSpec& filter, const MeasuredTest& test);

  const MeasuredTest& test() const { return test_; }
  const Layout& layout() const { return samples_.layout(); }
  bool walks() const { return angle_random_walk_ > 0.0; }
  /// Whether the moment of a jump is estimated, in which the cost bends more than its rows say.
  bool jumps() const;
  /// Of the parameters, the one that multiplies others: the weight between the two equations where
  /// it is estimated.
  std::optional<Eigen::Index> multiplier() const;
  /// Its values for eq. (5) and eq. (6), scaled.
  std::vector<double> both_equations() const;
  /// Attitude errors in units of their prior, and in radians.
  std::vector<Vec3> scaled(const std::vector<Vec3>& psi0_l) const;
  std::vector<Vec3> unscaled(const std::vector<Vec3>& psi) const;

  /// With angle random walk: the cost of what evaluate() returns is that of the point at which the
  /// rows were made white last, here.
  void whiten_at(const VecX& x, const std::vector<Vec3>& psi);
  Evaluation evaluate(VecX x, std::vector<Vec3> psi);
  /// Whether that looks through polynomials; from then on no more.
  bool compressed() const { return compressed_ != nullptr; }
  void take_every_sample();

 private:
  std::vector<ChainEquations> rows_at(const VecX& x, const std::vector<Vec3>& psi);
  void compress();

  FilterSpec filter_;
  MeasuredTest test_;
  RowsAlongPath samples_;
  double sigma_psi_;
  double angle_random_walk_;
  std::vector<std::size_t> left_alone_;  ///< stretches that polynomials do not follow
  std::unique_ptr<CompressedTest> compressed_;
  std::unique_ptr<RowsAlongPath> stretches_;
  std::vector<MatX> white_at_;
};

}  // namespace drift
