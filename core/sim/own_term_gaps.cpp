#include "core/sim/own_term_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/physics/expression/range.hpp"
#include "core/sim/own_course.hpp"

namespace drift {
namespace {

using Reading = OwnCourse::Reading;

/// Looks for gaps of an own term between nodes.
class GapSearch {
 public:
  explicit GapSearch(const OwnCourse& course) : course_(course) {}

  /// Where between two readings it is no finite number, as a share of the way.
  std::optional<double> gap_between(const Reading& a, const Reading& b) const {
    for (const std::size_t i : course_.inputs())
      // An angle that goes on from the other end of its circle.
      if (i < own_inputs.size() && own_inputs[i].needs.gimbals &&
          std::abs(b[i] - a[i]) > std::numbers::pi)
        return std::nullopt;
    Search search{a, b, std::max(std::abs(course_.value_at(a)), std::abs(course_.value_at(b)))};
    return gap_within(search, 0.0, 1.0);
  }

 private:
  /// A stretch, how large the term is at its ends, and how often it may still be halved: more than
  /// any gap needs, but not without end for an equation that only looks as if it had one.
  struct Search {
    const Reading &a, &b;
    double at_ends = 0.0;
    int halvings = 1000;
    double at(std::size_t i, double share) const { return a[i] + share * (b[i] - a[i]); }
  };

  std::optional<double> gap_within(Search& s, double from, double to) const {
    constexpr double finest = 0x1p-20;  // of the stretch: still far above roundings of the time
    const Range range = course_.evaluated<Range>([&](std::size_t i) {
      const auto [least, most] = std::minmax({s.at(i, from), s.at(i, to)});
      return Range(least, most);
    });
    if (range.everywhere) return std::nullopt;
    if (to - from <= finest) {
      for (const double end : {from, to})
        if (ends_at(s, end, to - from)) return end;
      return std::nullopt;
    }
    if (--s.halvings < 0) return std::nullopt;
    const double middle = 0.5 * (from + to);
    if (const auto before = gap_within(s, from, middle)) return before;
    return gap_within(s, middle, to);
  }

  /// Whether a term that may have a gap within `width` of a place has one: it is no number there,
  /// or beyond all it is at the ends of the stretch and changes by more than itself within the
  /// width, as 1/x does where x passes zero within it.
  bool ends_at(const Search& s, double share, double width) const {
    using Slope = Dual<1>;
    const Slope y = course_.evaluated<Slope>([&](std::size_t i) {
      Slope x(s.at(i, share));
      x.d[0] = s.b[i] - s.a[i];
      return x;
    });
    if (!std::isfinite(y.v) || !std::isfinite(y.d[0])) return true;
    return std::abs(y.v) > s.at_ends && std::abs(y.d[0]) * width > std::abs(y.v);
  }

  const OwnCourse& course_;
};

std::optional<OwnTermGap> first_gap(const OwnCourse& course, std::size_t own,
                                    const Timeline& timeline) {
  const GapSearch search(course);
  for (const Interval& i : timeline.intervals) {
    const auto gap_at = [&](double t) {
      return OwnTermGap{own, t - i.t_begin, i.position, i.slew};
    };
    Reading last{};
    for (std::size_t k = 0; k < i.node_count(); ++k) {
      const Node& node = timeline.nodes[i.first_node + k];
      const Reading here = course.reading(timeline, i, node);
      if (!std::isfinite(course.value_at(here))) return gap_at(node.t);
      if (k > 0)
        if (const auto share = search.gap_between(last, here))
          return gap_at(node.t -
                        (1.0 - *share) * (node.t - timeline.nodes[i.first_node + k - 1].t));
      last = here;
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<OwnTermGap> own_term_gaps(const Timeline& timeline, const ModelSpec& model) {
  std::vector<OwnTermGap> gaps;
  const TermMask terms = model.model().terms;
  for_each_own(timeline, model, [&](std::size_t own, const OwnCourse& course) {
    if (!terms[TermLibrary::num_known + own]) return;
    if (const auto gap = first_gap(course, own, timeline)) gaps.push_back(*gap);
  });
  return gaps;
}

}  // namespace drift
