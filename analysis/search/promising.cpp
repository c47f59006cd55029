#include "analysis/search/promising.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/thresholds.hpp"
#include "analysis/search/pairs.hpp"
#include "analysis/search/scores/library_prior.hpp"
#include "analysis/search/settings_alike.hpp"

namespace drift::search {
namespace {

using inference::EffortLimits;
using inference::ReachLimits;

/// Whether what is left is within so many times the thresholds.
bool within(const Remainder& left, const ChanceThresholds& t, double times) {
  return left.library <= times * t.library_threshold && left.scan <= times * t.scan_threshold;
}

/// Candidates that leave nothing significant by the linearised test, give or take, best first.
std::vector<std::size_t> adequate_by_score(const Search& s, double times) {
  std::vector<std::size_t> adequate = s.nominal.by_evidence();
  std::erase_if(adequate, [&](std::size_t k) { return !within(s.linear[k], s.thresholds, times); });
  return adequate;
}

/// The adequate ones; larger ones only where no part of them does as well.
std::vector<std::size_t> adequate_singles(const Search& s) {
  const Fitted& e = s.nominal;
  const std::vector<std::size_t> surely = adequate_by_score(s, 1.0);
  std::vector<std::size_t> kept;
  for (const std::size_t k : adequate_by_score(s, ReachLimits::slack)) {
    const inference::Candidate& c = e.set.candidates[k];
    const bool part_will_do = std::ranges::any_of(surely, [&](std::size_t other) {
      return c.contains(e.set.candidates[other]) &&
             e.scores[other].log_bayes > e.scores[k].log_bayes - ReachLimits::part;
    });
    if (!part_will_do && (kept.empty() || e.scores[kept.front()].log_bayes - e.scores[k].log_bayes <
                                              ReachLimits::negligible))
      kept.push_back(k);
  }
  return kept;
}

/// Further causes one by one, the strongest conditional score each time, until nothing is
/// significant or `most` are in; then those that are not needed are taken out again. Empty if it
/// never gets quiet, or with two that share a parameter.
std::vector<Choice> greedy(const Field& field, const std::vector<Score>& scores,
                           double library_threshold, double scan_threshold, std::size_t most) {
  std::vector<Choice> in;
  std::size_t next = 0;
  for (std::size_t k = 1; k < scores.size(); ++k)
    if (scores[k].strength > scores[next].strength) next = k;
  const auto quiet = [&](const Remainder& r) {
    return r.library <= library_threshold && r.scan <= scan_threshold;
  };
  Remainder r;
  do {
    in.push_back({next, scores[next].variant});
    r = remainder(field, in);
    next = r.strongest;
  } while (!quiet(r) && in.size() < most && r.library > library_threshold);
  if (!quiet(r)) return {};
  for (std::size_t k = 0; k < in.size() && in.size() > 1;) {
    std::vector<Choice> fewer = in;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
    if (quiet(remainder(field, fewer))) {
      in = fewer;
      k = 0;
    } else {
      ++k;
    }
  }
  for (std::size_t k = 0; k < in.size(); ++k)
    for (std::size_t n = 0; n < k; ++n)
      if (field.set.candidates[in[k].candidate].overlaps(field.set.candidates[in[n].candidate]))
        return {};
  return in;
}

/// Whether the parameters of a candidate are all of one unit that another one holds, and not all
/// that that one holds: the linear, the quadratic or the cubic part of a term.
bool is_part(const inference::CandidateSet& set, const inference::Candidate& whole,
             const inference::Candidate& c) {
  const auto unit_of = [](std::size_t param) {
    return TermLibrary::specs[param].unit.symbol.view();
  };
  const auto of_unit = [&](const inference::Candidate& o) {
    return whole.contains(o) && std::ranges::all_of(o.params, [&](std::size_t i) {
             return unit_of(i) == unit_of(c.params.front());
           });
  };
  return c.params.size() > 1 && of_unit(c) &&
         std::ranges::none_of(set.candidates, [&](const inference::Candidate& o) {
           return of_unit(o) && o.contains(c);
         });
}

}  // namespace

std::vector<Choice> ways_of(const Fitted& e, std::size_t k) {
  std::vector<Choice> ways;
  for (const std::size_t v :
       best_settings(e, k, ReachLimits::refit_setting, EffortLimits::settings))
    ways.push_back({k, v});
  return ways;
}

std::vector<std::size_t> promising_singles(const Search& s, std::size_t most) {
  const Fitted& e = s.nominal;
  std::vector<std::size_t> singles = adequate_singles(s);
  const auto add = [&](std::size_t k) {
    if (std::ranges::find(singles, k) == singles.end()) singles.push_back(k);
  };
  if (singles.size() > most) singles.resize(most);
  // A large effect may be beyond the linearised test; one that the other equation leaves far behind
  // is not.
  if (singles.empty()) {
    const std::vector<std::size_t> order = e.by_evidence();
    for (std::size_t k = 0; k < std::min(EffortLimits::large, order.size()); ++k)
      if (0.5 * s.other_equation - e.scores[order[k]].log_bayes <
          ReachLimits::large * ReachLimits::negligible)
        add(order[k]);
  }
  // The score is blind to a change of equation that only rescales the misalignments.
  for (std::size_t k = 0; k < e.set.candidates.size(); ++k)
    if (e.set.candidates[k].term == closure_term &&
        std::max(0.5 * s.other_equation, e.scores[k].strength) > s.thresholds.library_threshold)
      add(k);
  return singles;
}

std::vector<std::size_t> more_than(const Search& s, const Refit& part) {
  const std::vector<std::size_t> enough = adequate_by_score(s, ReachLimits::slack);
  const auto& candidates = s.nominal.set.candidates;
  const inference::Candidate& tried = candidates[part.choices.front().candidate];
  const inference::Candidate& asked = part.after.set.candidates[part.remainder.strongest];
  std::vector<std::size_t> more;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const inference::Candidate& whole = candidates[k];
    if (s.nominal.scores[k].dof == 0 || !whole.contains(tried)) continue;
    const bool asked_for =
        asked.term == tried.term && (whole.params == asked.params || whole.contains(asked));
    if (asked_for || std::ranges::find(enough, k) != enough.end()) more.push_back(k);
  }
  return more;
}

