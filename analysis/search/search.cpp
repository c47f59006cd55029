#include "analysis/search/search.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "analysis/inference/thresholds.hpp"
#include "analysis/search/left_out_terms.hpp"
#include "analysis/search/other_equation.hpp"
#include "analysis/search/other_valleys.hpp"
#include "analysis/search/outside_form.hpp"
#include "analysis/search/posterior.hpp"
#include "analysis/search/promising.hpp"
#include "analysis/search/refine_grids.hpp"

namespace drift::search {
namespace {

using inference::EffortLimits;
using inference::ReachLimits;

/// What the best way to put a candidate in leaves.
Remainder least_remainder(const Search& s, std::size_t candidate) {
  Remainder least{1e300, 1e300, 0};
  if (s.nominal.scores[candidate].dof == 0) return least;
  const auto excess = [&](const Remainder& r) {
    return std::max(r.library / s.thresholds.library_threshold,
                    r.scan / s.thresholds.scan_threshold);
  };
  for (const Choice& way : ways_of(s.nominal, candidate))
    if (const Remainder r = remainder(s.nominal, {way}); excess(r) < excess(least)) least = r;
  return least;
}

void look_at_remainders(Search& s) {
  s.linear.clear();
  for (std::size_t k = 0; k < s.nominal.scores.size(); ++k)
    s.linear.push_back(least_remainder(s, k));
}

std::vector<Refit> refit_all(const Search& s, const MeasuredTest& test,
                             const std::vector<Explanation>& all, NoiseKinds kinds) {
  return refit_all(s.nominal, test, all, s.thresholds, kinds, Sizes::as_found);
}
std::vector<Refit> refit_all(const Search& s, const MeasuredTest& test,
                             const std::vector<Explanation>& all) {
  return refit_all(s, test, all, noise_beside(s.nominal));
}

/// Single causes, and more of their terms as long as a part is not adequate.
std::vector<Refit> refit_singles(const Search& s, const MeasuredTest& test, std::size_t most) {
  std::vector<std::size_t> singles = promising_singles(s, most);
  std::vector<Refit> refits;
  for (std::size_t done = 0; done < singles.size();) {
    std::vector<Explanation> tried;
    for (; done < singles.size(); ++done)
      for (const Choice& way : ways_of(s.nominal, singles[done])) tried.push_back({way});
    for (Refit& r : refit_all(s, test, tried)) {
      if (!r.adequate())
        for (const std::size_t k : more_than(s, r))
          if (std::ranges::find(singles, k) == singles.end()) singles.push_back(k);
      refits.push_back(std::move(r));
    }
  }
  return refits;
}

/// Whether an effect with the other equation would only stand for what it holds: one that leaves
/// nothing with the nominal equation, the slope of lambda included, and does as well (heads_of).
bool says_no_more(const Search& s, const BesideEquation& pair, const std::vector<Refit>& singles) {
  return std::ranges::any_of(singles, [&](const Refit& r) {
    return r.adequate() &&
           of_a_chosen_family(s.nominal.set, pair.choices,
                              s.nominal.set.candidates[r.choices.front().candidate]) &&
           pair.log_bayes < r.log_bayes + inference::WeighLimits::more_parameters;
  });
}

/// Effects with another equation that may do as well as the best; none where that alone will do.
std::vector<Explanation> worth_beside_equation(const Search& s, const MeasuredTest& test,
                                               const std::vector<Refit>& singles) {
  const Refit* best = nullptr;
  for (const Refit& r : singles) {
    if (!r.adequate()) continue;
    if (s.nominal.set.candidates[r.choices.front().candidate].term == closure_term) return {};
    if (!best || r.log_bayes > best->log_bayes) best = &r;
  }
  std::vector<Explanation> worth;
  for (BesideEquation& b : beside_other_equation(s, test, best ? &best->after.noise : nullptr))
    if (!says_no_more(s, b, singles) &&
        (!best || b.log_bayes > best->log_bayes - ReachLimits::negligible))
      worth.push_back(std::move(b.choices));
  return worth;
}

/// What is weighed must stand against less: the heaviest explanation without one of its causes and,
/// of sensors on a case, with a part of one, with the noise that is there then; as long as another
/// one comes to be the heaviest.
void add_fewer(const Search& s, const MeasuredTest& test, std::vector<Refit>& refits) {
  while (true) {
    const Refit* best = heaviest(s.nominal, refits);
    std::vector<Explanation> fewer;
    for (std::size_t k = 0; best && best->choices.size() > 1 && k < best->choices.size(); ++k) {
      Explanation others = best->choices;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
      fewer.push_back(std::move(others));
    }
    if (best && best->choices.size() > 1 && test.timeline.of_case)
      for (Explanation& smaller : with_parts(s, best->choices)) fewer.push_back(std::move(smaller));
    std::erase_if(fewer, [&](const Explanation& x) { return is_among(refits, x); });
    if (fewer.empty()) return;
    for (Refit& r : refit_all(s, test, fewer, NoiseKinds::driving_too))
      refits.push_back(std::move(r));
  }
}

/// Where effects took the place of noise that drives the platform, what a cause leaves that is just
/// significant may be such noise.
void with_driving_noise(const Search& s, const MeasuredTest& test, std::vector<Refit>& refits) {
  for (Refit& r : refits)
    if (r.tolerable() && !r.adequate() && !r.after.noise.driven)
      r = refit(s.nominal, test, r.choices, s.thresholds, NoiseKinds::driving_too, Sizes::as_found);
}

/// The best ways to put single candidates in that were not fitted yet.
std::vector<Explanation> not_tried(const Search& s, const std::vector<Refit>& refits,
                                   const std::vector<std::size_t>& singles) {
  std::vector<Explanation> all;
  for (const std::size_t k : singles) {
    Explanation one{{k, s.nominal.scores[k].variant}};
    if (!is_among(refits, one)) all.push_back(std::move(one));
  }
  return all;
}

/// Choices of what was fitted, into candidates whose variants were numbered anew.
void number_anew(std::vector<Refit>& refits, const std::vector<inference::Candidate>& before,
                 const std::vector<inference::Candidate>& now) {
  for (Refit& r : refits)
    for (Choice& c : r.choices)
      c.variant = variant_at(now[c.candidate], before[c.candidate].variants[c.variant].settings);
}

/// Looks between all points of the library's grids.
void look_between_all_points(Search& s, const MeasuredTest& test, std::vector<Refit>& refits) {
  const std::vector<inference::Candidate> before = s.nominal.set.candidates;
  s.nominal = refine_whole_grids(std::move(s.nominal), test);
  number_anew(refits, before, s.nominal.set.candidates);
  look_at_remainders(s);
}

/// What may be named is fitted in the other valleys of its settings, too.
void add_other_valleys(Search& s, const MeasuredTest& test, std::vector<Refit>& refits) {
  const std::vector<std::size_t> heavy =
      heaviest_within(s.nominal, refits, ReachLimits::negligible);
  std::vector<SettingFound> found;
  for (const std::size_t k : heavy)
    for (const SettingFound& f : settings_found(s.nominal, refits[k])) found.push_back(f);
  if (found.empty()) return;
  const std::vector<inference::Candidate> before = s.nominal.set.candidates;
  s.nominal = refine_about(std::move(s.nominal), test, found);
  number_anew(refits, before, s.nominal.set.candidates);
  std::vector<Explanation> more;
  for (const std::size_t k : heavy)
    for (Explanation& other : other_valleys(s.nominal, refits[k]))
      if (!is_among(refits, other)) more.push_back(std::move(other));
  for (Refit& r : refit_all(s, test, more))
    if (std::ranges::none_of(refits, [&](const Refit& o) { return same_valley(s.nominal, r, o); }))
      refits.push_back(std::move(r));
}

/// What was weighed, to be weighed again beside more.
std::vector<Refit> taken_back(Search& s) {
  std::vector<Refit> all;
  for (std::vector<Refit>* part : {&s.sets, &s.beside, &s.rejected})
    std::move(part->begin(), part->end(), std::back_inserter(all));
  return all;
}

/// Whether something outside the library is more probable than all single causes together. Then two
/// must stand against it.
bool asks_for_two(const Search& s) {
  return std::ranges::all_of(s.sets, [](const Refit& r) { return r.choices.size() == 1; }) &&
         posterior_of(s).outside > inference::SearchLimits::chance;
}

Search searched(Fitted nominal, const MeasuredTest& test, const SearchOptions& options) {
  Search out{{detect(std::move(nominal), test, options)}, {}, false, {}, {}, {}, never};
  if (out.significant)
    out.nominal = settle_without_slope(
        refine_grids(std::move(out.nominal), test, ReachLimits::worth_refining), test,
        ReachLimits::worth_refining);
  look_at_remainders(out);
  if (!out.significant) return out;

  std::vector<Refit> refits;
  const auto try_more = [&](std::vector<Explanation> more) {
    std::erase_if(more, [&](const Explanation& x) { return is_among(refits, x); });
    for (Refit& r : refit_all(out, test, more)) refits.push_back(std::move(r));
  };
  const auto weighed = [&] {
    add_fewer(out, test, refits);
    add_other_valleys(out, test, refits);
    static_cast<CredibleSet&>(out) = weigh(out.nominal, std::move(refits), options.credible);
    out.log_form = log_evidence_of_a_form(out, test);
  };
  // As long as anything is left to try, no size that nobody expects ends the search.
  const auto settled = [&](Leftover left, Sizes sizes = Sizes::of_library) {
    if (!can_be_weighed(out.nominal, refits, left, sizes)) return false;
    try_more(pairs_against(out, *heaviest(out.nominal, refits), options.most_refits));
    weighed();
    if (!asks_for_two(out)) return true;
    refits = taken_back(out);
    try_more(promising_pairs(out, options.most_refits));
    weighed();
    return true;
  };
  // Where such terms are left out and everything is far off, one effect will not mend it.
  const bool far_off = out.nominal.gross;
  if (far_off) {
    refits = refit_left_out_terms(out, test);
    if (settled(Leftover::nothing)) return out;
  }
  for (Refit& r : refit_singles(out, test, options.most_refits)) refits.push_back(std::move(r));
  try_more(worth_beside_equation(out, test, refits));
  // Another equation and an effect are two causes: two effects must stand against them.
  if (const Refit* best = heaviest(out.nominal, refits); best && best->choices.size() > 1)
    try_more(promising_pairs(out, options.most_refits));
  if (settled(Leftover::nothing)) return out;
  look_between_all_points(out, test, refits);
  try_more(not_tried(out, refits, promising_singles(out, options.most_refits)));
  if (settled(Leftover::nothing)) return out;
  try_more(promising_pairs(out, options.most_refits));
  if (settled(Leftover::nothing)) return out;
  try_more(promising_several(out));
  if (settled(Leftover::nothing)) return out;
  if (!far_off)
    for (Refit& r : refit_left_out_terms(out, test)) refits.push_back(std::move(r));
  if (settled(Leftover::nothing)) return out;
  if (out.noise_alone) {
    with_driving_noise(out, test, refits);
    if (settled(Leftover::nothing)) return out;
  }
  if (can_be_weighed(out.nominal, refits, Leftover::nothing, Sizes::as_found)) {
    try_more(not_tried(out, refits, as_good_with_credible_sizes(out)));
    if (settled(Leftover::nothing, Sizes::as_found)) return out;
  }
  out.just_not = settled(Leftover::chance, Sizes::as_found);
  if (!out.just_not) out.rejected = std::move(refits);
  return out;
}

}  // namespace

void give_settings_room(Search& s, const MeasuredTest& test) {
  for (Refit& r : s.sets)
    give_settings_room(r, s.nominal, test, s.thresholds, noise_beside(s.nominal));
}

Search search(Fitted nominal, const MeasuredTest& test, const SearchOptions& options) {
  Search out = searched(std::move(nominal), test, options);
  if (out.sets.empty()) return out;
  if (posterior_of(out).outside <= inference::SearchLimits::credible) return out;
  out.outweighed = std::exchange(out.sets, {});
  out.outweighed_probability = std::exchange(out.probability, {});
  out.just_not = false;
  return out;
}

}  // namespace drift::search
