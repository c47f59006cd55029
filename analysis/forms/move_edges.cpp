#include "analysis/forms/move_edges.hpp"

#include <algorithm>
#include <cmath>

namespace drift::forms {
namespace {

using When = TimePart::Kind;

/// Bins of which those that touch a stretch about one of the edges are parted into rows.
class BinsAbout {
 public:
  BinsAbout(const Bins& bins, const Timeline& timeline, std::vector<double> edges)
      : timeline_(timeline), edges_(std::move(edges)), reach_(bins.length) {
    for (std::size_t k = 0; k < bins.intervals.size(); ++k) {
      const auto [first, end] = bins.intervals[k];
      if (!is_near(start_of(first), end_of(end - 1))) {
        add(first, end, bins.position[k]);
        continue;
      }
      for (std::size_t i = first; i < end; ++i) add(i, i + 1, bins.position[k]);
    }
    out_.length = bins.length;
  }

  const Bins& parted() const { return out_; }
  /// Beginnings of rows within reach of an edge.
  std::vector<double> about(double edge) const {
    std::vector<double> times;
    for (std::size_t i = 0; i < timeline_.intervals.size(); ++i)
      if (const double t = start_of(i); std::abs(t - edge) <= reach_) times.push_back(t);
    return times;
  }

 private:
  double start_of(std::size_t i) const {
    return timeline_.intervals[i].t0 - timeline_.intervals[i].t_begin;
  }
  double end_of(std::size_t i) const {
    return timeline_.intervals[i].t1 - timeline_.intervals[i].t_begin;
  }
  bool is_near(double start, double end) const {
    return std::ranges::any_of(
        edges_, [&](double edge) { return start <= edge + reach_ && end >= edge - reach_; });
  }
  void add(std::size_t first, std::size_t end, int position) {
    out_.intervals.emplace_back(first, end);
    out_.position.push_back(position);
    out_.start.push_back(start_of(first));
  }

  const Timeline& timeline_;
  std::vector<double> edges_;
  double reach_;
  Bins out_;
};

}  // namespace

Form with_edges_moved(Form form, const Instants& at, const Bins& bins,
                      const inference::MeasuredRows& rows, const Timeline& timeline,
                      const inference::Projector& projector) {
  const bool ends = form.when.kind == When::window;
  if (!ends && form.when.kind != When::onset) return form;
  std::vector<double> edges{form.when.setting};
  if (ends) edges.push_back(form.when.end);
  const BinsAbout fine(bins, timeline, edges);
  const PlaceInformation info =
      information_on(form.place, fine.parted(), rows, timeline, projector);
  const auto T_of = [&](const Form& f) {
    return info.score(fine.parted().mean(columns_of(f, at))).T;
  };
  Form best = form;
  double top = T_of(form);
  const auto take = [&](const Form& other) {
    if (const double T = T_of(other); T > top) top = T, best = other;
  };
  Form tried = form;
  for (const double start : fine.about(form.when.setting)) {
    tried.when.setting = start;
    if (!ends) take(tried);
    for (const double end : ends ? fine.about(form.when.end) : std::vector<double>{})
      if (tried.when.end = end; end > start) take(tried);
  }
  best.when.sigma = 0.5 * std::ranges::min(timeline.intervals, {}, &Interval::length).length();
  return best;
}

}  // namespace drift::forms
