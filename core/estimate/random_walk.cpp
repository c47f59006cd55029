#include "core/estimate/random_walk.hpp"

#include <cmath>

#include "core/sim/held_noise.hpp"

namespace drift {
namespace {

/// One chain's filter: three of the attitude, three of the noise.
class Innovations {
 public:
  Innovations(MatX& rows, const MatX& attitude)
      : rows_(rows), attitude_(attitude), moved_(MatX6::Zero(6, rows.cols())) {}

  void hold(double variance) {
    P_.bottomRows<3>().setZero();
    P_.rightCols<3>().setZero();
    P_.diagonal().tail<3>().setConstant(variance);
    moved_.bottomRows<3>().setZero();
  }

  /// The attitude moves by N n.
  void drive(const Mat3& N) {
    moved_.topRows<3>() += N * moved_.bottomRows<3>();
    P_.topRows<3>() += N * P_.bottomRows<3>();
    P_.leftCols<3>() += P_.rightCols<3>() * N.transpose();
  }

  /// The attitude gains a covariance that nothing before it feels.
  void disturb(const Mat3& covariance) { P_.topLeftCorner<3, 3>() += covariance; }

  /// Takes in the next row: what is left of it beside the rows before, in its own sigmas. beside:
  /// what it feels of the noise besides.
  void whiten_next(const Vec3& beside) {
    auto row = rows_.row(next_);
    Vec6 h;
    h << attitude_.row(next_++).transpose(), beside;
    const Vec6 Ph = P_ * h;
    const double S = h.dot(Ph) + 1.0;
    row -= h.transpose() * moved_;
    moved_ += (Ph / S) * row;
    P_ -= (Ph / S) * Ph.transpose();
    row /= std::sqrt(S);
  }

 private:
  using Vec6 = Eigen::Matrix<double, 6, 1>;
  using MatX6 = Eigen::Matrix<double, 6, Eigen::Dynamic>;
  MatX& rows_;
  const MatX& attitude_;
  Eigen::Matrix<double, 6, 6> P_ = Eigen::Matrix<double, 6, 6>::Zero();
  MatX6 moved_;  ///< estimate of the states, for every column
  Eigen::Index next_ = 0;
};

}  // namespace

void whiten_random_walk(const MeasuredTest& test, double walk, double sigma_psi,
                        const std::vector<MatX>& attitudes, std::vector<ChainEquations>& chains) {
  const auto& [timeline, readout, measured] = test;
  std::vector<Innovations> filters;
  for (std::size_t c = 0; c < chains.size(); ++c)
    filters.emplace_back(chains[c].rows, attitudes[c]);
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    const Interval& interval = timeline.intervals[i];
    Innovations& filter = filters[static_cast<std::size_t>(interval.chain)];
    const HeldNoise held = held_noise(interval, timeline);
    // In units of the attitude's prior and of the rows' sigmas.
    const double variance = walk * walk / (interval.length() * sigma_psi * sigma_psi);
    filter.hold(variance);
    const Mat3 beside =
        sigma_psi / interval.accelerometer_noise(readout.accelerometer_noise) * held.beside;
    const auto column = static_cast<Eigen::Index>(i);
    const auto take = [&](bool read, const Mat3X& of, const Mat3& by_noise) {
      for (int a = 0; read && a < 3; ++a)
        if (std::isfinite(of(a, column))) filter.whiten_next(by_noise.row(a));
    };
    filter.drive(held.to_middle);
    take(readout.accelerometers, measured.acc, beside);
    filter.drive(held.from_middle);
    filter.disturb(variance * held.anew * held.anew.transpose());
    take(readout.gimbals, measured.gimbal, Mat3::Zero());
  }
}

std::vector<MatX> attitude_columns(const std::vector<ChainEquations>& chains) {
  std::vector<MatX> all;
  for (const ChainEquations& c : chains) all.emplace_back(c.rows.leftCols<3>());
  return all;
}

}  // namespace drift