std::vector<std::size_t> as_good_with_credible_sizes(const Search& s) {
  const Fitted& e = s.nominal;
  const std::vector<std::size_t> order = e.by_evidence();
  std::vector<std::size_t> credible;
  for (const std::size_t k : order) {
    const Score& score = e.scores[k];
    if (score.log_bayes <
        (1.0 - inference::WeighLimits::not_linear) * e.scores[order.front()].log_bayes)
      break;
    const VecX size =
        expected_amplitudes(e.projected, e.set.candidates[k].variants[score.variant].columns);
    if (size.cwiseAbs().maxCoeff() <= inference::FitLimits::beyond_prior) credible.push_back(k);
  }
  return credible;
}

namespace {

/// Whether two causes are parts of one term that a candidate has together, of one axis or one group
/// of parameters; or share its settings. Of the unbalance of two gyros in different directions only
/// the whole term has both, with parameters besides that nothing asks for.
bool are_offered_together(const std::vector<inference::Candidate>& candidates,
                          const Explanation& pair) {
  const inference::Candidate &a = candidates[pair[0].candidate], &b = candidates[pair[1].candidate];
  if (a.term != b.term) return false;
  if (a.axis.empty() || b.axis.empty() || a.axis == b.axis) return true;
  if (!a.variants.front().settings.empty()) return true;
  const auto group = [](std::size_t param) { return TermLibrary::specs[param].group.view(); };
  const auto all_of_group = [&](const inference::Candidate& c) {
    return std::ranges::all_of(c.params,
                               [&](std::size_t i) { return group(i) == group(a.params.front()); });
  };
  return all_of_group(a) && all_of_group(b);
}

std::vector<Explanation> promising_pairs(const Search& s, std::size_t most,
                                         const WorthALook& worth) {
  constexpr double allowed = ReachLimits::pair_slack;  // of the thresholds
  std::vector<Explanation> pairs;
  for (const Pair& p :
       adequate_pairs(s.nominal, s.nominal.scores, allowed * s.thresholds.library_threshold,
                      allowed * s.thresholds.scan_threshold, most, worth))
    pairs.push_back({p.a, p.b});
  return pairs;
}

}  // namespace

std::vector<Explanation> promising_pairs(const Search& s, std::size_t most) {
  return promising_pairs(s, most, {});
}

std::vector<Explanation> pairs_against(const Search& s, const Refit& single, std::size_t most) {
  if (single.choices.size() > 1) return {};
  const Choice& cause = single.choices.front();
  // lambda is a jump, of which the linearised test says nothing.
  const auto is_closure = [&](const Choice& c) {
    return s.nominal.set.candidates[c.candidate].term == closure_term;
  };
  if (is_closure(cause)) return {};
  const LibraryPrior prior(s.nominal.set);
  const double of_single = std::max(single.log_bayes, s.nominal.scores[cause.candidate].log_bayes) +
                           prior.log_within(single.choices);
  const double least = of_single + std::log(1.0 - inference::SearchLimits::credible);
  return promising_pairs(s, most, [&](const Explanation& pair, double log_bayes) {
    const auto& candidates = s.nominal.set.candidates;
    if (are_offered_together(candidates, pair)) return false;
    const double most_of_it = log_bayes + prior.log_within(pair);
    return most_of_it > least && std::ranges::none_of(pair, is_closure) &&
           most_of_it + log_share_of_settings(s.nominal, pair) > least;
  });
}

std::vector<Explanation> promising_several(const Search& s) {
  const Explanation several = greedy(s.nominal, s.nominal.scores, s.thresholds.library_threshold,
                                     s.thresholds.scan_threshold, EffortLimits::together);
  if (several.size() <= 2) return {};
  return {several};
}

std::vector<Explanation> with_parts(const Search& s, const Explanation& in) {
  std::vector<Explanation> all;
  for (std::size_t k = 0; k < in.size(); ++k) {
    const inference::CandidateSet& set = s.nominal.set;
    for (std::size_t n = 0; n < set.candidates.size(); ++n) {
      if (!is_part(set, set.candidates[in[k].candidate], set.candidates[n])) continue;
      all.push_back(in);
      all.back()[k] = Choice{n, s.nominal.scores[n].variant};
    }
  }
  return all;
}

}  // namespace drift::search
