#include "core/estimate/sequential/in_lanes/iterated_lanes.hpp"

#include <algorithm>

#include "core/base/check.hpp"
#include "core/estimate/compressed/stretch_rows.hpp"
#include "core/plan/stretches_and_chains.hpp"

namespace drift {
namespace {

/// From the beginning of every stretch on each is of twice as many samples as the one before.
/// samples: of so many this time.
std::size_t end_of_block(const LaneIntervals& along, std::size_t first, std::size_t& samples) {
  const Timeline& timeline = along.timeline();
  if (begins_anew(timeline, first)) {
    std::size_t all = along.samples(first);
    for (std::size_t i = first + 1; !begins_anew(timeline, i); ++i) all += along.samples(i);
    samples = first_block(all);
  }
  std::size_t end = first + 1, held = along.samples(first);
  for (; !begins_anew(timeline, end); ++end)
    if ((held += along.samples(end)) > samples) break;
  samples *= 2;
  return end;
}

}  // namespace

IteratedLanes::IteratedLanes(const FilterSpec& filter, const Timeline& timeline,
                             const Readout& readout)
    : IteratedLanes(filter, timeline, readout, IteratedStretches::of(filter, timeline, readout)) {}

IteratedLanes::IteratedLanes(const FilterSpec& filter, const Timeline& timeline,
                             const Readout& readout, std::unique_ptr<IteratedStretches> stretches)
    : filter_(filter),
      timeline_(timeline),
      goes_on_(timeline.intervals.size()),
      stretches_(std::move(stretches)),
      along_(stretches_ ? LaneIntervals(filter, stretches_->whole(), readout)
                        : LaneIntervals(filter, timeline, readout)),
      layout_(along_.layout()),
      information_(layout_.size()),
      ends_(static_cast<std::size_t>(timeline.chains), along_.attitude()),
      x_(layout_.size()),
      x_start_(x_),
      moved_(x_),
      step_(x_),
      prior_(x_) {
  const auto& all = along_.timeline().intervals;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t first = along_.first_sample(i);
    goes_on_[first] = i > 0 && !all[i].cage && !along_.is_stretch(i) && !along_.is_stretch(i - 1);
    for (std::size_t k = 1; k < along_.samples(i); ++k) goes_on_[first + k] = true;
  }
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
        if (goes_on_[i] && std::isfinite(all(a, at - 1))) ++job.pairs_;
      }
  };
  if (along_.readout().accelerometers) count(job.measured->acc);
  if (along_.readout().gimbals) count(job.measured->gimbal);
}

void IteratedLanes::run(std::span<IteratedJob> jobs) {
  jobs_.clear();
  for (IteratedJob& job : jobs) {
    DRIFT_DEMAND(job.measured != nullptr && is_along(*job.measured, timeline_));
    jobs_.push_back(&job);
  }
  run(jobs_);
}

void IteratedLanes::run(const Jobs& jobs) {
  waiting_.clear();
  rough_.clear();
  if (stretches_) stretches_->forget_recordings();
  const Measurements* before = nullptr;
  std::ptrdiff_t recording = 0;
  for (IteratedJob* job : jobs) {
    if (stretches_ && job->measured != before) recording = stretches_->take(*job->measured);
    before = job->measured;
    job->recording_ = static_cast<std::size_t>(recording);
    if (recording < 0) {
      rough_.push_back(job);
      continue;
    }
    prepare(*job);
    waiting_.push_back(job);
  }
  const auto in_packs = [&](auto&& pass) {
    for (std::size_t first = 0; first < waiting_.size(); first += width) {
      load(std::span(waiting_).subspan(first, std::min(width, waiting_.size() - first)));
      pass();
    }
    std::erase_if(waiting_, [&](IteratedJob* job) {
      const bool seen =
          job->status_ != EstimateStatus::diverged && job->tail_ < StretchRows::negligible;
      if (job->done_ && stretches_ && !seen) rough_.push_back(job);
      return job->done_;
    });
  };
  in_packs([&] { begin(); });
  while (!waiting_.empty())
    in_packs([&] {
      linear_pass();
      settle();
    });
  if (rough_.empty()) return;
  if (!sample_by_sample_)
    sample_by_sample_.reset(new IteratedLanes(filter_, timeline_, along_.readout(), nullptr));
  sample_by_sample_->run(rough_);
}

void IteratedLanes::load(std::span<IteratedJob* const> jobs) {
  used_ = jobs.size();
  for (std::size_t l = 0; l < width; ++l) {
    lanes_[l] = jobs[std::min(l, used_ - 1)];
    recordings_[l] = lanes_[l]->measured;
    covariances_[l] = &lanes_[l]->P_;
    if (stretches_) stretches_->load(l, lanes_[l]->recording_);
  }
  for (std::size_t k = 0; k < x_.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    x_start_[k] =
        Pack::of_each([&](int l) { return lanes_[static_cast<std::size_t>(l)]->x_start_[at]; });
    x_[k] = Pack::of_each([&](int l) { return lanes_[static_cast<std::size_t>(l)]->x_[at]; });
  }
}

