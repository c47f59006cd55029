#include "analysis/strapdown/checks/instrument_fit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "analysis/search/fitted.hpp"
#include "core/estimate/batch_problem.hpp"
#include "core/stats/chi_square.hpp"
#include "core/stats/chi_square_band.hpp"

namespace drift::strapdown {
namespace {

/// The part of a row's square that goes into the estimates: j P j', j = [psi of its chain, x], by
/// blocks. Of two rows of a chain together, of their sum.
class Leverage {
 public:
  Leverage(const Evaluation& at, const MatX& covariance) : P_(covariance) {
    for (const ChainEquations& c : at.rows) {
      const Eigen::Index n = P_.cols();
      const MatX psi = c.rows.leftCols<3>();
      const Mat3 inverse = (Mat3::Identity() + psi.transpose() * psi).inverse();
      chains_.push_back({inverse, inverse * psi.transpose() * c.rows.middleCols(3, n)});
    }
  }

  /// row: [psi, x], and what may follow.
  double of(const VecX& row, std::size_t chain) const {
    const auto& [inverse, by_x] = chains_[chain];
    const Vec3 psi = row.head<3>();
    return psi.dot(inverse * psi) +
           of_parameters(row.segment(3, P_.cols()) - by_x.transpose() * psi);
  }
  double of_parameters(const VecX& x) const { return x.dot(P_ * x); }

 private:
  struct Chain {
    Mat3 inverse;
    MatX by_x;  ///< shape (3, parameters): how the attitude follows them
  };
  MatX P_;
  std::vector<Chain> chains_;
};

/// Rows of a dwell that are added up, each of unit noise.
struct Sum {
  VecX row;
  double count = 0.0;
  void add(const VecX& r) {
    if (count == 0.0) row = VecX::Zero(r.size());
    row += r;
    count += 1.0;
  }
  VecX mean() const { return row / std::sqrt(count); }
};

/// A test linearised where a fit ended.
Evaluation linearised(FilterSpec filter, const MeasuredTest& test, const BatchResult& fit,
                      double walk) {
  filter.noise.angle_random_walk = walk;
  BatchProblem problem(filter, test);
  problem.take_every_sample();
  const VecX x = problem.layout().scaled(theta_of(filter, fit));
  const std::vector<Vec3> psi = problem.scaled(fit.psi0_l);
  problem.whiten_at(x, psi);
  return problem.evaluate(x, psi);
}

class Instruments {
 public:
  Instruments(const FilterSpec& filter, const MeasuredTest& test, const BatchResult& fit)
      : test_(test),
        n_(fit.estimate.covariance.cols()),
        white_(linearised(filter, test, fit, filter.noise.angle_random_walk)),
        plain_(linearised(filter, test, fit, 0.0)),
        leverage_(white_, fit.estimate.covariance) {}

  std::vector<InstrumentFit> fits() {
    take_rows();
    for (const auto& [dwell, sum] : gravity_) {
      const VecX row = sum.mean();
      // The length of what is read knows nothing of the attitude.
      add(Instrument::gravity, row[3 + n_], leverage_.of_parameters(row.segment(3, n_)));
    }
    for (const auto& [of, sum] : gyros_) {
      const VecX row = sum.mean();
      add(Instrument::gyros, row[3 + n_], leverage_.of(row, of[1]));
    }
    std::vector<InstrumentFit> out;
    for (InstrumentFit& f : sums_)
      if (f.dof >= 1.0) out.push_back(f);
    return out;
  }

 private:
  void add(Instrument of, double residual, double leverage) {
    InstrumentFit& f = sums_[static_cast<std::size_t>(of)];
    f.chi2 += residual * residual;
    f.dof += 1.0 - leverage;
  }

