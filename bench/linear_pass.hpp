#pragma once

#include "core/estimate/sequential/interval_rows.hpp"
#include "core/estimate/sequential/reference_path.hpp"
#include "core/sim/measurements.hpp"

namespace drift::bench {

/// A whole linear pass of the iterated estimator in information form: the path, its linearisation,
/// rows, normal equations, solution and covariance of all parameters.
class LinearPass {
 public:
  LinearPass(const FilterSpec& filter, const Timeline& timeline, const Readout& readout)
      : timeline_(timeline),
        rows_(filter, timeline, readout),
        path_(timeline, rows_.model()),
        information_(rows_.layout().size(), rows_.width()),
        store_(3 * rows_.most_triples() * rows_.width()),
        zero_(VecX::Zero(static_cast<Eigen::Index>(rows_.layout().size()))),
        covariance_(zero_.size(), zero_.size()) {}

  /// About theta, chains that end at the nominal attitude.
  const MatX& run(const Measurements& measured, const Theta& theta) {
    path_.place(theta);
    rows_.reset(theta);
    information_.clear();
    const std::size_t count = timeline_.intervals.size();
    for (std::size_t first = 0; first < count; first += at_once) {
      const std::size_t end = std::min(first + at_once, count);
      rows_.look_ahead(first, end, path_.nodes());
      std::size_t triples = 0;
      for (std::size_t i = first; i < end; ++i) {
        const Interval& interval = timeline_.intervals[i];
        rows_.enter(i);
        if (interval.cage) rows_.cage(interval, path_.nodes(interval)[0]);
        const auto column = static_cast<Eigen::Index>(i);
        triples += rows_
                       .take(i, measured.acc.col(column), measured.gimbal.col(column),
                             path_.nodes(), nullptr, &store_[3 * triples * rows_.width()])
                       .triples;
      }
      information_.add(store_.data(), 3 * triples);
    }
    information_.factorise();
    information_.solve(zero_);
    information_.invert(covariance_);
    return covariance_;
  }

 private:
  static constexpr std::size_t at_once = 8;  // intervals
  const Timeline& timeline_;
  IntervalRows rows_;
  ReferencePath path_;
  Information information_;
  std::vector<double> store_;
  VecX zero_;
  MatX covariance_;
};

}  // namespace drift::bench
