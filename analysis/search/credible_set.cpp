#include "analysis/search/credible_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "analysis/inference/thresholds.hpp"
#include "analysis/search/scores/library_prior.hpp"

namespace drift::search {
namespace {

using inference::WeighLimits;

/// What an explanation is called: its terms and axes, in order; of a base term the parameters too.
std::string name_of(const Fitted& e, const Refit& r) {
  std::vector<std::string> names;
  for (const Choice& choice : r.choices) {
    const inference::Candidate& c = e.set.candidates[choice.candidate];
    const bool base = is_base(TermLibrary::terms[*TermLibrary::find_term(c.term)]);
    names.push_back(base ? c.label : c.term + "." + c.axis);
  }
  std::sort(names.begin(), names.end());
  std::string all;
  for (const std::string& n : names) all += n + " ";
  return all;
}

/// Whether an explanation says all that another says and more: each of the other's causes is one of
/// its own or part of one.
bool covers(const Fitted& e, const Refit& wide, const Refit& narrow) {
  // Noise that drives the platform in the place of a cause is no less.
  if (narrow.after.noise.driven && !wide.after.noise.driven) return false;
  return wide.choices.size() >= narrow.choices.size() &&
         std::ranges::all_of(narrow.choices, [&](const Choice& n) {
           return of_a_chosen_family(e.set, wide.choices, e.set.candidates[n.candidate]);
         });
}

/// Log evidence, against the nominal model, of something unknown in one equation; every equation,
/// form and period alike.
double log_unknown(const Fitted& e) {
  return std::max(0.5 * e.unknown->lone.gain - std::log(WeighLimits::forms),
                  e.unknown->periodic.log_evidence());
}

/// Whether two single explanations are one cause of which only the part is open: the same term, and
/// one of them speaks of no axis.
bool one_cause(const Fitted& e, const Refit& a, const Refit& b) {
  if (a.choices.size() != 1 || b.choices.size() != 1) return false;
  const inference::Candidate& p = e.set.candidates[a.choices.front().candidate];
  const inference::Candidate& q = e.set.candidates[b.choices.front().candidate];
  const bool base = is_base(TermLibrary::terms[*TermLibrary::find_term(p.term)]);
  return !base && p.term == q.term && (p.axis.empty() || q.axis.empty());
}

double log_weight(const Fitted& e, const Refit& r) {
  return r.log_bayes + LibraryPrior(e.set).log_within(r.choices) - std::max(0.0, r.excess);
}

/// Numbers of the heaviest first.
std::vector<std::size_t> by_weight(const std::vector<double>& weight) {
  std::vector<std::size_t> order(weight.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t k) { return weight[k]; });
  return order;
}

/// Which explanation stands for each: one that covers a simpler one nearly as good counts for that;
/// of several with one name, and of those that differ only in which part of a term it is, the best
/// stands for all.
std::vector<std::size_t> heads_of(const Fitted& e, const std::vector<Refit>& good,
                                  const std::vector<std::size_t>& order) {
  std::vector<std::size_t> head(good.size());
  std::iota(head.begin(), head.end(), 0u);
  for (std::size_t k = 0; k < good.size(); ++k)
    for (const std::size_t other : order)
      if (other != k && covers(e, good[k], good[other]) && !covers(e, good[other], good[k]) &&
          good[other].log_bayes > good[k].log_bayes - WeighLimits::more_parameters) {
        head[k] = other;
        break;
      }
  for (const std::size_t k : order) {
    if (head[k] != k) continue;
    for (const std::size_t other : order) {
      if (other == k) break;  // what comes later is no better
      if (head[other] == other &&
          (name_of(e, good[k]) == name_of(e, good[other]) || one_cause(e, good[k], good[other]))) {
        head[k] = other;
        break;
      }
    }
  }
  for (std::size_t& h : head)
    while (head[h] != h) h = head[h];
  return head;
}

/// Fits of the same causes at several settings each have the evidence of all of them: one counts.
void count_once(const std::vector<Refit>& good, const std::vector<std::size_t>& order,
                std::vector<double>& weight) {
  for (auto k = order.begin(); k != order.end(); ++k)
    if (std::any_of(order.begin(), k, [&](std::size_t heavier) {
          return same_causes(good[heavier].choices, good[*k].choices);
        }))
      weight[*k] = 0.0;
}

/// Of fits of the same causes that ended in several valleys of a setting (other_valleys.hpp), the
/// one of least cost: what evidence adds for the width of a valley, by the curvature of its rows,
/// is too much where the cost bends more than these say.
std::size_t deepest(const std::vector<Refit>& good, std::size_t k) {
  std::size_t best = k;
  const auto cost = [&](std::size_t n) { return good[n].after.fit.estimate.statistic; };
  for (std::size_t n = 0; n < good.size(); ++n)
    if (same_causes(good[n].choices, good[k].choices) && good[n].as_found == good[k].as_found &&
        good[n].excess <= std::max(0.0, good[k].excess) && cost(n) < cost(best))
      best = n;
  return best;
}

}  // namespace

