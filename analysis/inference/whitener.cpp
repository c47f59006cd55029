#include "analysis/inference/whitener.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/noise/noise_states.hpp"

namespace drift::inference {

Whitener::Whitener(const MeasuredRows& rows, const NoiseModel& noise) : root_(rows.rows()) {
  const NoiseStates s(noise);
  states_ = s.count;
  H_.resize(s.count, rows.rows());
  gain_.resize(s.count, rows.rows());
  MatX P = initial_covariance(s, noise);
  Eigen::Index next = 0;
  walk(
      rows, noise, s,
      [&](std::size_t) {
        P.topRows<3>().setZero();
        P.leftCols<3>().setZero();
        P.topLeftCorner<3, 3>().setIdentity();
        events_.push_back({next, true, {}, {}});
      },
      [&](const NoiseStep& step) {
        P = (step.F * P * step.F.transpose() + step.Q).eval();
        const int others = s.count - 3;
        if (others > 0)
          events_.push_back(
              {next, false, step.F.topRightCorner(3, others), step.F.diagonal().tail(others)});
      },
      [&](Eigen::Index k, const VecX& h, double sigma) {
        const VecX Ph = P * h;
        const double S = h.dot(Ph) + sigma * sigma;
        H_.col(k) = h;
        gain_.col(k) = Ph / S;
        root_[k] = std::sqrt(S);
        P -= gain_.col(k) * Ph.transpose();
        log_det_ += std::log(S);
        next = k + 1;
      });
}

void Whitener::move(const Event& event, RowMajor& x) const {
  if (event.cage) {
    x.topRows<3>().setZero();
    return;
  }
  const auto others = states_ - 3;
  x.topRows<3>() += event.drive.lazyProduct(x.bottomRows(others));
  x.bottomRows(others).array().colwise() *= event.decay.array();
}

template <class Row>
MatX Whitener::run(MatX columns, Eigen::Index first, Row&& row) const {
  constexpr Eigen::Index at_once = 64;  // columns: row by row they stay in the cache
  for (Eigen::Index start = 0; start < columns.cols(); start += at_once) {
    auto some = columns.middleCols(start, std::min(at_once, columns.cols() - start));
    RowMajor part = some;
    RowMajor x = RowMajor::Zero(states_, part.cols());  // state estimate of every column
    auto event = events_.begin();
    while (event != events_.end() && event->row < first) ++event;
    for (Eigen::Index r = 0; r < part.rows(); ++r) {
      for (; event != events_.end() && event->row == first + r; ++event) move(*event, x);
      row(part.row(r), first + r, x);
    }
    some = part;
  }
  return columns;
}

MatX Whitener::apply(MatX columns, Eigen::Index first) const {
  return run(std::move(columns), first, [&](auto e, Eigen::Index k, RowMajor& x) {
    for (int m = 0; m < states_; ++m)
      if (H_(m, k) != 0.0) e -= H_(m, k) * x.row(m);
    for (int m = 0; m < states_; ++m)
      if (gain_(m, k) != 0.0) x.row(m) += gain_(m, k) * e;
    e /= root_[k];
  });
}

MatX Whitener::colour(MatX white) const {
  return run(std::move(white), 0, [&](auto y, Eigen::Index k, RowMajor& x) {
    y *= root_[k];
    const Eigen::RowVectorXd innovation = y;
    for (int m = 0; m < states_; ++m)
      if (H_(m, k) != 0.0) y += H_(m, k) * x.row(m);
    for (int m = 0; m < states_; ++m)
      if (gain_(m, k) != 0.0) x.row(m) += gain_(m, k) * innovation;
  });
}

}  // namespace drift::inference
