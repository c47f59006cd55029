#include "core/estimate/sequential/in_lanes/iterated_lanes.hpp"

#include <algorithm>

#include "core/estimate/sequential/stretches_and_chains.hpp"
#include "core/sim/trajectory.hpp"

namespace drift {
IteratedLanes::IteratedLanes(const FilterSpec& filter, const Timeline& timeline,
                             const Readout& readout)
    : along_(filter, timeline, readout),
      timeline_(timeline),
      layout_(along_.layout()),
      attitude_(along_.attitude()),
      information_(layout_.size()),
      ends_(static_cast<std::size_t>(timeline.chains), attitude_),
      x_(layout_.size()),
      x_start_(x_),
      moved_(x_),
      step_(x_),
      prior_(x_) {}

/// What is known of a job before its first pass.
void IteratedLanes::prepare(IteratedJob& job) const {
  job.begin_anew();
  job.passes_ = 0;
  job.done_ = false;
  const auto n = static_cast<Eigen::Index>(layout_.size());
  for (VecX* v : {&job.x_start_, &job.moved_, &job.sigma_}) v->resize(n);
  for (Eigen::Index k = 0; k < n; ++k)
    job.x_start_[k] = layout_.scaled(job.start, static_cast<std::size_t>(k));
  job.x_ = job.x_start_;
  job.P_.resize(n, n);
  job.ends_.assign(static_cast<std::size_t>(timeline_.chains), Vec3::Zero());
  job.scalars_ = job.pairs_ = 0;
  const auto count = [&](const Mat3X& all) {
    for (std::size_t i = 0; i < timeline_.intervals.size(); ++i)
      for (int a = 0; a < 3; ++a) {
        const auto at = static_cast<Eigen::Index>(i);
        if (!std::isfinite(all(a, at))) continue;
        ++job.scalars_;
        if (i > 0 && !timeline_.intervals[i].cage && std::isfinite(all(a, at - 1))) ++job.pairs_;
      }
  };
  if (along_.readout().accelerometers) count(job.measured->acc);
  if (along_.readout().gimbals) count(job.measured->gimbal);
}

void IteratedLanes::run(std::span<IteratedJob> jobs) {
  waiting_.clear();
  for (IteratedJob& job : jobs) {
    prepare(job);
    waiting_.push_back(&job);
  }
  const auto in_packs = [&](auto&& pass) {
    for (std::size_t first = 0; first < waiting_.size(); first += width) {
      load(std::span(waiting_).subspan(first, std::min(width, waiting_.size() - first)));
      pass();
    }
    std::erase_if(waiting_, [](const IteratedJob* job) { return job->done_; });
  };
  in_packs([&] { begin(); });
  while (!waiting_.empty())
    in_packs([&] {
      linear_pass();
      settle();
    });
}

void IteratedLanes::load(std::span<IteratedJob* const> jobs) {
  used_ = jobs.size();
  for (std::size_t l = 0; l < width; ++l) {
    lanes_[l] = jobs[std::min(l, used_ - 1)];
    recordings_[l] = lanes_[l]->measured;
    covariances_[l] = &lanes_[l]->P_;
  }
  for (std::size_t k = 0; k < x_.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    x_start_[k] =
        Pack::of_each([&](int l) { return lanes_[static_cast<std::size_t>(l)]->x_start_[at]; });
    x_[k] = Pack::of_each([&](int l) { return lanes_[static_cast<std::size_t>(l)]->x_[at]; });
  }
}

/// Relinearises after 1, 2, 4, ... samples from the beginning of every stretch on.
void IteratedLanes::begin() {
  std::ranges::fill(moved_, Pack(0.0));
  along_.set_theta(x_);
  attitude_.reset();
  information_.clear();
  PackVec phi = PackVec::Zero();
  const std::size_t count = timeline_.intervals.size();
  std::size_t block = 1;
  for (std::size_t first = 0, end = 0; first < count; first = end) {
    if (begins_anew(timeline_, first)) block = 1;
    end = first + 1;
    while (end - first < block && !begins_anew(timeline_, end)) ++end;
    block *= 2;
    const auto& all = timeline_.intervals;
    if (all[first].cage) {
      along_.phi(all[first].first_node) = phi = PackVec::Zero();
      along_.cage(all[first]);
    }
    for (std::size_t i = first; i < end; ++i) {
      along_.phi(all[i].first_node) = phi;
      along_.forward(all[i]);
      phi = along_.phi(all[i].last_node());
      take(i, i > first, Pass::first);
    }
    solve_block(all[end - 1], phi);
    if (ends_chain(timeline_, end - 1))
      for (std::size_t l = 0; l < used_; ++l)
        lanes_[l]->ends_[static_cast<std::size_t>(all[end - 1].chain)] =
            lane_of(phi, static_cast<int>(l));
  }
  for (std::size_t l = 0; l < used_; ++l)
    for (std::size_t k = 0; k < x_.size(); ++k)
      lanes_[l]->x_[static_cast<Eigen::Index>(k)] = x_[k][static_cast<int>(l)];
}

/// The estimate after a block of samples, about which the next one is linearised.
void IteratedLanes::solve_block(const Interval& interval, PackVec& phi) {
  information_.flush(false);
  information_.factorise();
  for (std::size_t k = 0; k < x_.size(); ++k) prior_[k] = information_.right(k);
  information_.solve(prior_.data());
  bool finite[width];
  std::ranges::fill(finite, true);
  for (std::size_t k = 0; k < x_.size(); ++k) {
    step_[k] = prior_[k] - moved_[k];
    moved_[k] = prior_[k];
    x_[k] = x_start_[k] + moved_[k];
    for (std::size_t l = 0; l < width; ++l)
      finite[l] = finite[l] && std::abs(x_[k][static_cast<int>(l)]) <= 1e6;
  }
  const PackVec psi = attitude_.attitude(step_);
  for (std::size_t l = 0; l < width; ++l) {
    const int lane = static_cast<int>(l);
    if (finite[l])
      set_lane(
          phi, lane,
          turned(timeline_.nodes[interval.last_node()], lane_of(psi, lane), lane_of(phi, lane)));
    diverged(l, finite[l] && lane_of(phi, lane).allFinite(), interval.t1, Pass::first);
  }
  attitude_.move_reference();
  along_.set_theta(x_);
}

void IteratedLanes::linear_pass() {
  along_.set_theta(x_);
  const auto& all = timeline_.intervals;
  for (std::size_t i = all.size(); i-- > 0;) {
    PackVec& last = along_.phi(all[i].last_node());
    if (ends_chain(timeline_, i))
      for (std::size_t l = 0; l < width; ++l)
        set_lane(last, static_cast<int>(l),
                 lanes_[l]->ends_[static_cast<std::size_t>(all[i].chain)]);
    else
      last = along_.phi(all[i + 1].first_node);
    along_.backward(all[i]);
  }
  attitude_.reset();
  information_.clear();
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t l = 0; l < used_; ++l)
      diverged(l, lane_of(along_.phi(all[i].first_node), static_cast<int>(l)).allFinite(),
               all[i].t0, Pass::linear);
    if (all[i].cage) along_.cage(all[i]);
    take(i, i > 0, Pass::linear);
    if (ends_chain(timeline_, i)) ends_[static_cast<std::size_t>(all[i].chain)] = attitude_;
  }
  information_.flush(true);
  information_.factorise();
  for (std::size_t k = 0; k < x_.size(); ++k) {
    prior_[k] = x_start_[k] - x_[k];
    moved_[k] = prior_[k] + information_.right(k);
  }
  information_.solve(moved_.data());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!ends_chain(timeline_, i)) continue;
    const auto chain = static_cast<std::size_t>(all[i].chain);
    const PackVec psi = ends_[chain].attitude(moved_);
    for (std::size_t l = 0; l < used_; ++l) {
      const int lane = static_cast<int>(l);
      if (!lanes_[l]->done_ && lane_of(psi, lane).allFinite())
        lanes_[l]->ends_[chain] = turned(timeline_.nodes[all[i].last_node()], lane_of(psi, lane),
                                         lane_of(along_.phi(all[i].last_node()), lane));
    }
  }
}

void IteratedLanes::take(std::size_t i, bool follows, Pass pass) {
  const Interval& interval = timeline_.intervals[i];
  along_.linearize(i, follows);
  along_.to_middle(interval);
  if (along_.readout().accelerometers)
    take_scalars(interval, LaneIntervals::accelerometers,
                 along_.read_accelerometers(i, recordings_), pass);
  along_.to_end(interval);
  if (along_.readout().gimbals)
    take_scalars(interval, LaneIntervals::gimbals, along_.read_gimbals(i, recordings_), pass);
}

void IteratedLanes::take_scalars(const Interval& interval, LaneIntervals::Channel channel,
                                 LaneFilter::Scalars scalars, Pass pass) {
  if (information_.full()) information_.flush(pass == Pass::linear);
  information_.begin_rows(channel, !interval.cage);
  attitude_.update(scalars, information_);
  if (pass == Pass::linear) return;
  for (int a = 0; a < 3; ++a) {  // right hand sides count from the start
    Pack& right = information_.at(moved_.size())[4 * a];
    for (std::size_t k = 0; k < moved_.size(); ++k)
      right = mul_add(moved_[k], information_.at(k)[4 * a], right);
  }
}

}  // namespace drift
