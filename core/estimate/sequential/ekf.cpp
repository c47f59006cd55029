#include "core/estimate/sequential/ekf.hpp"

#include <algorithm>

#include "core/base/check.hpp"

namespace drift {

Ekf::Ekf(const FilterSpec& filter, const Timeline& timeline, const Readout& readout,
         const Theta& start, KeepHistory keep)
    : timeline_(timeline),
      step_(filter, timeline, readout),
      start_(step_.layout().scaled(start)),
      keep_(keep) {
  const std::size_t n = keep == KeepHistory::yes ? timeline.intervals.size() : 0;
  history_.estimate.resize(step_.layout().size(), n);
  history_.sigma.resize(step_.layout().size(), n);
  history_.nis.resize(n);
  history_.scalars.resize(n);
  history_.t.resize(n);
  reset(start);
}

void Ekf::reset(const Theta& start) {
  const Layout& layout = step_.layout();
  for (std::size_t k = 0; k < layout.size(); ++k) start_[k] = layout.scaled(start, k);
  step_.reset(start_, layout.theta_at(start_));
  history_.estimate.setZero();
  history_.sigma.setZero();
  std::fill(history_.nis.begin(), history_.nis.end(), 0.0);
  std::fill(history_.scalars.begin(), history_.scalars.end(), 0);
  std::fill(history_.t.begin(), history_.t.end(), 0.0);
}

void Ekf::process(std::size_t i, const Vec3& acc, const Vec3& gimbal) {
  DRIFT_DEMAND(i < timeline_.intervals.size());
  const IntervalStep::Taken taken = step_.process(i, acc, gimbal);
  if (keep_ == KeepHistory::no) return;
  history_.t[i] = timeline_.intervals[i].t1;
  history_.nis[i] = taken.nis;
  history_.scalars[i] = taken.scalars;
  if (status() != EstimateStatus::ok) return;
  for (std::size_t k = 0; k < step_.layout().size(); ++k) {
    history_.estimate(k, i) = theta()[step_.layout().params[k]];
    history_.sigma(k, i) = sigma(k);
  }
}

EstimateResult Ekf::result() const {
  const auto n = static_cast<Eigen::Index>(step_.layout().size());
  const MatX P = step_.covariance().parameters().topLeftCorner(n, n);
  EstimateResult r;
  r.status = status();
  r.cause = cause();
  r.parameters = parameter_estimates(step_.layout(), start_, x().head(n), P);
  r.covariance = P;
  r.statistic = innovations().nis;
  r.measured = innovations().scalars;
  return r;
}

EstimateResult run_ekf(const FilterSpec& filter, const MeasuredTest& test, const Theta& start,
                       EkfHistory* history) {
  const auto& [timeline, readout, measured] = test;
  DRIFT_DEMAND(is_along(measured, timeline));
  Ekf ekf(filter, timeline, readout, start, history ? KeepHistory::yes : KeepHistory::no);
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i)
    ekf.process(i, measured.acc.col(i), measured.gimbal.col(i));
  if (history) *history = ekf.history();
  return ekf.result();
}

}  // namespace drift
