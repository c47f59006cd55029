#include "analysis/search/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string>

#include "analysis/search/credible_set.hpp"
#include "analysis/search/refine_grids.hpp"
#include "analysis/search/settle_noise.hpp"
#include "mc/task/campaign.hpp"

namespace drift::search {
namespace {

constexpr double negligible = 14.0;      // log evidence behind the best: less than one in a million
constexpr double worth_refining = 25.0;  // log evidence behind the best: a partner may lift it

/// Candidates that leave nothing significant by the linearised test, give or take `slack`: the
/// refit decides.
std::vector<std::size_t> adequate_by_score(const Examination& e, const Search& s, double slack) {
  std::vector<std::size_t> adequate;
  for (const std::size_t k : by_evidence(e))
    if (s.linear[k].library <= slack * s.nulls.library_threshold &&
        s.linear[k].scan <= slack * s.nulls.scan_threshold)
      adequate.push_back(k);
  return adequate;
}

constexpr double slack = 1.25;

/// A candidate at its strongest setting, and at another far from it that explains the test nearly
/// as well: which of two onsets it was, the refit decides.
std::vector<Choice> ways_of(const Examination& e, std::size_t k) {
  constexpr double nearly = 4.0;  // log evidence
  std::vector<Choice> ways;
  for (const std::size_t v : best_settings(*e.field, k, nearly, 2)) ways.push_back({k, v});
  return ways;
}

/// What the best of these ways leaves.
Remainder least_remainder(const Field& field, const std::vector<Choice>& ways, const Nulls& nulls) {
  Remainder least{1e300, 1e300, 0};
  const auto excess = [&](const Remainder& r) {
    return std::max(r.library / nulls.library_threshold, r.scan / nulls.scan_threshold);
  };
  for (const Choice& way : ways)
    if (const Remainder r = remainder(field, {way}, 1e300); excess(r) < excess(least)) least = r;
  return least;
}

/// The adequate ones; larger ones only where no part of them does as well.
std::vector<std::size_t> adequate_singles(const Examination& e, const Search& s) {
  const std::vector<std::size_t> adequate = adequate_by_score(e, s, slack),
                                 surely = adequate_by_score(e, s, 1.0);
  std::vector<std::size_t> kept;
  for (const std::size_t k : adequate) {
    const inference::Candidate& c = e.set.candidates[k];
    const bool part_will_do = std::any_of(surely.begin(), surely.end(), [&](std::size_t other) {
      return c.contains(e.set.candidates[other]) &&
             e.scores[other].log_bayes > e.scores[k].log_bayes - 3.0;
    });
    if (!part_will_do &&
        (kept.empty() || e.scores[kept.front()].log_bayes - e.scores[k].log_bayes < negligible))
      kept.push_back(k);
  }
  return kept;
}

/// Each explanation fitted, spread over threads.
std::vector<Refit> refit_all(const Examination& nominal, const inference::Test& test,
                             const std::vector<std::vector<Choice>>& all, const Nulls& nulls) {
  std::vector<Refit> refits;
  if (all.size() == 1) {  // its own fits are spread over the threads then
    refits.push_back(refit(nominal, test, all.front(), nulls));
    return refits;
  }
  return mc::run_campaign(all.size(),
                          [&](std::size_t k) { return refit(nominal, test, all[k], nulls); });
}

/// The same candidate at the same setting in another examination's list, if it has it.
std::optional<Choice> same_choice(const inference::CandidateSet& in, const inference::Candidate& c,
                                  std::size_t variant) {
  for (std::size_t k = 0; k < in.candidates.size(); ++k) {
    const inference::Candidate& other = in.candidates[k];
    if (other.term != c.term || other.params != c.params) continue;
    for (std::size_t v = 0; v < other.variants.size(); ++v)
      if (other.variants[v].settings == c.variants[variant].settings) return Choice{k, v};
  }
  return {};
}

/// What else is in the test once a cause is fitted that the linear score cannot judge (a change of
/// equation moves the misalignments far): the candidates that leave nothing beside it, by evidence.
std::vector<std::vector<Choice>> beside(const Refit& r, const inference::CandidateSet& nominal,
                                        const Nulls& nulls) {
  constexpr std::size_t asked = 12, most = 3;
  std::vector<std::vector<Choice>> pairs;
  Field field(r.after.set, r.after.projector->candidates(),
              r.after.scans);  // it has moved since it was examined
  field.discount = r.after.field->discount;
  const auto order = by_evidence(r.after);
  for (std::size_t i = 0; i < std::min(asked, order.size()) && pairs.size() < most; ++i) {
    const std::size_t variant = r.after.scores[order[i]].variant;
    const Remainder left = remainder(field, {{order[i], variant}}, slack * nulls.library_threshold);
    const auto other = same_choice(nominal, r.after.set.candidates[order[i]], variant);
    if (left.library <= slack * nulls.library_threshold &&
        left.scan <= slack * nulls.scan_threshold && other)
      pairs.push_back({r.choices.front(), *other});
  }
  return pairs;
}

}  // namespace

double other_equation_gain(const Examination& nominal, const inference::Test& test) {
  FilterSpec other = nominal.filter;
  if (other.coupling == Coupling::eq5)
    other.coupling = Coupling::eq6;
  else if (other.coupling == Coupling::eq6)
    other.coupling = Coupling::eq5;
  else
    return -std::numeric_limits<double>::infinity();
  double best = -std::numeric_limits<double>::infinity();
  const auto here = inference::theta_of(nominal.filter, nominal.fit);
  for (const Theta& start : {here, make_layout(other).theta}) {
    const BatchResult fit = fit_batch(other, test.timeline, test.readout, test.measured, start);
    inference::LinearProblem problem = inference::linear_problem(other, test, fit, {});
    problem.weight = nominal.problem.weight;
    best = std::max(
        best, inference::Projector(problem, nominal.noise.model).candidates().log_likelihood2());
  }
  return best - nominal.log_likelihood2();
}

Search search(Examination& nominal, const inference::Test& test, const SearchOptions& options) {
  Search out;
  out.nulls = make_nulls(nominal, options.alpha, options.draws);
  if (settle_noise(nominal, test, out.nulls.library_threshold))
    out.nulls = make_nulls(nominal, options.alpha, options.draws);
  out.pairs = pair_null(*nominal.field, std::max(200, options.draws / 8));

  double library = 0.0, scan = 0.0;
  for (const Score& s : nominal.scores) library = std::max(library, s.strength);
  for (const inference::PositionScan& s : nominal.scans)
    for (const double T : s.T) scan = std::max(scan, stats::strength(T, 1));
  // The other equation is a jump, not a small amplitude: by the likelihood ratio of two points,
  // P(2 log LR > T) <= exp(-T/2).
  const double other = out.other_equation = other_equation_gain(nominal, test);
  const auto pairs = strongest_pairs(*nominal.field, 1);
  out.p_library = out.nulls.library.p_value(std::max(library, 0.5 * other));
  out.p_scan = out.nulls.scan.p_value(scan);
  out.p_pairs = pairs.empty() ? 1.0 : out.pairs.p_value(pairs.front().strength);
  nominal.lone = inference::strongest_lone_input(nominal.problem, nominal.noise.model);
  out.p_lone = nominal.lone.p_value;
  out.p_value = std::min({1.0, out.p_library / library_share, out.p_scan / scan_share,
                          out.p_pairs / pair_share, out.p_lone / lone_share});
  out.significant = out.p_value < options.alpha;

  if (out.significant) refine_grids(nominal, test, worth_refining);
  for (std::size_t k = 0; k < nominal.scores.size(); ++k)
    out.linear.push_back(nominal.scores[k].dof == 0
                             ? Remainder{1e300, 1e300, 0}
                             : least_remainder(*nominal.field, ways_of(nominal, k), out.nulls));
  if (!out.significant) return out;

  std::vector<std::size_t> singles = adequate_singles(nominal, out);
  if (singles.size() > options.most_refits) singles.resize(options.most_refits);
  const auto order = by_evidence(nominal);
  const auto add = [&](std::size_t k) {
    if (std::find(singles.begin(), singles.end(), k) == singles.end()) singles.push_back(k);
  };
  // A large effect may be beyond the linearised test; one that the other equation leaves far behind
  // is not.
  if (singles.empty())
    for (std::size_t k = 0; k < std::min<std::size_t>(2, order.size()); ++k)
      if (0.5 * other - nominal.scores[order[k]].log_bayes < 10.0 * negligible) add(order[k]);
  // The score is blind to a change of equation that only rescales the misalignments.
  for (std::size_t k = 0; k < nominal.set.candidates.size(); ++k)
    if (nominal.set.candidates[k].term == "frame_closure" &&
        (0.5 * other > out.nulls.library_threshold ||
         nominal.scores[k].strength > out.nulls.library_threshold))
      add(k);
  const auto enough = adequate_by_score(nominal, out, slack);
  std::vector<Refit> refits;
  for (std::size_t done = 0; done < singles.size();) {
    std::vector<std::vector<Choice>> tried;
    for (; done < singles.size(); ++done)
      for (const Choice& way : ways_of(nominal, singles[done])) tried.push_back({way});
    const std::size_t first = refits.size();
    for (Refit& r : refit_all(nominal, test, tried, out.nulls)) refits.push_back(std::move(r));
    // Where a part of a term will not do, more of the term is tried: what the linearised test finds
    // adequate, and what the refit asks for.
    for (std::size_t next = first; next < refits.size(); ++next) {
      if (refits[next].adequate()) continue;
      const inference::Candidate& part =
          nominal.set.candidates[refits[next].choices.front().candidate];
      const inference::Candidate& asked =
          refits[next].after.set.candidates[refits[next].remainder.strongest];
      for (std::size_t k = 0; k < nominal.set.candidates.size(); ++k) {
        const inference::Candidate& whole = nominal.set.candidates[k];
        if (nominal.scores[k].dof == 0 || !whole.contains(part)) continue;
        const bool asked_for =
            asked.term == part.term && (whole.params == asked.params || whole.contains(asked));
        if (asked_for || std::find(enough.begin(), enough.end(), k) != enough.end()) add(k);
      }
    }
  }
  if (weigh(nominal, refits, false, options, out)) return out;

  const auto try_more = [&](const std::vector<std::vector<Choice>>& tried) {
    for (Refit& r : refit_all(nominal, test, tried, out.nulls)) refits.push_back(std::move(r));
  };
  std::vector<std::vector<Choice>> tried;
  for (const Refit& r : refits)
    if (nominal.set.candidates[r.choices.front().candidate].term == "frame_closure" &&
        r.log_bayes > 0.0)
      for (auto& pair : beside(r, nominal.set, out.nulls)) tried.push_back(std::move(pair));
  for (const Pair& p :
       adequate_pairs(*nominal.field, nominal.scores, 1.1 * out.nulls.library_threshold,
                      1.1 * out.nulls.scan_threshold, options.most_refits))
    tried.push_back({p.a, p.b});
  try_more(tried);
  if (weigh(nominal, refits, false, options, out)) return out;

  const auto several = greedy(*nominal.field, nominal.scores, out.nulls.library_threshold,
                              out.nulls.scan_threshold, 4);
  if (several.size() > 2) try_more({several});
  if (weigh(nominal, refits, false, options, out)) return out;
  out.just_not = weigh(nominal, refits, true, options, out);
  for (Refit& r : refits) out.rejected.push_back(std::move(r));
  return out;
}

}  // namespace drift::search
