#include <fmt/format.h>

#include "core/estimate/sequential/in_lanes/iterated_lanes.hpp"
#include "core/estimate/sequential/iterated_passes.hpp"

namespace drift {

void IteratedLanes::diverged(std::size_t lane, bool finite, double t, Pass pass) {
  IteratedJob& job = *lanes_[lane];
  if (finite || job.done_ || lane >= used_) return;
  job.done_ = true;
  job.status_ = EstimateStatus::diverged;
  job.t_diverged_ = t;
  job.cause_ = fmt::format("{} diverged at t = {:.6g} s (estimate beyond 1e6 prior sigma)",
                           pass == Pass::first ? "filter" : "second pass of the filter", t);
}

/// What the linear pass says of every lane.
void IteratedLanes::settle() {
  information_.invert();
  information_.extract(std::span(covariances_).first(used_));
  bool any = false;
  for (std::size_t lane = 0; lane < used_; ++lane) {
    settle(*lanes_[lane], lane);
    any = any || (lanes_[lane]->done_ && lanes_[lane]->status_ != EstimateStatus::diverged);
  }
  if (!any) return;
  lagged_ = information_.lagged(moved_.data());
  if (stretches_)
    lagged_ += stretches_->lag().sum(ends_, moved_, information_, stretches_->of_whole());
  for (std::size_t lane = 0; lane < used_; ++lane)
    if (lanes_[lane]->done_ && lanes_[lane]->status_ != EstimateStatus::diverged)
      report(*lanes_[lane], lane);
}

/// Moves a job to where the pass has ended, and says whether it was the last one.
void IteratedLanes::settle(IteratedJob& job, std::size_t l) {
  const int lane = static_cast<int>(l);
  const std::size_t n = x_.size();
  double right = 0.0, square = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    const double d = moved_[k][lane], p = prior_[k][lane];
    job.moved_[at] = d;
    job.x_[at] = x_[k][lane] + d;
    right += d * (information_.right(k)[lane] + p);
    square += p * p;
  }
  job.nis_ = information_.right(n)[lane] + square - right;
  if (stretches_) job.nis_ += stretches_->of_whole()[l]->left_over();
  job.tail_ = tail_[lane];
  diverged(l, std::isfinite(job.nis_) && job.x_.allFinite() && job.x_.cwiseAbs().maxCoeff() <= 1e6,
           timeline_.intervals.back().t1, Pass::linear);
  if (job.done_) return;
  ++job.passes_;
  // No component is longer, in its sigma, than the whole step is in the metric of the covariance,
  // d (1 + information) d.
  if (right < 1.0) {
    job.done_ = true;
    return;
  }
  const double step = (job.moved_.array().abs() / job.P_.diagonal().array().sqrt()).maxCoeff();
  const bool last = job.passes_ == IteratedPasses::most_passes;
  job.done_ = last || step < 1.0;
  if (!last || step < 1.0) return;
  job.status_ = EstimateStatus::not_converged;
  job.t_diverged_ = timeline_.intervals.back().t1;
  job.cause_ = IteratedPasses::still_moves(step);
}

/// What is told of a job after its last pass.
void IteratedLanes::report(IteratedJob& job, std::size_t l) {
  const int lane = static_cast<int>(l);
  const double variance = job.nis_ / static_cast<double>(job.scalars_);
  job.lag1_ = job.pairs_ > 0 && job.nis_ > 0.0
                  ? lagged_[lane] / static_cast<double>(job.pairs_) / variance
                  : 0.0;
  job.theta_ = layout_.theta_at(job.x_);
  for (Eigen::Index k = 0; k < job.sigma_.size(); ++k)
    job.sigma_[k] = layout_.sigma[k] * std::sqrt(job.P_(k, k));
}

}  // namespace drift
