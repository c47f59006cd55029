#include "analysis/discovery/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>

#include "analysis/discovery/settle_noise.hpp"
#include "mc/campaign.hpp"

namespace drift::discovery {
namespace {

constexpr double negligible = 14.0;  // log evidence behind the best: less than one in a million

/// Candidates that leave nothing significant by the linearised test; larger ones only where no part
/// of them does as well.
std::vector<std::size_t> adequate_singles(const Examination& e, const Search& s) {
  constexpr double slack = 1.25;  // the refit decides
  std::vector<std::size_t> adequate;
  for (const std::size_t k : by_evidence(e))
    if (s.linear[k].library <= slack * s.nulls.library_threshold && s.linear[k].scan <= slack * s.nulls.scan_threshold)
      adequate.push_back(k);
  std::vector<std::size_t> kept;
  for (const std::size_t k : adequate) {
    const Candidate& c = e.set.candidates[k];
    const bool part_will_do = std::any_of(adequate.begin(), adequate.end(), [&](std::size_t other) {
      return c.contains(e.set.candidates[other]) && e.scores[other].log_bayes > e.scores[k].log_bayes - 3.0;
    });
    if (!part_will_do && (kept.empty() || e.scores[kept.front()].log_bayes - e.scores[k].log_bayes < negligible))
      kept.push_back(k);
  }
  return kept;
}

/// Log prior of an explanation: every term alike, shared by the candidates it offers; a second cause
/// is one in twenty.
double log_prior(const Examination& e, const std::vector<Choice>& choices) {
  std::map<std::string, double> offers;
  for (const Candidate& c : e.set.candidates) offers[c.term] += 1.0;
  double sum = 0.0;
  for (const Choice& c : choices) sum -= std::log(offers[e.set.candidates[c.candidate].term]);
  return sum - std::log(20.0) * static_cast<double>(choices.size() - 1);
}

/// What an explanation is called: its terms and axes, in order; of a base term the parameters too.
std::string name_of(const Examination& e, const Refit& r) {
  std::vector<std::string> names;
  for (const Choice& choice : r.choices) {
    const Candidate& c = e.set.candidates[choice.candidate];
    const bool base = *TermLibrary::find_term(c.term) < *TermLibrary::find_term("frame_closure");
    names.push_back(base ? c.label : c.term + "." + c.axis);
  }
  std::sort(names.begin(), names.end());
  std::string all;
  for (const std::string& n : names) all += n + " ";
  return all;
}

/// Whether an explanation says all that another says and more: each of the other's causes is one of its
/// own or part of one.
bool covers(const Examination& e, const Refit& wide, const Refit& narrow) {
  const auto held = [&](const Choice& n) {
    const Candidate& part = e.set.candidates[n.candidate];
    return std::any_of(wide.choices.begin(), wide.choices.end(), [&](const Choice& w) {
      const Candidate& whole = e.set.candidates[w.candidate];
      return w.candidate == n.candidate || (whole.term == part.term && whole.params == part.params) || whole.contains(part);
    });
  };
  return wide.choices.size() >= narrow.choices.size() && std::all_of(narrow.choices.begin(), narrow.choices.end(), held);
}

/// Log evidence, against the nominal model, of something unknown in one equation; every equation and form
/// alike.
double log_unknown(const Examination& e) {
  constexpr double forms = 21.0;
  return 0.5 * e.lone.gain - std::log(forms);
}

/// Keeps the adequate ones up to the credible probability; of several with one name the best stands for
/// all, and what says more is left out where less will do. None, if something unknown in one equation
/// explains the test far better than the best of them.
void weigh(const Examination& e, std::vector<Refit> refits, const SearchOptions& options, Search& out) {
  constexpr double worth = 3.0;        // log evidence that more parameters must bring
  constexpr double far_better = 5.0;   // one in a hundred and fifty,
  constexpr double not_linear = 0.05;  // and what the linearised evidence of a large effect may be wrong by
  std::vector<Refit> good;
  for (Refit& r : refits) (r.adequate ? good : out.rejected).push_back(std::move(r));
  if (good.empty()) return;
  std::vector<double> weight;
  for (const Refit& r : good) weight.push_back(r.log_bayes + log_prior(e, r.choices));
  const double top = *std::max_element(weight.begin(), weight.end());
  if (log_unknown(e) > top + far_better + not_linear * std::max(top, 0.0)) {
    for (Refit& r : good) out.rejected.push_back(std::move(r));
    return;
  }
  double sum = 0.0;
  for (double& w : weight) sum += w = std::exp(w - top);
  std::vector<std::size_t> order(good.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return weight[a] > weight[b]; });
  // By name; an explanation that covers a simpler one nearly as good counts for that.
  std::map<std::string, double> together;
  for (std::size_t k = 0; k < good.size(); ++k) {
    const Refit* stands_for = &good[k];
    for (const std::size_t other : order)
      if (other != k && covers(e, good[k], good[other]) && !covers(e, good[other], good[k]) &&
          good[other].log_bayes > good[k].log_bayes - worth) {
        stands_for = &good[other];
        break;
      }
    together[name_of(e, *stands_for)] += weight[k] / sum;
  }
  double held = 0.0;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return together[name_of(e, good[a])] > together[name_of(e, good[b])];
  });
  for (const std::size_t k : order) {
    const auto place = together.find(name_of(e, good[k]));
    if (place == together.end() || place->second <= 0.0) continue;  // a better one of this name is in
    held += place->second;
    out.probability.push_back(place->second);
    out.sets.push_back(std::move(good[k]));
    together.erase(place);
    if (held >= options.credible) break;
  }
}

