#pragma once

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
  double cost = 0.0;  ///< data + prior

  double data_cost() const;
};

/// The rows of each chain by their triangles.
BatchEquations compressed(const Evaluation& e);

/// A filter's model and a test: the cost that a batch fit lowers.
class BatchProblem {
 public:
  /// The test must outlive it.
  BatchProblem(const FilterSpec& filter, const MeasuredTest& test);

  const MeasuredTest& test() const { return test_; }
  const Layout& layout() const { return equations_.layout(); }
  bool walks() const { return angle_random_walk_ > 0.0; }
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

 private:
  std::vector<ChainEquations> rows_at(const VecX& x, const std::vector<Vec3>& psi);

  MeasuredTest test_;
  DriftModel model_;
  MeasurementEquations equations_;
  PathInLanes lanes_;
  bool in_lanes_;
  double sigma_psi_;
  double angle_random_walk_;
  std::vector<MatX> white_at_;
  Trajectory phi_;
};

}  // namespace drift
