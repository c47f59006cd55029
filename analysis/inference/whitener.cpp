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
  OverPairs P = initial_covariance(s, noise);
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
      [&](Eigen::Index k, const OverStates& h, double sigma) {
        const OverStates Ph = P * h;
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

template <class Row, class Done>
void Whitener::run(const Eigen::Ref<const MatX>& columns, Eigen::Index first, Row&& row,
                   Done&& done) const {
  constexpr Eigen::Index at_once = 64;                   // rows: they stay in the cache
  RowMajor x = RowMajor::Zero(states_, columns.cols());  // state estimate of every column
  RowMajor part(std::min(at_once, columns.rows()), columns.cols());
  auto event = events_.begin();
  while (event != events_.end() && event->row < first) ++event;
  for (Eigen::Index start = 0; start < columns.rows(); start += at_once) {
    const Eigen::Index count = std::min(at_once, columns.rows() - start);
    part.topRows(count) = columns.middleRows(start, count);
    for (Eigen::Index r = 0; r < count; ++r) {
      const Eigen::Index k = first + start + r;
      for (; event != events_.end() && event->row == k; ++event) move(*event, x);
      row(part.row(r), k, x);
    }
    done(part.topRows(count), start);
  }
}

void Whitener::whiten_row(Eigen::Block<RowMajor, 1, Eigen::Dynamic, true> e, Eigen::Index k,
                          RowMajor& x) const {
  for (int m = 0; m < states_; ++m)
    if (H_(m, k) != 0.0) e -= H_(m, k) * x.row(m);
  for (int m = 0; m < states_; ++m)
    if (gain_(m, k) != 0.0) x.row(m) += gain_(m, k) * e;
  e /= root_[k];
}

MatX Whitener::apply(MatX columns, Eigen::Index first) const {
  run(
      columns, first, [&](auto e, Eigen::Index k, RowMajor& x) { whiten_row(e, k, x); },
      [&](const auto& white, Eigen::Index start) {
        columns.middleRows(start, white.rows()) = white;
      });
  return columns;
}

MatX Whitener::products(const MatX& columns) const {
  MatX sum = MatX::Zero(columns.cols(), columns.cols());
  run(
      columns, 0, [&](auto e, Eigen::Index k, RowMajor& x) { whiten_row(e, k, x); },
      [&](const auto& white, Eigen::Index) {
        sum.selfadjointView<Eigen::Lower>().rankUpdate(white.transpose());
      });
  return sum;
}

MatX Whitener::colour(MatX white) const {
  run(
      white, 0,
      [&](auto y, Eigen::Index k, RowMajor& x) {
        y *= root_[k];
        const Eigen::RowVectorXd innovation = y;
        for (int m = 0; m < states_; ++m)
          if (H_(m, k) != 0.0) y += H_(m, k) * x.row(m);
        for (int m = 0; m < states_; ++m)
          if (gain_(m, k) != 0.0) x.row(m) += gain_(m, k) * innovation;
      },
      [&](const auto& coloured, Eigen::Index start) {
        white.middleRows(start, coloured.rows()) = coloured;
      });
  return white;
}

}  // namespace drift::inference
