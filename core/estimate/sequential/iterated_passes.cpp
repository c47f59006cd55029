#include "core/estimate/sequential/iterated_passes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/check.hpp"
#include "core/base/number_text.hpp"
#include "core/physics/stochastic.hpp"
#include "core/plan/stretches_and_chains.hpp"

namespace drift {

IteratedPasses::IteratedPasses(const FilterSpec& filter, const Timeline& timeline,
                               const Readout& readout, const Theta& start)
    : timeline_(timeline),
      rows_(filter, timeline, readout),
      information_(rows_.layout().size(), rows_.width()),
      lanes_(timeline, rows_.model()),
      reference_(timeline, rows_.model()),
      gated_(has_outliers(rows_.model().terms)),
      strays_(rows_.strays()),
      store_(3 * rows_.most_triples() * rows_.width()),
      neighbours_(rows_.most_triples()),
      residual_(3 * rows_.most_triples()),
      middle_(held_at_most * rows_.width()),
      beside_(middle_),
      ends_(static_cast<std::size_t>(timeline.chains), rows_.attitude()),
      x_start_(rows_.layout().scaled(start)),
      x_reference_(x_start_),
      moved_(VecX::Zero(x_start_.size())),
      prior_(moved_),
      step_(moved_),
      nothing_(moved_),
      path_(timeline.nodes.size()),
      starts_(static_cast<std::size_t>(timeline.chains), Vec3::Zero()) {
  x_ = x_start_;
  sigma_ = rows_.layout().sigma;
  P_.setIdentity(x_.size(), x_.size());
  theta_ = start;
}

const FilterEstimate& IteratedPasses::run(const Measurements& measured, const Theta& start) {
  DRIFT_DEMAND(is_along(measured, timeline_));
  if (!first_pass(measured, start)) return *this;
  double step = 0.0;
  for (int pass = 0; pass < most_passes; ++pass) {
    if (!linear_pass(measured)) return *this;
    step = largest_step();
    if (step < 1.0) break;  // what is left is of second order in less than a sigma
  }
  finish();
  if (!(step < 1.0)) {
    status_ = EstimateStatus::not_converged;
    t_diverged_ = timeline_.intervals.back().t1;
    cause_ = still_moves(step);
  }
  return *this;
}

std::string IteratedPasses::still_moves(double step) {
  return fmt::format("filter not converged (the last of {} passes moves a parameter by {} sigma)",
                     most_passes, number_text(step, 2));
}

/// Rows of one interval behind those of the others.
bool IteratedPasses::take(std::size_t i, const Measurements& measured, const Vec3* path,
                          Pass pass) {
  const auto column = static_cast<Eigen::Index>(i);
  const AttitudeFilter::Gate gate{outlier_gate(theta_), &information_, &nothing_};
  double* into = row(3 * triples_);
  const IntervalRows::Taken taken =
      rows_.take(i, measured.acc.col(column), measured.gimbal.col(column), path,
                 gated_ ? &gate : nullptr, into);
  if (timeline_.intervals[i].cage) measured_last_[0] = measured_last_[1] = nothing_measured;
  for (std::size_t k = 0; k < taken.triples; ++k) {
    const IntervalRows::Channel channel = taken.channel[k];
    neighbours_[triples_ + k] = {channel, measured_last_[channel] + 1 == i};
    measured_last_[channel] = i;
  }
  triples_ += taken.triples;
  scalars_ += taken.scalars;
  if (diverged(taken.ok, timeline_.intervals[i].t1, pass)) return false;
  if (pass == Pass::first)  // right hand sides count from the start
    for (double* r = into; r != row(3 * triples_); r += rows_.width())
      r[rows_.attitude().right()] += moved_.dot(Eigen::Map<const VecX>(r, moved_.size()));
  return true;
}

bool IteratedPasses::first_pass(const Measurements& measured, const Theta& start) {
  begin_anew();
  const Layout& layout = rows_.layout();
  for (std::size_t k = 0; k < layout.size(); ++k)
    x_start_[static_cast<Eigen::Index>(k)] = layout.scaled(start, k);
  x_ = x_start_;
  moved_.setZero();
  theta_ = layout.theta_at(x_);
  rows_.reset(theta_);
  information_.clear();
  information_.factorise();
  triples_ = summed_ = scalars_ = 0;
  Vec3 phi = Vec3::Zero();
  std::size_t samples = 1;
  for (std::size_t i = 0, end = 0; i < timeline_.intervals.size(); i = end) {
    end = end_of_block(i, samples);
    const Interval& last = timeline_.intervals[end - 1];
    if (!take_block(i, end, measured, phi, Pass::first) || !solve_block(last, phi)) return false;
    keep_start(i, end, phi);
    if (ends_chain(timeline_, end - 1)) reference_.end_chain(last, phi);
  }
  return true;
}

/// From the beginning of every stretch on each is of twice as many samples as the one before.
/// samples: of so many this time.
std::size_t IteratedPasses::end_of_block(std::size_t first, std::size_t& samples) const {
  std::size_t end = first + 1;
  if (begins_anew(timeline_, first)) {
    while (!begins_anew(timeline_, end)) ++end;
    samples = first_block(end - first);
    end = first + 1;
  }
  while (end - first < samples && !begins_anew(timeline_, end)) ++end;
  samples *= 2;
  return end;
}

/// Intervals linearised about one estimate, whose path begins at phi, at a caging anew; then phi
/// is its end.
bool IteratedPasses::take_block(std::size_t first, std::size_t end, const Measurements& measured,
                                Vec3& phi, Pass pass) {
  const auto& all = timeline_.intervals;
  if (all[first].cage) {
    const auto chain = static_cast<std::size_t>(all[first].chain);
    if (pass == Pass::first) starts_[chain].setZero();
    phi = starts_[chain];
    rows_.cage(all[first], phi);
  }
  path_[all[first].first_node] = phi;
  const bool together = all_in_lanes(rows_.model().terms);
  if (together) {
    lanes_.set_theta(theta_);
    lanes_.forward(first, end, path_.data());
    rows_.look_ahead(first, end, path_.data());
  }
  for (std::size_t i = first; i < end; ++i) {
    if (!together) {
      if (i > first) path_[all[i].first_node] = path_[all[i - 1].last_node()];
      step_through(all[i], timeline_, drive_of(all[i], timeline_, rows_.model(), theta_),
                   rows_.enter(i), &path_[all[i].first_node]);
    }
    if (!take(i, measured, path_.data(), pass)) return false;
  }
  phi = path_[all[end - 1].last_node()];
  add_rows();
  return true;
}

/// Those that are not summed up yet.
void IteratedPasses::add_rows() {
  information_.add(row(3 * summed_), 3 * (triples_ - summed_));
  summed_ = triples_;
}

/// The estimate after a block of samples, about which the next one is linearised.
bool IteratedPasses::solve_block(const Interval& interval, Vec3& phi) {
  const bool finite = information_.factorise();
  const VecX& d = information_.solve(nothing_);
  step_ = d - moved_;
  moved_ = d;
  x_ = x_start_ + d;
  if (diverged(finite && x_.allFinite() && x_.cwiseAbs().maxCoeff() <= 1e6, interval.t1,
               Pass::first))
    return false;
  AttitudeFilter& attitude = rows_.attitude();
  phi = turned(timeline_.nodes[interval.last_node()], attitude.attitude(step_), phi);
  if (diverged(phi.allFinite(), interval.t1, Pass::first)) return false;
  attitude.move_reference(step_);
  theta_ = rows_.layout().theta_at(x_);
  rows_.set_theta(theta_);
  return true;
}

bool IteratedPasses::linear_pass(const Measurements& measured) {
  x_reference_ = x_;
  theta_ = rows_.layout().theta_at(x_reference_);
  rows_.reset(theta_);
  triples_ = summed_ = scalars_ = 0;
  information_.clear();
  if (!(strays_ ? along_filtered(measured) : along_reference(measured))) return false;
  const bool finite = information_.factorise();
  prior_ = x_start_ - x_reference_;
  moved_ = information_.solve(prior_);
  nis_ = information_.cost(moved_, prior_);
  x_ = x_reference_ + moved_;
  if (diverged(finite && std::isfinite(nis_) && x_.allFinite() && x_.cwiseAbs().maxCoeff() <= 1e6,
               timeline_.intervals.back().t1, Pass::linear))
    return false;
  for (std::size_t i = 0; i < timeline_.intervals.size() && !strays_; ++i) {
    if (!ends_chain(timeline_, i)) continue;
    const Interval& interval = timeline_.intervals[i];
    const Vec3 psi = ends_[static_cast<std::size_t>(interval.chain)].attitude(moved_);
    reference_.end_chain(interval, turned(timeline_.nodes[interval.last_node()], psi,
                                          reference_.nodes(interval)[interval.node_count() - 1]));
  }
  return true;
}

/// All rows, about the path of the reference parameters.
bool IteratedPasses::along_reference(const Measurements& measured) {
  reference_.place(theta_);
  for (const Interval& interval : timeline_.intervals)
    if (diverged(reference_.nodes(interval)[0].allFinite(), interval.t0, Pass::linear))
      return false;
  constexpr std::size_t at_once = 8;  // intervals whose rows are still in the first cache
  const std::size_t count = timeline_.intervals.size();
  for (std::size_t first = 0; first < count; first += at_once) {
    const std::size_t end = std::min(first + at_once, count);
    rows_.look_ahead(first, end, reference_.nodes());
    for (std::size_t i = first; i < end; ++i) {
      const Interval& interval = timeline_.intervals[i];
      if (interval.cage) rows_.cage(interval, reference_.nodes(interval)[0]);
      rows_.enter(i);
      if (!take(i, measured, reference_.nodes(), Pass::linear)) return false;
      if (ends_chain(timeline_, i))
        ends_[static_cast<std::size_t>(interval.chain)] = rows_.attitude();
    }
    add_rows();
  }
  return true;
}

/// All rows, about the attitude that the filter finds with the reference parameters.
bool IteratedPasses::along_filtered(const Measurements& measured) {
  Vec3 phi = Vec3::Zero();
  std::size_t samples = 1;
  for (std::size_t i = 0, end = 0; i < timeline_.intervals.size(); i = end) {
    end = end_of_block(i, samples);
    const Interval& last = timeline_.intervals[end - 1];
    if (!take_block(i, end, measured, phi, Pass::linear)) return false;
    AttitudeFilter& attitude = rows_.attitude();
    if (ends_chain(timeline_, end - 1)) ends_[static_cast<std::size_t>(last.chain)] = attitude;
    phi = turned(timeline_.nodes[last.last_node()], attitude.attitude(nothing_), phi);
    if (diverged(phi.allFinite(), last.t1, Pass::linear)) return false;
    attitude.move_reference(nothing_);
    keep_start(i, end, phi);
  }
  return true;
}

/// Where the block after a caging must have begun to end at phi.
void IteratedPasses::keep_start(std::size_t first, std::size_t end, const Vec3& phi) {
  const auto& all = timeline_.intervals;
  if (!strays_ || !all[first].cage || !all_in_lanes(rows_.model().terms)) return;
  path_[all[end - 1].last_node()] = phi;
  lanes_.set_theta(theta_);
  lanes_.backward(first, end, path_.data());
  starts_[static_cast<std::size_t>(all[first].chain)] = path_[all[first].first_node];
}

bool IteratedPasses::diverged(bool finite, double t, Pass pass) {
  if (finite) return false;
  status_ = EstimateStatus::diverged;
  t_diverged_ = t;
  cause_ = fmt::format("{} diverged at t = {:.6g} s (estimate beyond 1e6 prior sigma)",
                       pass == Pass::first ? "filter" : "second pass of the filter", t);
  return true;
}

double IteratedPasses::largest_step() {
  // No component is longer, in its sigma, than the whole step is in the metric of the covariance.
  const double bound = information_.whitened(moved_).norm();
  if (bound < 1.0) return bound;
  information_.invert(P_);
  return (moved_.array().abs() / P_.diagonal().array().sqrt()).maxCoeff();
}

}  // namespace drift