/// Each explanation fitted, spread over threads.
std::vector<Refit> refit_all(const Examination& nominal, const Test& test, const std::vector<std::vector<Choice>>& all,
                             const Nulls& nulls) {
  std::vector<Refit> refits;
  if (all.size() == 1) {  // its own fits are spread over the threads then
    refits.push_back(refit(nominal, test, all.front(), nulls));
    return refits;
  }
  return mc::run_campaign(all.size(), [&](std::size_t k) { return refit(nominal, test, all[k], nulls); });
}

/// The same candidate in another examination's list; as many as there are if it has none.
std::size_t same_candidate(const CandidateSet& in, const Candidate& c) {
  const auto place = std::find_if(in.candidates.begin(), in.candidates.end(), [&](const Candidate& other) {
    return other.term == c.term && other.params == c.params && other.variants.size() == c.variants.size();
  });
  return static_cast<std::size_t>(place - in.candidates.begin());
}

/// What else is in the test once a cause is fitted that the linear score cannot judge (a change of equation
/// moves the misalignments far): the candidates that leave nothing beside it, by evidence.
std::vector<std::vector<Choice>> beside(const Refit& r, const CandidateSet& nominal, const Nulls& nulls) {
  constexpr std::size_t asked = 12, most = 3;
  constexpr double slack = 1.25;
  std::vector<std::vector<Choice>> pairs;
  Field field(r.after.set, r.after.projector->candidates(), r.after.scans);  // it has moved since it was examined
  field.discount = r.after.field->discount;
  const auto order = by_evidence(r.after);
  for (std::size_t i = 0; i < std::min(asked, order.size()) && pairs.size() < most; ++i) {
    const std::size_t variant = r.after.scores[order[i]].variant;
    const Remainder left = remainder(field, {{order[i], variant}}, slack * nulls.library_threshold);
    const std::size_t k = same_candidate(nominal, r.after.set.candidates[order[i]]);
    if (left.library <= slack * nulls.library_threshold && left.scan <= slack * nulls.scan_threshold &&
        k < nominal.candidates.size())
      pairs.push_back({r.choices.front(), {k, variant}});
  }
  return pairs;
}

}  // namespace

double other_equation_gain(const Examination& nominal, const Test& test) {
  FilterSpec other = nominal.filter;
  if (other.coupling == Coupling::eq5)
    other.coupling = Coupling::eq6;
  else if (other.coupling == Coupling::eq6)
    other.coupling = Coupling::eq5;
  else
    return -std::numeric_limits<double>::infinity();
  double best = -std::numeric_limits<double>::infinity();
  const auto here = theta_of(nominal.filter, nominal.fit);
  for (const Theta& start : {here, make_layout(other).theta}) {
    const BatchResult fit = fit_batch(other, test.timeline, test.readout, test.measured, start);
    LinearProblem problem = linear_problem(other, test, fit, {});
    problem.weight = nominal.problem.weight;
    best = std::max(best, Projector(problem, nominal.noise.model).candidates().log_likelihood2());
  }
  return best - nominal.log_likelihood2();
}

