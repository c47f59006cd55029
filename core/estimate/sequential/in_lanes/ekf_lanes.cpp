#include "core/estimate/sequential/in_lanes/ekf_lanes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"

namespace drift {

EkfLanes::EkfLanes(const FilterSpec& filter, const Timeline& timeline, const Readout& readout)
    : along_(filter, timeline, readout),
      timeline_(timeline),
      P_(along_.layout().size()),
      x_(along_.layout().size()),
      step_(x_) {}

void EkfLanes::run(std::span<EkfJob> jobs) {
  for (std::size_t first = 0; first < jobs.size(); first += width)
    run_pack(jobs.subspan(first, std::min(width, jobs.size() - first)), {});
}

void EkfLanes::run(std::span<EkfJob> jobs, std::span<EkfHistory> histories) {
  DRIFT_DEMAND(jobs.size() == histories.size());
  for (std::size_t first = 0; first < jobs.size(); first += width) {
    const std::size_t count = std::min(width, jobs.size() - first);
    for (EkfHistory& history : histories.subspan(first, count)) begin(history);
    run_pack(jobs.subspan(first, count), histories.subspan(first, count));
  }
}

void EkfLanes::begin(EkfHistory& history) const {
  const auto n = static_cast<Eigen::Index>(along_.layout().size()),
             intervals = static_cast<Eigen::Index>(timeline_.intervals.size());
  history = {};
  history.estimate.setZero(n, intervals);
  history.sigma.setZero(n, intervals);
  history.nis.assign(timeline_.intervals.size(), 0.0);
  history.scalars.assign(timeline_.intervals.size(), 0);
  history.t.assign(timeline_.intervals.size(), 0.0);
}

void EkfLanes::begin(std::span<EkfJob> jobs) {
  lanes_ = jobs;
  for (EkfJob& job : jobs) {
    DRIFT_DEMAND(job.measured != nullptr && is_along(*job.measured, timeline_));
    job.begin_anew();
  }
  for (std::size_t l = 0; l < width; ++l)
    recordings_[l] = jobs[std::min(l, jobs.size() - 1)].measured;
  for (std::size_t k = 0; k < x_.size(); ++k)
    x_[k] = Pack::of_each([&](int l) {
      const std::size_t lane = std::min(static_cast<std::size_t>(l), jobs.size() - 1);
      return along_.layout().scaled(jobs[lane].start, k);
    });
  along_.set_theta(x_);
  along_.attitude().reset();
  P_.reset();
  nis_ = lagged_ = scalars_ = pairs_ = Pack(0.0);
  before_ = {};
}

void EkfLanes::run_pack(std::span<EkfJob> jobs, std::span<EkfHistory> histories) {
  begin(jobs);
  const auto& all = timeline_.intervals;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Interval& interval = all[i];
    along_.phi(interval.first_node) =
        interval.cage ? PackVec(PackVec::Zero()) : along_.phi(all[i - 1].last_node());
    if (interval.cage) along_.cage(interval);
    along_.forward(interval);
    along_.linearize(i, false);
    along_.to_middle(interval);
    if (along_.readout().accelerometers) {
      const auto middle = static_cast<std::size_t>(interval.substeps);
      take(interval, interval.first_node + middle, LaneIntervals::accelerometers,
           along_.read_accelerometers(i, recordings_));
      along_.forward(interval, middle);
    }
    along_.to_end(interval);
    if (along_.readout().gimbals)
      take(interval, interval.last_node(), LaneIntervals::gimbals,
           along_.read_gimbals(i, recordings_));
    for (std::size_t l = 0; l < histories.size(); ++l) keep(i, l, histories[l]);
  }
  finish();
}

