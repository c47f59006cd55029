#include "core/estimate/iterated_ekf.hpp"

#include <algorithm>

namespace drift {

IteratedEkf::IteratedEkf(const FilterSpec& filter, const Timeline& timeline, const Readout& readout,
                         const Theta& start)
    : timeline_(timeline),
      extended_(filter, timeline, readout, About::estimate),
      linear_(filter, timeline, readout, About::reference),
      reference_(timeline, filter.model()),
      x_(extended_.layout().scaled(start)),
      x_start_(x_),
      x_reference_(x_),
      dx_(x_),
      theta_(start) {}

void IteratedEkf::run(const Measurements& measured, const Theta& start) {
  extended_pass(measured, start);
  if (extended_.status() != EstimateStatus::ok) return;
  x_ = extended_.x();
  constexpr int most_passes = 4;
  for (int pass = 0; pass < most_passes; ++pass) {
    linear_pass(measured);
    if (linear_.status() != EstimateStatus::ok) return;
    if (largest_step() < 1.0) return;  // what is left is of second order in less than a sigma
  }
}

void IteratedEkf::extended_pass(const Measurements& measured, const Theta& start) {
  const Layout& layout = extended_.layout();
  for (std::size_t k = 0; k < layout.size(); ++k) x_start_[k] = layout.scaled(start, k);
  extended_.reset(x_start_, layout.theta_at(x_start_));
  for (std::size_t i = 0; i < timeline_.intervals.size(); ++i) {
    extended_.process(i, measured.acc.col(i), measured.gimbal.col(i));
    reference_.end_chain(timeline_.intervals[i], extended_.phi());
  }
}

void IteratedEkf::linear_pass(const Measurements& measured) {
  x_reference_ = x_;
  theta_ = linear_.layout().theta_at(x_reference_);
  reference_.place(theta_);
  dx_ = x_start_ - x_reference_;
  linear_.reset(dx_, theta_);
  for (std::size_t i = 0; i < timeline_.intervals.size(); ++i) {
    const Interval& interval = timeline_.intervals[i];
    linear_.process(i, measured.acc.col(i), measured.gimbal.col(i), reference_.nodes(interval));
    reference_.end_chain(interval, linear_.phi());
  }
  x_ = x_reference_ + linear_.x();
  theta_ = linear_.layout().theta_at(x_);
}

double IteratedEkf::largest_step() const {
  double largest = 0.0;
  for (std::size_t k = 0; k < linear_.layout().size(); ++k)
    largest =
        std::max(largest, std::abs(linear_.x()[k]) / std::sqrt(linear_.covariance().variance(k)));
  return largest;
}

}  // namespace drift
