#pragma once

#include "core/estimate/compressed/stretch_rows.hpp"
#include "core/estimate/sequential/attitude_filter.hpp"

namespace drift {

/// Products of neighbouring residuals of the samples of stretches, at an estimate, less what the
/// fit makes of white ones: with rows J over attitude and parameters and their covariance P, those
/// of neighbours k, l have the covariance -J_k P J_l^T. The noise is white, so the attitude
/// anywhere follows from that at the end of the chain.
class StretchLag {
 public:
  /// The test must outlive it. width: of a row of the information.
  StretchLag(const CompressedTest& test, const Layout& layout, std::size_t width);

  /// Interval i, linearised: its rows where it is a stretch.
  void keep(std::size_t i, const StretchRows& rows, const IntervalSensitivity& sensitivity);
  /// Adds the products, and how many. ends: the attitude at the end of each chain; moved: the
  /// parameters, from the reference; information: on them, factorised. Allocates nothing from the
  /// second time on.
  void add(const std::vector<AttitudeFilter>& ends, const VecX& moved,
           const Information& information, double& lagged, std::size_t& pairs);

 private:
  struct Kept {
    StretchRows::Rows accelerometers, gimbals;
    Mat3 Phi;  ///< from the beginning to the end
    Rows3 G;
  };
  void add_channel(const StretchChannel& channel, const StretchRows::Rows& rows,
                   const AttitudeFilter& end, const VecX& moved, const Information& information,
                   double& lagged, std::size_t& pairs);

  const CompressedTest& test_;
  Eigen::Index rate_, states_;
  std::vector<Kept> kept_;
  // psi at the beginning of an interval = M psi(end of the chain) + N x(rate states).
  Mat3 M_ = Mat3::Identity();
  Eigen::Matrix<double, 3, Eigen::Dynamic> N_, work_;
  StretchRows::Rows by_parameters_;  ///< the attitude as the parameters have it, whitened
  Eigen::Matrix<double, Eigen::Dynamic, 3> by_end_, by_rest_;
  VecX residual_, of_samples_;
  MatX products_;
};

}  // namespace drift
