#include "core/estimate/sequential/iterated_lanes.hpp"

#include <algorithm>

#include "core/estimate/sequential/drift_walk.hpp"
#include "core/estimate/sequential/stretches_and_chains.hpp"
#include "core/physics/stochastic.hpp"
#include "core/sim/trajectory.hpp"

namespace drift {
namespace {

/// Whether the last node of an interval and the first of the next are the same for the terms.
bool go_on_alike(const Timeline& timeline, const Interval& a, const Interval& b) {
  return !b.cage && a.omega_cmd_p == b.omega_cmd_p && a.loop == b.loop &&
         timeline.nodes[a.last_node()].omega_ic_l == timeline.nodes[b.first_node].omega_ic_l;
}

}  // namespace

bool IteratedLanes::can(const FilterSpec& filter, const Timeline& timeline) {
  const DriftModel model = filter.model();
  return LaneLinearizer::can(model) && !has_outliers(model.terms) &&
         filter.noise.angle_random_walk == 0.0 &&
         walking_states(filter, make_layout(filter)).empty() &&
         std::ranges::none_of(timeline.intervals, [](const Interval& i) { return i.rest; });
}

IteratedLanes::IteratedLanes(const FilterSpec& filter, const Timeline& timeline,
                             const Readout& readout)
    : filter_(filter),
      timeline_(timeline),
      readout_(readout),
      layout_(make_layout(filter)),
      linearizer_(filter.model(), layout_, readout),
      attitude_(layout_, linearizer_.readout()),
      information_(layout_.size()),
      one_(layout_.size(), Information::row_width(layout_.size())),
      H_rate_(3 * layout_.num_rate),
      H_par_(linearizer_.readout().size()),
      rest_G_(H_rate_),
      path_(timeline.nodes.size()),
      ends_(static_cast<std::size_t>(timeline.chains), attitude_),
      x_(layout_.size()),
      x_start_(x_),
      moved_(x_),
      step_(x_),
      prior_(x_) {
  std::size_t most = 0;
  for (const Interval& i : timeline.intervals) most = std::max(most, i.node_count());
  jacobian_.assign(most, linearizer_.make());
  Phi_.resize(most);
  G_.assign(most, std::vector<Pack>(3 * layout_.num_rate));
}

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
  if (readout_.accelerometers) count(job.measured->acc);
  if (readout_.gimbals) count(job.measured->gimbal);
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
      for (std::size_t lane = 0; lane < used_; ++lane) settle(lane);
    });
}

void IteratedLanes::load(std::span<IteratedJob* const> jobs) {
  used_ = jobs.size();
  for (std::size_t l = 0; l < width; ++l) lanes_[l] = jobs[std::min(l, used_ - 1)];
  for (std::size_t k = 0; k < x_.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    x_start_[k] =
        Pack::of_each([&](int l) { return lanes_[static_cast<std::size_t>(l)]->x_start_[at]; });
    x_[k] = Pack::of_each([&](int l) { return lanes_[static_cast<std::size_t>(l)]->x_[at]; });
  }
}

/// Linearises about x_ from here on.
void IteratedLanes::set_theta() {
  for (std::size_t k = 0; k < x_.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    linearizer_.theta()[layout_.params[k]] =
        Pack(layout_.mean[at]) + Pack(layout_.sigma[at]) * x_[k];
  }
}

void IteratedLanes::cage(const Interval& interval, const PackVec& phi) {
  const Node& node = timeline_.nodes[interval.first_node];
  PackVec psi;
  for (int l = 0; l < Pack::width; ++l)
    set_lane(psi, l, node.R_il * (node.R_lr * -lane_of(phi, l)));
  attitude_.cage(psi, filter_.initial_attitude);
}

/// Relinearises after 1, 2, 4, ... samples from the beginning of every stretch on.
void IteratedLanes::begin() {
  std::ranges::fill(moved_, Pack(0.0));
  set_theta();
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
      phi.setZero();
      cage(all[first], phi);
    }
    for (std::size_t i = first; i < end; ++i) {
      path_[all[i].first_node] = phi;
      linearizer_.forward(timeline_, all[i], &path_[all[i].first_node]);
      phi = path_[all[i].last_node()];
      take(i, i > first && go_on_alike(timeline_, all[i - 1], all[i]), Pass::first);
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
  set_theta();
}

void IteratedLanes::linear_pass() {
  set_theta();
  const auto& all = timeline_.intervals;
  for (std::size_t i = all.size(); i-- > 0;) {
    PackVec* phi = &path_[all[i].first_node];
    PackVec& last = path_[all[i].last_node()];
    if (ends_chain(timeline_, i))
      for (std::size_t l = 0; l < width; ++l)
        set_lane(last, static_cast<int>(l),
                 lanes_[l]->ends_[static_cast<std::size_t>(all[i].chain)]);
    else
      last = path_[all[i + 1].first_node];
    linearizer_.backward(timeline_, all[i], phi);
  }
  attitude_.reset();
  information_.clear();
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t l = 0; l < used_; ++l)
      diverged(l, lane_of(path_[all[i].first_node], static_cast<int>(l)).allFinite(), all[i].t0,
               Pass::linear);
    if (all[i].cage) cage(all[i], path_[all[i].first_node]);
    take(i, i > 0 && go_on_alike(timeline_, all[i - 1], all[i]), Pass::linear);
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
                                         lane_of(path_[all[i].last_node()], lane));
    }
  }
}

}  // namespace drift
