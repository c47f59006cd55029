#include "core/sim/own_term_gaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/physics/expression/range.hpp"
#include "core/physics/own/own_terms.hpp"
#include "core/sim/kinematics.hpp"

namespace drift {
namespace {

/// All that an equation may read, by number; of use where it reads it.
using Reading = std::array<double, own_inputs.size() + most_further_columns>;

/// An own term with numbers in it, and what it reads.
class OwnCourse {
 public:
  OwnCourse(const OwnTerm& term, const ModelSpec& model, std::size_t first)
      : term_(term), mounting_(model.mounting) {
    for (std::size_t i = 0; i < term.params.size(); ++i) {
      const Prior& prior = model.priors[first + i];
      const bool drawn = TermLibrary::specs[first + i].amplitude();
      params_[i] = prior.mean() + (drawn ? prior.sigma() : 0.0);
    }
    for (std::size_t k = 0; k < term.program.size; ++k)
      if (term.program.code[k].op == Operation::input)
        read_.push_back(static_cast<std::size_t>(term.program.code[k].index));
  }

  Reading reading(const Timeline& timeline, const Interval& interval, const Node& node) const {
    Scene<double> scene(node.omega_ic_l, interval.omega_cmd_p, mounting_, node.R_lr);
    Needs needs = term_.needs;
    needs.clock = true;
    scene.look_around(needs, moment_at(timeline, interval, node.t), node.R_lr, nullptr);
    Reading all{};
    for (const std::size_t i : read_) all[i] = read_input(i, term_.target.axis, scene.in);
    return all;
  }

  bool is_number(const Reading& at) const { return std::isfinite(value_at(at)); }

  /// Where between two readings it is no finite number, as a share of the way.
  std::optional<double> gap_between(const Reading& a, const Reading& b) const {
    for (const std::size_t i : read_)
      // An angle that goes on from the other end of its circle.
      if (i < own_inputs.size() && own_inputs[i].needs.gimbals &&
          std::abs(b[i] - a[i]) > std::numbers::pi)
        return std::nullopt;
    Search search{a, b, std::max(std::abs(value_at(a)), std::abs(value_at(b)))};
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

  template <class S, class Input>
  S evaluated(Input&& input) const {
    std::array<S, most_own_parameters> p;
    std::copy(params_.begin(), params_.end(), p.begin());
    return evaluate_program(term_.program, p.data(),
                            [&](int i) -> S { return input(static_cast<std::size_t>(i)); });
  }
  double value_at(const Reading& at) const {
    return evaluated<double>([&](std::size_t i) { return at[i]; });
  }

  std::optional<double> gap_within(Search& s, double from, double to) const {
    constexpr double finest = 0x1p-20;  // of the stretch: still far above roundings of the time
    const Range range = evaluated<Range>([&](std::size_t i) {
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
    const Slope y = evaluated<Slope>([&](std::size_t i) {
      Slope x(s.at(i, share));
      x.d[0] = s.b[i] - s.a[i];
      return x;
    });
    if (!std::isfinite(y.v) || !std::isfinite(y.d[0])) return true;
    return std::abs(y.v) > s.at_ends && std::abs(y.d[0]) * width > std::abs(y.v);
  }

  const OwnTerm& term_;
  const Mounting& mounting_;
  std::array<double, most_own_parameters> params_{};
  std::vector<std::size_t> read_;
};

std::optional<OwnTermGap> first_gap(const OwnCourse& course, std::size_t own,
                                    const Timeline& timeline) {
  for (const Interval& i : timeline.intervals) {
    const auto gap_at = [&](double t) {
      return OwnTermGap{own, t - i.t_begin, i.position, i.slew};
    };
    Reading last{};
    for (std::size_t k = 0; k < i.node_count(); ++k) {
      const Node& node = timeline.nodes[i.first_node + k];
      const Reading here = course.reading(timeline, i, node);
      if (!course.is_number(here)) return gap_at(node.t);
      if (k > 0)
        if (const auto share = course.gap_between(last, here))
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
  for (std::size_t own = 0; own < own_terms().terms.size(); ++own) {
    const std::size_t t = TermLibrary::num_known + own;
    const OwnTerm& term = own_terms().terms[own];
    if (!terms[t] || !timeline.carries(term.needs)) continue;
    const OwnCourse course(term, model, TermLibrary::terms[t].first);
    if (const auto gap = first_gap(course, own, timeline)) gaps.push_back(*gap);
  }
  return gaps;
}

}  // namespace drift