bool can_be_weighed(const Fitted& e, const std::vector<Refit>& refits, Leftover left, Sizes sizes) {
  double top = -std::numeric_limits<double>::infinity();
  bool enough = false;
  for (const Refit& r : refits) {
    if (sizes == Sizes::as_found || !r.as_found)
      enough = enough || (left == Leftover::chance ? r.tolerable() : r.adequate());
    if (r.tolerable()) top = std::max(top, log_weight(e, r));
  }
  return enough && log_unknown(e) <=
                       top + WeighLimits::far_better + WeighLimits::not_linear * std::max(top, 0.0);
}

const Refit* heaviest(const Fitted& e, const std::vector<Refit>& refits) {
  const Refit* best = nullptr;
  for (const Refit& r : refits)
    if (r.tolerable() && (!best || log_weight(e, r) > log_weight(e, *best))) best = &r;
  return best;
}

std::vector<std::size_t> heaviest_within(const Fitted& e, const std::vector<Refit>& refits,
                                         double within) {
  std::vector<std::size_t> heavy;
  if (const Refit* best = heaviest(e, refits))
    for (std::size_t k = 0; k < refits.size(); ++k)
      if (refits[k].tolerable() && log_weight(e, refits[k]) >= log_weight(e, *best) - within)
        heavy.push_back(k);
  return heavy;
}

bool is_among(const std::vector<Refit>& refits, const Explanation& in) {
  return std::ranges::any_of(refits, [&](const Refit& r) { return same(r.choices, in); });
}

CredibleSet weigh(const Fitted& e, std::vector<Refit> refits, double credible) {
  CredibleSet out;
  std::vector<Refit> good;
  for (Refit& r : refits) (r.tolerable() ? good : out.rejected).push_back(std::move(r));
  std::vector<double> weight;
  for (const Refit& r : good) weight.push_back(log_weight(e, r));
  const double top = good.empty() ? 0.0 : std::ranges::max(weight);
  for (double& w : weight) w = std::exp(w - top);
  const std::vector<std::size_t> order = by_weight(weight);
  const std::vector<std::size_t> head = heads_of(e, good, order);
  count_once(good, order, weight);
  const double sum = std::accumulate(weight.begin(), weight.end(), 0.0);
  std::vector<double> together(good.size(), 0.0);
  for (std::size_t k = 0; k < good.size(); ++k) together[head[k]] += weight[k] / sum;
  for (std::size_t k = 0; k < good.size(); ++k)
    if (const std::size_t best = together[k] > 0.0 ? deepest(good, k) : k; together[best] <= 0.0)
      std::swap(together[k], together[best]);
  double held = 0.0;
  for (const std::size_t k : by_weight(together)) {
    if (together[k] <= 0.0) {  // another stands for it
      out.beside.push_back(std::move(good[k]));
      continue;
    }
    const bool listed = held < credible;
    held += together[k];
    if (listed)
      out.probability.push_back(together[k]);
    else
      out.unlisted.push_back({good[k].choices, together[k]});
    (listed ? out.sets : out.beside).push_back(std::move(good[k]));
  }
  return out;
}

}  // namespace drift::search
