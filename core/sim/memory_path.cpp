#include "core/sim/memory_path.hpp"

#include <algorithm>

#include "core/base/check.hpp"
#include "core/base/dual.hpp"
#include "core/plan/case_heading.hpp"
#include "core/sim/measurements.hpp"

namespace drift {
namespace {

/// A path at one instant.
struct PathPoint {
  Vec3 f_p;
  Vec3 gimbal = Vec3::Zero();       ///< where a term with memory sees the gimbals
  Vec3 gimbal_rate = Vec3::Zero();  ///< by the command alone [rad/s]
};

PathPoint path_point(const Mat3& R_lp, double heading, const Interval& interval,
                     const Vec3& omega_ic_l, bool gimbals) {
  PathPoint p;
  p.f_p = R_lp.row(2);
  if (!gimbals) return p;
  p.gimbal = gimbal_angles<double>(case_attitude(heading).transpose() * R_lp);
  p.gimbal_rate =
      gimbal_rates<double>(p.gimbal, interval.omega_cmd_p - R_lp.transpose() * omega_ic_l);
  return p;
}

/// Attitude half a step times k after the first node of an interval, phi at its nodes.
Mat3 attitude_at(const Node* nodes, const Vec3* phi, std::size_t k) {
  const Node& node = nodes[k / 2];
  const Mat3& R_lr = k % 2 ? node.R_lr_half : node.R_lr;
  if (phi == nullptr) return R_lr;
  return R_lr * rotation<double>(k % 2 ? Vec3(0.5 * (phi[k / 2] + phi[k / 2 + 1])) : phi[k / 2]);
}

double heading_at(const Interval& interval, double t) {
  return interval.heading0 + (t - interval.t0) * interval.heading_rate();
}

PathStep between(const PathPoint& a, const PathPoint& b, double dt, const Vec3& omega_cmd_p) {
  PathStep step{dt, a.f_p, b.f_p, omega_cmd_p};
  for (int k = 0; k < 3; ++k) {
    step.turned[k] = angle_difference(b.gimbal[k], a.gimbal[k]);
    // A rate that changes its sign, evenly: a parabola there and back.
    const double begin = a.gimbal_rate[k], end = b.gimbal_rate[k];
    if (!(begin * end < 0.0)) continue;
    const double until = begin / (begin - end);
    const double there = 0.5 * begin * until * dt, back = step.turned[k] - there;
    if (back * end <= 0.0) continue;
    step.turned[k] = there;
    step.turned_back[k] = back;
    step.until_reversal[k] = until;
  }
  return step;
}

enum class Change { start, advance, mean };

/// Starts or advances the memory of all terms, or puts in its place its mean over the step, of
/// those that tell it; each with the derivative to its own parameter.
void change_memory(Change change, const TermMask& terms, const PathStep& along, const double* theta,
                   MemoryPoint& point) {
  using D = Dual<1>;
  TermLibrary::for_each_memory(terms, [&]<class T>(const TermInfo& info) {
    std::array<D, T::params.size()> p;
    for (std::size_t k = 0; k < p.size(); ++k) p[k] = D(theta[info.first + k]);
    p[T::memory_parameter].d[0] = 1.0;
    std::array<D, T::memory> m;
    const auto first = static_cast<std::size_t>(info.first_memory);
    for (std::size_t k = 0; k < m.size(); ++k) {
      m[k].v = point.value[first + k];
      m[k].d[0] = point.derivative[first + k];
    }
    if (change == Change::start) T::start(along, p.data(), m.data());
    if (change == Change::advance) T::advance(along, p.data(), m.data());
    if constexpr (tells_means<T>())
      if (change == Change::mean) {
        const std::array<D, T::memory> from = m;
        T::mean(along, p.data(), from.data(), m.data());
      }
    for (std::size_t k = 0; k < m.size(); ++k) {
      point.value[first + k] = m[k].v;
      point.derivative[first + k] = m[k].d[0];
    }
  });
}

/// Calls visit(number) for the memory of each term that tells means.
template <class Visit>
void for_each_mean(const TermMask& terms, Visit&& visit) {
  TermLibrary::for_each_memory(terms, [&]<class T>(const TermInfo& info) {
    if constexpr (tells_means<T>())
      for (int k = info.first_memory; k < info.first_memory + info.memory; ++k)
        visit(static_cast<std::size_t>(k));
  });
}

bool tell_means(const TermMask& terms) {
  bool any = false;
  for_each_mean(terms, [&](std::size_t) { any = true; });
  return any;
}

}  // namespace

MemoryPath::MemoryPath(const Timeline& timeline, const DriftModel& model)
    : timeline_(&timeline), terms_(model.terms), active_(TermLibrary::remember(model.terms)) {}

void MemoryPath::advance_along(std::size_t i, const double* theta, const Vec3* phi) {
  if (!active_) return;
  const Interval& interval = timeline_->intervals[i];
  const Node* first = &timeline_->nodes[interval.first_node];
  const bool gimbals = TermLibrary::needs(terms_).gimbals;
  const std::size_t nodes = interval.node_count();
  const double half = 0.25 * interval.length() / interval.substeps;
  MemoryPoint m = interval.begins ? MemoryPoint{} : points_.back();
  PathPoint here = path_point(attitude_at(first, phi, 0), interval.heading0, interval,
                              first->omega_ic_l, gimbals);
  if (interval.begins) {
    change_memory(Change::start, terms_, between(here, here, 0.0, interval.omega_cmd_p), theta, m);
  } else if (interval.cage) {
    // On the way to a caged position nobody knows more than that the gimbals turned; the heat of
    // the new attitude is taken to act for as long as it took. Where it hangs on that
    // (memory_over_gaps()) it is said.
    const PathPoint before{here.f_p, gimbal_, here.gimbal_rate};
    change_memory(Change::advance, terms_, between(before, here, interval.t0 - t_, Vec3::Zero()),
                  theta, m);
  }
  const bool means = tell_means(terms_);
  points_.assign(2 * nodes - 1, m);
  means_.resize(means ? points_.size() : 0);
  for (std::size_t k = 1; k < points_.size(); ++k) {
    const PathPoint next =
        path_point(attitude_at(first, phi, k),
                   heading_at(interval, interval.t0 + half * static_cast<double>(k)), interval,
                   first->omega_ic_l, gimbals);
    const PathStep along = between(here, next, half, interval.omega_cmd_p);
    if (means) {
      means_[k] = m;
      change_memory(Change::mean, terms_, along, theta, means_[k]);
    }
    change_memory(Change::advance, terms_, along, theta, m);
    points_[k] = m;
    here = next;
  }
  gimbal_ = here.gimbal;
  t_ = interval.t1;
  if (means) integrate_exactly();
}

void MemoryPath::integrate_exactly() {
  exact_ = points_;
  const auto both = [&](std::size_t m, auto&& change) {
    change([m](MemoryPoint& p) -> double& { return p.value[m]; });
    change([m](MemoryPoint& p) -> double& { return p.derivative[m]; });
  };
  for_each_mean(terms_, [&](std::size_t m) {
    both(m, [&](auto&& of) {
      // Two steps at a time, of two points each; their means from those of half a step.
      for (std::size_t k = 0; k + 4 < points_.size(); k += 4) {
        MemoryPoint* at = &points_[k];
        MemoryPoint* mean = &means_[k];
        const double first = 0.5 * (of(mean[1]) + of(mean[2])),
                     second = 0.5 * (of(mean[3]) + of(mean[4]));
        // The rules 5/12, 8/12, -1/12 of the first and 1/3, 4/3, 1/3 of both, solved for the nodes
        // that no step before them shares.
        if (k == 0) of(at[0]) = 2.0 * (first - second) + of(at[4]);
        of(at[2]) = 0.25 * (3.0 * (first + second) - of(at[0]) - of(at[4]));
        of(at[1]) = 0.25 * (6.0 * first - of(at[0]) - of(at[2]));
        of(at[3]) = 0.25 * (6.0 * second - of(at[2]) - of(at[4]));
      }
    });
  });
}

void MemoryPath::shift(const double* theta_old, const double* theta_new) {
  if (!active_) return;
  TermLibrary::for_each_memory(terms_, [&]<class T>(const TermInfo& info) {
    const std::size_t p = info.first + T::memory_parameter;
    const double change = theta_new[p] - theta_old[p];
    if (change == 0.0) return;
    for (MemoryPoint& m : points_)  // and not exact_, which is what MemoryRecord reads
      for (int k = info.first_memory; k < info.first_memory + info.memory; ++k)
        m.value[static_cast<std::size_t>(k)] += change * m.derivative[static_cast<std::size_t>(k)];
  });
}

MemoryRecord::MemoryRecord(const Timeline& timeline, const DriftModel& model)
    : timeline_(&timeline), terms_(model.terms), path_(MemoryPath(timeline, model)) {}

void MemoryRecord::trace(const double* theta) {
  if (!path_ || !path_->active()) return;
  theta_ = Eigen::Map<const Theta>(theta);
  points_.resize(2 * timeline_->nodes.size());
  itself_.resize(points_.size());
  for (std::size_t i = 0; i < timeline_->intervals.size(); ++i) {
    const Interval& interval = timeline_->intervals[i];
    path_->advance(i, theta);
    std::copy_n(path_->points(), 2 * interval.node_count() - 1, &points_[2 * interval.first_node]);
    std::copy_n(path_->itself(), 2 * interval.node_count() - 1, &itself_[2 * interval.first_node]);
  }
}

MemoryPoint MemoryRecord::at_time(const Timeline& timeline, const Interval& interval,
                                  double t) const {
  DRIFT_DEMAND(itself_.size() >= 2 * timeline.nodes.size());
  const double half = 0.25 * interval.length() / interval.substeps;
  const double k = std::floor((t - interval.t0) / half);
  const auto from = static_cast<std::size_t>(
      std::clamp(k, 0.0, 2.0 * static_cast<double>(interval.node_count() - 1)));
  const Node* first = &timeline.nodes[interval.first_node];
  const Node& node = first[from / 2];
  const double t_from = interval.t0 + half * static_cast<double>(from);
  const bool gimbals = TermLibrary::needs(terms_).gimbals;
  const auto at = [&](const Mat3& R_lr, double time) {
    return path_point(R_lr, heading_at(interval, time), interval, first->omega_ic_l, gimbals);
  };
  const Mat3 R_lr = reference_attitude(timeline.site, node.R_lr, interval.omega_cmd_p, t - node.t);
  MemoryPoint m = itself_[2 * interval.first_node + from];
  change_memory(Change::advance, terms_,
                between(at(attitude_at(first, nullptr, from), t_from), at(R_lr, t), t - t_from,
                        interval.omega_cmd_p),
                theta_.data(), m);
  return m;
}

}  // namespace drift
