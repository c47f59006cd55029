#include "analysis/search/credible_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>

namespace drift::search {
namespace {

/// Log prior of an explanation: every term alike, shared by the candidates it offers; a second
/// cause is one in twenty.
double log_prior(const Examination& e, const std::vector<Choice>& choices) {
  std::map<std::string, double> offers;
  for (const inference::Candidate& c : e.set.candidates) offers[c.term] += 1.0;
  double sum = 0.0;
  for (const Choice& c : choices) sum -= std::log(offers[e.set.candidates[c.candidate].term]);
  return sum - std::log(20.0) * static_cast<double>(choices.size() - 1);
}

/// What an explanation is called: its terms and axes, in order; of a base term the parameters too.
std::string name_of(const Examination& e, const Refit& r) {
  std::vector<std::string> names;
  for (const Choice& choice : r.choices) {
    const inference::Candidate& c = e.set.candidates[choice.candidate];
    const bool base = *TermLibrary::find_term(c.term) < *TermLibrary::find_term("frame_closure");
    names.push_back(base ? c.label : c.term + "." + c.axis);
  }
  std::sort(names.begin(), names.end());
  std::string all;
  for (const std::string& n : names) all += n + " ";
  return all;
}

/// Whether an explanation says all that another says and more: each of the other's causes is one of
/// its own or part of one.
bool covers(const Examination& e, const Refit& wide, const Refit& narrow) {
  const auto held = [&](const Choice& n) {
    const inference::Candidate& part = e.set.candidates[n.candidate];
    return std::any_of(wide.choices.begin(), wide.choices.end(), [&](const Choice& w) {
      const inference::Candidate& whole = e.set.candidates[w.candidate];
      return w.candidate == n.candidate ||
             (whole.term == part.term && whole.params == part.params) || whole.contains(part);
    });
  };
  return wide.choices.size() >= narrow.choices.size() &&
         std::all_of(narrow.choices.begin(), narrow.choices.end(), held);
}

/// Log evidence, against the nominal model, of something unknown in one equation; every equation
/// and form alike.
double log_unknown(const Examination& e) {
  constexpr double forms = 21.0;
  return 0.5 * e.lone.gain - std::log(forms);
}

/// Whether two single explanations are one cause of which only the part is open: the same term, and
/// one of them speaks of no axis.
bool one_cause(const Examination& e, const Refit& a, const Refit& b) {
  if (a.choices.size() != 1 || b.choices.size() != 1) return false;
  const inference::Candidate& p = e.set.candidates[a.choices.front().candidate];
  const inference::Candidate& q = e.set.candidates[b.choices.front().candidate];
  const bool base = *TermLibrary::find_term(p.term) < *TermLibrary::find_term("frame_closure");
  return !base && p.term == q.term && (p.axis.empty() || q.axis.empty());
}

}  // namespace

bool weigh(const Examination& e, std::vector<Refit>& refits, bool chance_alone,
           const SearchOptions& options, Search& out) {
  constexpr double worth = 3.0;       // log evidence that more parameters must bring
  constexpr double far_better = 5.0;  // one in a hundred and fifty,
  constexpr double not_linear =
      0.05;  // and what the linearised evidence of a large effect may be wrong by
  const auto is_good = [](const Refit& r) { return r.tolerable(); };
  const bool enough = chance_alone ? std::ranges::any_of(refits, is_good)
                                   : std::ranges::any_of(refits, &Refit::adequate);
  if (!enough) return false;
  const auto weight_of = [&](const Refit& r) {
    return r.log_bayes + log_prior(e, r.choices) - std::max(0.0, r.excess);
  };
  double top = -std::numeric_limits<double>::infinity();
  for (const Refit& r : refits)
    if (is_good(r)) top = std::max(top, weight_of(r));
  if (log_unknown(e) > top + far_better + not_linear * std::max(top, 0.0)) return false;
  std::vector<Refit> good;
  for (Refit& r : refits) (is_good(r) ? good : out.rejected).push_back(std::move(r));
  refits.clear();
  std::vector<double> weight;
  for (const Refit& r : good) weight.push_back(weight_of(r));
  double sum = 0.0;
  for (double& w : weight) sum += w = std::exp(w - top);
  std::vector<std::size_t> order(good.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return weight[a] > weight[b]; });
  // An explanation that covers a simpler one nearly as good counts for that; of several with one
  // name, and of those that differ only in which part of a term it is, the best stands for all.
  std::vector<std::size_t> stands_for(good.size());
  std::iota(stands_for.begin(), stands_for.end(), 0u);
  for (std::size_t k = 0; k < good.size(); ++k)
    for (const std::size_t other : order)
      if (other != k && covers(e, good[k], good[other]) && !covers(e, good[other], good[k]) &&
          good[other].log_bayes > good[k].log_bayes - worth) {
        stands_for[k] = other;
        break;
      }
  for (const std::size_t k : order) {
    if (stands_for[k] != k) continue;
    for (const std::size_t other : order) {
      if (other == k) break;  // what comes later is no better
      if (stands_for[other] == other &&
          (name_of(e, good[k]) == name_of(e, good[other]) || one_cause(e, good[k], good[other]))) {
        stands_for[k] = other;
        break;
      }
    }
  }
  std::vector<double> together(good.size(), 0.0);
  for (std::size_t k = 0; k < good.size(); ++k) {
    std::size_t head = k;
    while (stands_for[head] != head) head = stands_for[head];
    together[head] += weight[k] / sum;
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return together[a] > together[b]; });
  double held = 0.0;
  for (const std::size_t k : order) {
    if (together[k] <= 0.0) break;
    held += together[k];
    out.probability.push_back(together[k]);
    out.sets.push_back(std::move(good[k]));
    if (held >= options.credible) break;
  }
  return true;
}

}  // namespace drift::search