/// Relinearises block by block.
void IteratedLanes::begin() {
  LaneIntervals& along = stretches_ ? stretches_->first_pass() : along_;
  const Timeline& timeline = along.timeline();
  std::ranges::fill(moved_, Pack(0.0));
  along.set_theta(x_);
  along.attitude().reset();
  information_.clear();
  PackVec phi = PackVec::Zero();
  const auto& all = timeline.intervals;
  std::size_t samples = 1;
  for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
    end = end_of_block(along, first, samples);
    if (all[first].cage) {
      along.phi(all[first].first_node) = phi = PackVec::Zero();
      along.cage(all[first]);
    }
    for (std::size_t i = first; i < end; ++i) {
      along.phi(all[i].first_node) = phi;
      along.forward(all[i]);
      phi = along.phi(all[i].last_node());
      take(along, i, i > first, Pass::first);
    }
    solve_block(along, all[end - 1], phi);
    if (ends_chain(timeline, end - 1))
      for (std::size_t l = 0; l < used_; ++l)
        lanes_[l]->ends_[static_cast<std::size_t>(all[end - 1].chain)] =
            lane_of(phi, static_cast<int>(l));
  }
  for (std::size_t l = 0; l < used_; ++l)
    for (std::size_t k = 0; k < x_.size(); ++k)
      lanes_[l]->x_[static_cast<Eigen::Index>(k)] = x_[k][static_cast<int>(l)];
}

/// The estimate after a block of samples, about which the next one is linearised.
void IteratedLanes::solve_block(LaneIntervals& along, const Interval& interval, PackVec& phi) {
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
  const PackVec turned = along.turned(interval.last_node(), along.attitude().attitude(step_), phi);
  for (std::size_t l = 0; l < width; ++l) {
    const int lane = static_cast<int>(l);
    if (finite[l]) set_lane(phi, lane, lane_of(turned, lane));
    diverged(l, finite[l] && lane_of(phi, lane).allFinite(), interval.t1, Pass::first);
  }
  along.attitude().move_reference();
  along.set_theta(x_);
}

void IteratedLanes::linear_pass() {
  along_.set_theta(x_);
  const Timeline& timeline = along_.timeline();
  const auto& all = timeline.intervals;
  for (std::size_t i = all.size(); i-- > 0;) {
    PackVec& last = along_.phi(all[i].last_node());
    if (ends_chain(timeline, i))
      for (std::size_t l = 0; l < width; ++l)
        set_lane(last, static_cast<int>(l),
                 lanes_[l]->ends_[static_cast<std::size_t>(all[i].chain)]);
    else
      last = along_.phi(all[i + 1].first_node);
    along_.backward(all[i]);
  }
  along_.attitude().reset();
  information_.clear();
  tail_ = Pack(0.0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t l = 0; l < used_; ++l)
      diverged(l, lane_of(along_.phi(all[i].first_node), static_cast<int>(l)).allFinite(),
               all[i].t0, Pass::linear);
    if (all[i].cage) along_.cage(all[i]);
    take(along_, i, i > 0, Pass::linear);
    if (ends_chain(timeline, i)) ends_[static_cast<std::size_t>(all[i].chain)] = along_.attitude();
  }
  information_.flush(true);
  information_.factorise();
  for (std::size_t k = 0; k < x_.size(); ++k) {
    prior_[k] = x_start_[k] - x_[k];
    moved_[k] = prior_[k] + information_.right(k);
  }
  information_.solve(moved_.data());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!ends_chain(timeline, i)) continue;
    const auto chain = static_cast<std::size_t>(all[i].chain);
    const std::size_t last = all[i].last_node();
    const PackVec turned = along_.turned(last, ends_[chain].attitude(moved_), along_.phi(last));
    for (std::size_t l = 0; l < used_; ++l) {
      const Vec3 end = lane_of(turned, static_cast<int>(l));
      if (!lanes_[l]->done_ && end.allFinite()) lanes_[l]->ends_[chain] = end;
    }
  }
}

void IteratedLanes::take(LaneIntervals& along, std::size_t i, bool follows, Pass pass) {
  if (along.is_stretch(i)) return take_stretch(along, i, follows, pass);
  const Interval& interval = along.timeline().intervals[i];
  const bool next = i > 0 && !interval.cage && !along.is_stretch(i - 1);
  along.linearize(i, follows);
  along.to_middle(interval);
  if (along.readout().accelerometers)
    take_scalars(along, LaneIntervals::accelerometers, next,
                 along.read_accelerometers(i, recordings_), pass);
  along.to_end(interval);
  if (along.readout().gimbals)
    take_scalars(along, LaneIntervals::gimbals, next, along.read_gimbals(i, recordings_), pass);
  if (stretches_ && pass == Pass::linear) stretches_->lag().pass(i, along.Phi(i), along.G(i));
}

/// What was read along a stretch hangs on the attitude at its beginning.
void IteratedLanes::take_stretch(LaneIntervals& along, std::size_t i, bool follows, Pass pass) {
  const bool linear = pass == Pass::linear;
  LaneStretch& stretch = linear ? stretches_->lag().stretch(i) : stretches_->piece();
  along.linearize(i, follows, linear ? stretches_->of_whole() : stretches_->of_pieces(), stretch);
  tail_ = Pack(std::experimental::max(tail_.v, stretch.tail().v));
  for (const Reading what : {Reading::mean, Reading::at_end}) {
    const LaneStretch::Channel& channel = stretch.channel(what);
    for (std::size_t p = 0; p < channel.rows(); ++p)
      take_scalars(along, LaneIntervals::accelerometers, false, channel.scalars(p), pass);
  }
  along.attitude().propagate(stretch.Phi(), stretch.G());
}

/// next: whether the three of this channel before them are their neighbours in time.
void IteratedLanes::take_scalars(LaneIntervals& along, LaneIntervals::Channel channel, bool next,
                                 LaneFilter::Scalars scalars, Pass pass) {
  if (information_.full()) information_.flush(pass == Pass::linear);
  information_.begin_rows(channel, next);
  along.attitude().update(scalars, information_);
  if (pass == Pass::linear) return;
  for (int a = 0; a < 3; ++a) {  // right hand sides count from the start
    Pack& right = information_.at(moved_.size())[4 * a];
    for (std::size_t k = 0; k < moved_.size(); ++k)
      right = mul_add(moved_[k], information_.at(k)[4 * a], right);
  }
}

}  // namespace drift
