#include "core/estimate/sequential/iterated_passes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/physics/stochastic.hpp"

namespace drift {
namespace {

/// Whether something else begins with interval i: a chain, a position, a slew.
bool begins(const Timeline& timeline, std::size_t i) {
  if (i == 0 || i == timeline.intervals.size()) return true;
  const Interval &before = timeline.intervals[i - 1], &now = timeline.intervals[i];
  return now.cage || now.position != before.position || now.slew != before.slew ||
         now.rest != before.rest;
}
bool ends_chain(const Timeline& timeline, std::size_t i) {
  return i + 1 == timeline.intervals.size() || timeline.intervals[i + 1].cage;
}

}  // namespace

IteratedPasses::IteratedPasses(const FilterSpec& filter, const Timeline& timeline,
                               const Readout& readout, const Theta& start)
    : IteratedPasses(filter, timeline, nullptr, readout, start) {}

IteratedPasses::IteratedPasses(const FilterSpec& filter, const CompressedTest& test,
                               const Readout& readout, const Theta& start)
    : IteratedPasses(filter, test.timeline(), &test, readout, start) {}

IteratedPasses::IteratedPasses(const FilterSpec& filter, const Timeline& timeline,
                               const CompressedTest* compressed, const Readout& readout,
                               const Theta& start)
    : timeline_(timeline),
      compressed_(compressed),
      rows_(filter, timeline, readout, compressed),
      information_(rows_.layout().size(), rows_.width()),
      lanes_(timeline, rows_.model()),
      reference_(timeline, rows_.model()),
      gated_(has_outliers(rows_.model().terms)),
      store_(3 * rows_.most_triples() * rows_.width()),
      neighbours_(rows_.most_triples()),
      residual_(3 * rows_.most_triples()),
      middle_(held_at_most * rows_.width()),
      beside_(middle_),
      ends_(static_cast<std::size_t>(timeline.chains), rows_.attitude()),
      x_(rows_.layout().scaled(start)),
      x_start_(x_),
      x_reference_(x_),
      moved_(VecX::Zero(x_.size())),
      prior_(moved_),
      step_(moved_),
      nothing_(moved_),
      P_(MatX::Identity(x_.size(), x_.size())),
      path_(timeline.nodes.size()),
      theta_(start) {
  if (compressed_)
    stretch_lag_ = std::make_unique<StretchLag>(*compressed_, rows_.layout(), rows_.width());
}

void IteratedPasses::run(const Measurements& measured, const Theta& start) {
  if (begin(measured, start)) settle(measured);
}

void IteratedPasses::settle(const Measurements& measured) {
  constexpr int most_passes = 4;
  for (int pass = 0; pass < most_passes; ++pass) {
    if (!linear_pass(measured)) return;
    if (largest_step() < 1.0) break;  // what is left is of second order in less than a sigma
  }
  finish();
}

void IteratedPasses::begin_as(const IteratedPasses& other) {
  status_ = EstimateStatus::ok;
  cause_.clear();
  t_diverged_ = nis_ = lag1_ = 0.0;
  x_start_ = other.x_start_;
  x_ = other.x_;
  reference_.end_as(other.reference_);
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
  const bool stretch = compressed_ && compressed_->readings(i);
  if (stretch) measured_last_[0] = measured_last_[1] = nothing_measured;
  for (std::size_t k = 0; stretch && k < taken.triples; ++k)
    neighbours_[triples_ + k] = {IntervalRows::accelerometers, false};
  for (std::size_t k = 0; !stretch && k < taken.triples; ++k) {
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

bool IteratedPasses::begin(const Measurements& measured, const Theta& start) {
  status_ = EstimateStatus::ok;
  cause_.clear();
  t_diverged_ = nis_ = lag1_ = 0.0;
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
  const std::size_t count = timeline_.intervals.size();
  Vec3 phi = Vec3::Zero();
  std::size_t block = 1;
  for (std::size_t i = 0; i < count;) {
    if (begins(timeline_, i)) block = 1;
    std::size_t end = i + 1;
    for (std::size_t samples = samples_in(i); end < count && !begins(timeline_, end); ++end) {
      samples += samples_in(end);
      if (samples > block) break;
    }
    block *= 2;
    if (timeline_.intervals[i].cage) {
      phi.setZero();
      rows_.cage(timeline_.intervals[i], phi);
    }
    if (!take_block(i, end, measured, phi)) return false;
    i = end;
    const Interval& last = timeline_.intervals[end - 1];
    if (ends_chain(timeline_, end - 1)) reference_.end_chain(last, phi);
  }
  return true;
}

/// Intervals linearised about one estimate, whose path begins at phi; then phi is where the next
/// estimate has its end.
bool IteratedPasses::take_block(std::size_t first, std::size_t end, const Measurements& measured,
                                Vec3& phi) {
  const auto& all = timeline_.intervals;
  path_[all[first].first_node] = phi;
  const bool together = PathInLanes::can(rows_.model());
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
    if (!take(i, measured, path_.data(), Pass::first)) return false;
  }
  phi = path_[all[end - 1].last_node()];
  return solve_block(timeline_.intervals[end - 1], phi);
}

/// The estimate after a block of samples, about which the next one is linearised.
bool IteratedPasses::solve_block(const Interval& interval, Vec3& phi) {
  information_.add(row(3 * summed_), 3 * (triples_ - summed_));
  summed_ = triples_;
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
  reference_.place(theta_);
  for (const Interval& interval : timeline_.intervals)
    if (diverged(reference_.nodes(interval)[0].allFinite(), interval.t0, Pass::linear))
      return false;
  rows_.reset(theta_);
  triples_ = summed_ = scalars_ = 0;
  information_.clear();
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
      if (stretch_lag_) stretch_lag_->keep(i, rows_.stretch(), rows_.sensitivity());
      if (ends_chain(timeline_, i))
        ends_[static_cast<std::size_t>(interval.chain)] = rows_.attitude();
    }
    information_.add(row(3 * summed_), 3 * (triples_ - summed_));
    summed_ = triples_;
  }
  const bool finite = information_.factorise();
  prior_ = x_start_ - x_reference_;
  moved_ = information_.solve(prior_);
  nis_ = information_.cost(moved_, prior_);
  if (compressed_) {
    nis_ += compressed_->left_over();
    scalars_ = compressed_->scalars();
  }
  x_ = x_reference_ + moved_;
  if (diverged(finite && std::isfinite(nis_) && x_.allFinite() && x_.cwiseAbs().maxCoeff() <= 1e6,
               timeline_.intervals.back().t1, Pass::linear))
    return false;
  for (std::size_t i = 0; i < timeline_.intervals.size(); ++i) {
    if (!ends_chain(timeline_, i)) continue;
    const Interval& interval = timeline_.intervals[i];
    const Vec3 psi = ends_[static_cast<std::size_t>(interval.chain)].attitude(moved_);
    reference_.end_chain(interval, turned(timeline_.nodes[interval.last_node()], psi,
                                          reference_.nodes(interval)[interval.node_count() - 1]));
  }
  return true;
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