  /// In the order in which they were made: by interval, accelerometers before gyros.
  void take_rows() {
    const auto& [timeline, readout, measured] = test_;
    std::vector<Eigen::Index> next(static_cast<std::size_t>(timeline.chains), 0);
    for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
      const auto chain = static_cast<std::size_t>(timeline.intervals[i].chain);
      const auto column = static_cast<Eigen::Index>(i);
      const auto count = [&](bool read, const Mat3X& of) {
        return read ? of.col(column).array().isFinite().count() : Eigen::Index{0};
      };
      const Eigen::Index acc = count(readout.accelerometers, measured.acc),
                         gyro = count(readout.gimbals, measured.gimbal);
      if (acc == 3) take_accelerometers(timeline.intervals[i], column, next[chain]);
      for (Eigen::Index k = 0; k < gyro; ++k) {
        const auto axis = static_cast<std::size_t>(k);  // all three, or none
        gyros_[{static_cast<std::size_t>(timeline.intervals[i].position), chain, axis}].add(
            white_.rows[chain].rows.row(next[chain] + acc + k));
      }
      next[chain] += acc + gyro;
    }
  }

  void take_accelerometers(const Interval& interval, Eigen::Index column, Eigen::Index first) {
    const auto chain = static_cast<std::size_t>(interval.chain);
    const MatX& rows = white_.rows[chain].rows;
    double chi2 = 0.0, leverage = 0.0;
    for (Eigen::Index k = first; k < first + 3; ++k) {
      chi2 += rows(k, 3 + n_) * rows(k, 3 + n_);
      leverage += leverage_.of(rows.row(k), chain);
    }
    if (interval.slew) {
      InstrumentFit& f = sums_[static_cast<std::size_t>(Instrument::read_in_turn)];
      f.chi2 += chi2;
      f.dof += 3.0 - leverage;
      return;
    }
    // The one combination of the three that no attitude moves: noise of the gyros adds nothing to
    // it, and there the rows are white as they are. (A bias of 0.1 g turns what is read by 6 deg.)
    const MatX plain = plain_.rows[chain].rows.middleRows<3>(first);
    const Mat3 by_attitude = plain.leftCols<3>() * plain.leftCols<3>().transpose();
    const Vec3 length = Eigen::SelfAdjointEigenSolver<Mat3>(by_attitude).eigenvectors().col(0);
    // One sign from row to row, as they are added up: that of what is read.
    const double sign = length.dot(test_.measured.acc.col(column)) < 0.0 ? -1.0 : 1.0;
    const VecX along = sign * plain.transpose() * length;
    gravity_[interval.position].add(along);
    InstrumentFit& f = sums_[static_cast<std::size_t>(Instrument::direction)];
    f.chi2 += std::max(0.0, chi2 - along[3 + n_] * along[3 + n_]);
    f.dof += 2.0 - (leverage - leverage_.of_parameters(along.segment(3, n_)));
  }

  const MeasuredTest& test_;
  Eigen::Index n_;
  Evaluation white_, plain_;
  Leverage leverage_;
  std::map<int, Sum> gravity_;                       // by dwell
  std::map<std::array<std::size_t, 3>, Sum> gyros_;  // by dwell, chain, axis
  std::array<InstrumentFit, 4> sums_{{{Instrument::gravity, 0.0, 0.0},
                                      {Instrument::direction, 0.0, 0.0},
                                      {Instrument::gyros, 0.0, 0.0},
                                      {Instrument::read_in_turn, 0.0, 0.0}}};
};

}  // namespace

double InstrumentFit::chance() const {
  return std::exp(stats::log_tail(chi2, dof));
}

double InstrumentFit::factor() const {
  return std::sqrt(per_dof());
}

std::vector<InstrumentFit> instrument_fits(const FilterSpec& filter, const MeasuredTest& test,
                                           const BatchResult& fit) {
  if (fit.estimate.status == EstimateStatus::diverged || !fit.estimate.covariance.allFinite() ||
      fit.estimate.covariance.size() == 0 ||
      search::declared_noise(filter).drift_random_walk != 0.0)
    return {};
  return Instruments(filter, test, fit).fits();
}

bool too_large(const InstrumentFit& one, const std::vector<InstrumentFit>& all) {
  return one.chance() * static_cast<double>(all.size()) < 2.0 * stats::band_tail;
}

}  // namespace drift::strapdown
