#include "core/estimate/random_walk.hpp"

#include <cmath>

namespace drift {
namespace {

/// One chain's filter.
class Innovations {
 public:
  Innovations(MatX& rows, const MatX& attitude)
      : rows_(rows), attitude_(attitude), walked_(Mat3X::Zero(3, rows.cols())) {}

  void let_walk(double variance) { P_.diagonal().array() += variance; }

  /// Takes in the next row: what is left of it beside the rows before, in its own sigmas.
  void whiten_next() {
    auto row = rows_.row(next_);
    const Vec3 h = attitude_.row(next_++);
    const Vec3 Ph = P_ * h;
    const double S = h.dot(Ph) + 1.0;
    row -= h.transpose() * walked_;
    walked_ += (Ph / S) * row;
    P_ -= (Ph / S) * Ph.transpose();
    row /= std::sqrt(S);
  }

 private:
  MatX& rows_;
  const MatX& attitude_;
  Mat3 P_ = Mat3::Zero();
  Mat3X walked_;  ///< estimate of what the walk has made, for every column
  Eigen::Index next_ = 0;
};

}  // namespace

void whiten_random_walk(const MeasuredTest& test, double walk, const std::vector<MatX>& attitudes,
                        std::vector<ChainEquations>& chains) {
  const auto& [timeline, readout, measured] = test;
  std::vector<Innovations> filters;
  for (std::size_t c = 0; c < chains.size(); ++c)
    filters.emplace_back(chains[c].rows, attitudes[c]);
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    const Interval& interval = timeline.intervals[i];
    Innovations& filter = filters[static_cast<std::size_t>(interval.chain)];
    const double half = interval.rest ? 0.0 : 0.5 * walk * walk * interval.length();
    const auto column = static_cast<Eigen::Index>(i);
    const auto take = [&](bool read, const Mat3X& of) {
      filter.let_walk(half);
      for (int a = 0; read && a < 3; ++a)
        if (std::isfinite(of(a, column))) filter.whiten_next();
    };
    take(readout.accelerometers, measured.acc);
    take(readout.gimbals, measured.gimbal);
  }
}

std::vector<MatX> attitude_columns(const std::vector<ChainEquations>& chains) {
  std::vector<MatX> all;
  for (const ChainEquations& c : chains) all.emplace_back(c.rows.leftCols<3>());
  return all;
}

}  // namespace drift