/// Three scalars at a node: the estimate, the path and what the rest is linearised about move.
void EkfLanes::take(const Interval& interval, std::size_t node, Channel channel,
                    LaneFilter::Scalars scalars) {
  along_.attitude().update(scalars, P_);
  const PackVec white = P_.take(step_);
  for (std::size_t k = 0; k < x_.size(); ++k) x_[k] += step_[k];
  // Where nothing was measured, the sample before stays the last one.
  Before& last = before_[channel];
  Pack any(0.0);
  for (int a = 0; a < 3; ++a) {
    nis_ = mul_add(white[a], white[a], nis_);
    scalars_ += scalars.on[a];
    lagged_ = mul_add(last.white[a], white[a], lagged_);
    pairs_ = mul_add(last.on[a], scalars.on[a], pairs_);
    any = Pack(std::experimental::max(any.v, scalars.on[a].v));
  }
  for (int a = 0; a < 3; ++a) {
    last.white[a] = mul_add(any, white[a] - last.white[a], last.white[a]);
    last.on[a] = mul_add(any, scalars.on[a] - last.on[a], last.on[a]);
  }
  const PackVec psi = along_.attitude().attitude(step_);
  PackVec& phi = along_.phi(node);
  const PackVec turned = along_.turned(node, psi, phi);
  for (std::size_t l = 0; l < lanes_.size(); ++l) {
    const int lane = static_cast<int>(l);
    if (lane_of(psi, lane).allFinite()) set_lane(phi, lane, lane_of(turned, lane));
  }
  along_.attitude().move_reference();
  along_.set_theta(x_);
  notice_divergence(interval.t1);
}

void EkfLanes::notice_divergence(double t) {
  Pack largest(0.0), sum = nis_;
  for (const Pack& x : x_) {
    largest = Pack(std::experimental::max(largest.v, abs(x).v));
    sum += x;
  }
  for (std::size_t l = 0; l < lanes_.size(); ++l) {
    const int lane = static_cast<int>(l);
    EkfJob& job = lanes_[l];
    if (job.status_ != EstimateStatus::ok) continue;
    if (std::isfinite(sum[lane]) && largest[lane] <= 1e6) continue;
    job.status_ = EstimateStatus::diverged;
    job.t_diverged_ = t;
    job.cause_ =
        fmt::format("filter diverged at t = {:.6g} s (estimate beyond 1e6 prior sigma)", t);
  }
}

void EkfLanes::finish() {
  const Layout& layout = along_.layout();
  const auto n = static_cast<Eigen::Index>(layout.size());
  for (std::size_t l = 0; l < lanes_.size(); ++l) {
    const int lane = static_cast<int>(l);
    EkfJob& job = lanes_[l];
    if (job.status_ != EstimateStatus::ok) continue;
    job.nis_ = nis_[lane];
    job.scalars_ = static_cast<std::size_t>(scalars_[lane]);
    job.lag1_ = pairs_[lane] > 0.0 && nis_[lane] > 0.0
                    ? lagged_[lane] / nis_[lane] * scalars_[lane] / pairs_[lane]
                    : 0.0;
    job.x_.resize(n);
    job.sigma_.resize(n);
    for (Eigen::Index k = 0; k < n; ++k) job.x_[k] = x_[static_cast<std::size_t>(k)][lane];
    job.theta_ = layout.theta_at(job.x_);
    P_.extract(lane, job.P_);
    for (Eigen::Index k = 0; k < n; ++k) job.sigma_[k] = layout.sigma[k] * std::sqrt(job.P_(k, k));
  }
}

/// How one of them stands after interval i.
void EkfLanes::keep(std::size_t i, std::size_t lane, EkfHistory& history) {
  const int l = static_cast<int>(lane);
  EkfJob& job = lanes_[lane];
  history.t[i] = timeline_.intervals[i].t1;
  if (job.status_ != EstimateStatus::ok) return;
  const auto scalars = static_cast<std::size_t>(scalars_[l]);
  history.nis[i] = nis_[l] - job.nis_;
  history.scalars[i] = static_cast<int>(scalars - job.scalars_);
  job.nis_ = nis_[l];
  job.scalars_ = scalars;
  const Layout& layout = along_.layout();
  const auto column = static_cast<Eigen::Index>(i);
  job.x_.resize(static_cast<Eigen::Index>(x_.size()));
  for (std::size_t k = 0; k < x_.size(); ++k) job.x_[static_cast<Eigen::Index>(k)] = x_[k][l];
  job.theta_ = layout.theta_at(job.x_);
  for (std::size_t k = 0; k < x_.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    history.estimate(row, column) = job.theta_[static_cast<Eigen::Index>(layout.params[k])];
    history.sigma(row, column) = layout.sigma[row] * std::sqrt(P_.variance(k, l));
  }
}

}  // namespace drift