Search search(Examination& nominal, const Test& test, const SearchOptions& options) {
  Search out;
  out.nulls = make_nulls(nominal, options.alpha, options.draws);
  if (settle_noise(nominal, test, out.nulls.library_threshold))
    out.nulls = make_nulls(nominal, options.alpha, options.draws);
  out.pairs = pair_null(*nominal.field, std::max(200, options.draws / 8));

  double library = 0.0, scan = 0.0;
  for (const Score& s : nominal.scores) library = std::max(library, s.strength);
  for (const PositionScan& s : nominal.scans)
    for (const double T : s.T) scan = std::max(scan, strength(T, 1));
  // The other equation is a jump, not a small amplitude: by the likelihood ratio of two points,
  // P(2 log LR > T) <= exp(-T/2).
  const double other = out.other_equation = other_equation_gain(nominal, test);
  const auto pairs = strongest_pairs(*nominal.field, 1);
  out.p_library = out.nulls.library.p_value(std::max(library, 0.5 * other));
  out.p_scan = out.nulls.scan.p_value(scan);
  out.p_pairs = pairs.empty() ? 1.0 : out.pairs.p_value(pairs.front().strength);
  nominal.lone = strongest_lone_input(nominal.problem, nominal.noise.model);
  out.p_lone = nominal.lone.p_value;
  out.p_value = std::min({1.0, out.p_library / library_share, out.p_scan / scan_share, out.p_pairs / pair_share,
                          out.p_lone / lone_share});
  out.significant = out.p_value < options.alpha;

  for (std::size_t k = 0; k < nominal.scores.size(); ++k)
    out.linear.push_back(nominal.scores[k].dof == 0 ? Remainder{1e300, 1e300, 0}
                                                    : remainder(*nominal.field, {{k, nominal.scores[k].variant}}, 1e300));
  if (!out.significant) return out;

  const auto choice = [&](std::size_t k) { return Choice{k, nominal.scores[k].variant}; };
  std::vector<std::size_t> singles = adequate_singles(nominal, out);
  if (singles.size() > options.most_refits) singles.resize(options.most_refits);
  const auto order = by_evidence(nominal);
  const auto add = [&](std::size_t k) {
    if (std::find(singles.begin(), singles.end(), k) == singles.end()) singles.push_back(k);
  };
  // A large effect may be beyond the linearised test; one that the other equation leaves far behind is not.
  if (singles.empty())
    for (std::size_t k = 0; k < std::min<std::size_t>(2, order.size()); ++k)
      if (0.5 * other - nominal.scores[order[k]].log_bayes < 10.0 * negligible) add(order[k]);
  // The score is blind to a change of equation that only rescales the misalignments.
  for (std::size_t k = 0; k < nominal.set.candidates.size(); ++k)
    if (nominal.set.candidates[k].term == "frame_closure" &&
        (0.5 * other > out.nulls.library_threshold || nominal.scores[k].strength > out.nulls.library_threshold))
      add(k);
  std::vector<Refit> refits;
  while (refits.size() < singles.size()) {
    const std::size_t first = refits.size();
    std::vector<std::vector<Choice>> tried;
    for (std::size_t next = first; next < singles.size(); ++next) tried.push_back({choice(singles[next])});
    for (Refit& r : refit_all(nominal, test, tried, out.nulls)) refits.push_back(std::move(r));
    // Where a part of a term will not do because more of the same term is asked for, the term is tried.
    for (std::size_t next = first; next < refits.size(); ++next) {
      if (refits[next].adequate) continue;
      const Candidate& part = nominal.set.candidates[singles[next]];
      const Candidate& asked = refits[next].after.set.candidates[refits[next].remainder.strongest];
      if (asked.term != part.term) continue;
      for (std::size_t k = 0; k < nominal.set.candidates.size(); ++k) {
        const Candidate& whole = nominal.set.candidates[k];
        if (nominal.scores[k].dof > 0 && whole.contains(part) && (whole.params == asked.params || whole.contains(asked))) add(k);
      }
    }
  }
  weigh(nominal, std::move(refits), options, out);
  if (!out.sets.empty()) return out;

  std::vector<std::vector<Choice>> tried;
  for (const Refit& r : out.rejected)
    if (nominal.set.candidates[r.choices.front().candidate].term == "frame_closure" && r.log_bayes > 0.0)
      for (auto& pair : beside(r, nominal.set, out.nulls)) tried.push_back(std::move(pair));
  for (const Pair& p : adequate_pairs(*nominal.field, nominal.scores, 1.1 * out.nulls.library_threshold,
                                      1.1 * out.nulls.scan_threshold, options.most_refits))
    tried.push_back({p.a, p.b});
  weigh(nominal, refit_all(nominal, test, tried, out.nulls), options, out);
  if (!out.sets.empty()) return out;

  const auto several = greedy(*nominal.field, nominal.scores, out.nulls.library_threshold, out.nulls.scan_threshold, 4);
  if (several.size() > 2) {
    weigh(nominal, refit_all(nominal, test, {several}, out.nulls), options, out);
  }
  return out;
}

}  // namespace drift::discovery
