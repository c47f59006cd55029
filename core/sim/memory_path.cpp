#include "core/sim/memory_path.hpp"

#include <algorithm>

#include "core/base/check.hpp"
#include "core/base/dual.hpp"
#include "core/plan/case_heading.hpp"
#include "core/sim/path_point.hpp"

namespace drift {
namespace {

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

using SlopeOf = Dual<1>;

/// Of one term, each with the derivative to the parameter that its memory depends on.
template <class T>
struct OfTerm {
  std::array<SlopeOf, T::params.size()> p;
  std::array<SlopeOf, T::memory> m;
  std::size_t first;

  OfTerm(const TermInfo& info, const double* theta, const MemoryPoint& point)
      : first(static_cast<std::size_t>(info.first_memory)) {
    for (std::size_t k = 0; k < p.size(); ++k) p[k] = SlopeOf(theta[info.first + k]);
    p[T::memory_parameter].d[0] = 1.0;
    for (std::size_t k = 0; k < m.size(); ++k) {
      m[k].v = point.value[first + k];
      m[k].d[0] = point.derivative[first + k];
    }
  }
  void put(std::size_t k, const SlopeOf& state, MemoryPoint& into) const {
    into.value[first + k] = state.v;
    into.derivative[first + k] = state.d[0];
  }
};

enum class Change { start, advance };

/// Starts or advances the memory of all terms.
void change_memory(Change change, const TermMask& terms, const PathStep& along, const double* theta,
                   MemoryPoint& point) {
  TermLibrary::for_each_memory(terms, [&]<class T>(const TermInfo& info) {
    OfTerm<T> term(info, theta, point);
    if (change == Change::start) T::start(along, term.p.data(), term.m.data());
    if (change == Change::advance) T::advance(along, term.p.data(), term.m.data());
    for (std::size_t k = 0; k < term.m.size(); ++k) term.put(k, term.m[k], point);
  });
}

/// Moments over a step that begins with `from`, of the terms that tell them.
void tell_moments(const TermMask& terms, const PathStep& along, const double* theta,
                  const MemoryPoint& from, Moments<MemoryPoint>& out) {
  TermLibrary::for_each_memory(terms, [&]<class T>(const TermInfo& info) {
    if constexpr (tells_moments<T>()) {
      const OfTerm<T> term(info, theta, from);
      std::array<Moments<SlopeOf>, T::memory> moments;
      T::moments(along, term.p.data(), term.m.data(), moments.data());
      for (std::size_t k = 0; k < moments.size(); ++k)
        for (std::size_t j = 0; j < out.size(); ++j) term.put(k, moments[k][j], out[j]);
    }
  });
}

/// Calls visit(of) for each number that memory of terms that tell moments is made of, values and
/// derivatives; of(point) is it.
template <class Visit>
void for_each_told(const TermMask& terms, Visit&& visit) {
  TermLibrary::for_each_memory(terms, [&]<class T>(const TermInfo& info) {
    if constexpr (tells_moments<T>())
      for (int k = info.first_memory; k < info.first_memory + info.memory; ++k) {
        const auto m = static_cast<std::size_t>(k);
        visit([m](MemoryPoint& p) -> double& { return p.value[m]; });
        visit([m](MemoryPoint& p) -> double& { return p.derivative[m]; });
      }
  });
}

bool any_told(const TermMask& terms) {
  bool any = false;
  for_each_told(terms, [&](auto&&) { any = true; });
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
  const bool told = any_told(terms_);
  points_.assign(2 * nodes - 1, m);
  moments_.resize(told ? points_.size() : 0);
  for (std::size_t k = 1; k < points_.size(); ++k) {
    const PathPoint next =
        path_point(attitude_at(first, phi, k),
                   heading_at(interval, interval.t0 + half * static_cast<double>(k)), interval,
                   first->omega_ic_l, gimbals);
    const PathStep along = between(here, next, half, interval.omega_cmd_p);
    if (told) tell_moments(terms_, along, theta, m, moments_[k]);
    change_memory(Change::advance, terms_, along, theta, m);
    points_[k] = m;
    here = next;
  }
  gimbal_ = here.gimbal;
  t_ = interval.t1;
  steps_.resize(nodes - 1);
  for (std::size_t k = 0; k < steps_.size(); ++k)
    steps_[k] = {points_[2 * k], points_[2 * k + 1], points_[2 * k + 2]};
  if (!told) return;
  exact_ = points_;
  make_steps_exact();
  make_points_exact();
}

void MemoryPath::make_steps_exact() {
  for_each_told(terms_, [&](auto&& of) {
    for (std::size_t k = 0; k < steps_.size(); ++k) {
      Moments<double> halves[2];
      for (std::size_t h = 0; h < 2; ++h)
        for (std::size_t j = 0; j < 3; ++j) halves[h][j] = of(moments_[2 * k + 1 + h][j]);
      const Moments<double> whole = joined(0.5, halves[0], halves[1]);
      // What Simpson's rule has the same means of, and about the middle the same other moments.
      const double first = whole[1] - 0.5 * whole[0],
                   second = whole[2] - whole[1] + 0.25 * whole[0];
      of(steps_[k].begin) = 12.0 * second - 6.0 * first;
      of(steps_[k].half) = 1.5 * whole[0] - 6.0 * second;
      of(steps_[k].end) = 12.0 * second + 6.0 * first;
    }
  });
}

void MemoryPath::make_points_exact() {
  for_each_told(terms_, [&](auto&& of) {
    // Two steps at a time, of two points each; their means from those of half a step.
    for (std::size_t k = 0; k + 4 < points_.size(); k += 4) {
      MemoryPoint* at = &points_[k];
      Moments<MemoryPoint>* m = &moments_[k];
      const double first = 0.5 * (of(m[1][0]) + of(m[2][0])),
                   second = 0.5 * (of(m[3][0]) + of(m[4][0]));
      // The rules 5/12, 8/12, -1/12 of the first and 1/3, 4/3, 1/3 of both, solved for the nodes
      // that no step before them shares.
      if (k == 0) of(at[0]) = 2.0 * (first - second) + of(at[4]);
      of(at[2]) = 0.25 * (3.0 * (first + second) - of(at[0]) - of(at[4]));
      of(at[1]) = 0.25 * (6.0 * first - of(at[0]) - of(at[2]));
      of(at[3]) = 0.25 * (6.0 * second - of(at[2]) - of(at[4]));
    }
  });
}

void MemoryPath::shift(const double* theta_old, const double* theta_new) {
  if (!active_) return;
  TermLibrary::for_each_memory(terms_, [&]<class T>(const TermInfo& info) {
    const std::size_t p = info.first + T::memory_parameter;
    const double change = theta_new[p] - theta_old[p];
    if (change == 0.0) return;
    const auto move = [&](MemoryPoint& m) {
      for (int k = info.first_memory; k < info.first_memory + info.memory; ++k)
        m.value[static_cast<std::size_t>(k)] += change * m.derivative[static_cast<std::size_t>(k)];
    };
    for (MemoryPoint& m : points_) move(m);  // and not exact_, which is what MemoryRecord reads
    for (StepMemory& step : steps_)
      for (MemoryPoint* m : {&step.begin, &step.half, &step.end}) move(*m);
  });
}

MemoryRecord::MemoryRecord(const Timeline& timeline, const DriftModel& model)
    : timeline_(&timeline), terms_(model.terms), path_(MemoryPath(timeline, model)) {}

void MemoryRecord::trace(const double* theta) {
  if (!path_ || !path_->active()) return;
  theta_ = Eigen::Map<const Theta>(theta);
  points_.resize(2 * timeline_->nodes.size());
  itself_.resize(points_.size());
  steps_.resize(timeline_->nodes.size());
  for (std::size_t i = 0; i < timeline_->intervals.size(); ++i) {
    const Interval& interval = timeline_->intervals[i];
    path_->advance(i, theta);
    std::copy_n(path_->points(), 2 * interval.node_count() - 1, &points_[2 * interval.first_node]);
    std::copy_n(path_->itself(), 2 * interval.node_count() - 1, &itself_[2 * interval.first_node]);
    std::copy_n(path_->steps(), interval.node_count() - 1, &steps_[interval.first_node]);
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
