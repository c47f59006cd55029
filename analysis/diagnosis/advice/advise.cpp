#include "analysis/diagnosis/advice/advise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/diagnosis/advice/alternatives.hpp"
#include "analysis/diagnosis/advice/extended_test.hpp"
#include "analysis/inference/misalignments.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/planning/choose_additions.hpp"
#include "analysis/search/scores/field.hpp"

namespace drift::diagnosis {
namespace {

using inference::AdviceLimits;
using inference::TraceLimits;

using Pool = std::vector<planning::Candidate<planning::Information>>;

/// What is said where a test tells all that is asked.
enum class IfTold { say_so, say_nothing };

/// What lambda does goes with the misalignments: where the test has not seen them they stand near
/// zero, yet may be as large as their sigma. Their root mean square size is what is to be expected.
BatchResult with_expected_misalignments(BatchResult fit) {
  for (ParameterEstimate& p : fit.estimate.parameters) {
    if (inference::is_misalignment(p.param))
      p.value = std::copysign(std::hypot(p.value, p.sigma), p.value);
  }
  return fit;
}

/// Pairs of a question, either way round once.
std::size_t count_pairs(const std::vector<planning::Contest>& pairs) {
  return static_cast<std::size_t>(
      std::count_if(pairs.begin(), pairs.end(), [&](const planning::Contest& p) {
        return p.truth < p.rival || std::find(pairs.begin(), pairs.end(),
                                              planning::Contest{p.rival, p.truth}) == pairs.end();
      }));
}

std::vector<AdvisedPair> closest_first(std::vector<AdvisedPair> pairs) {
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const AdvisedPair& a, const AdvisedPair& b) { return a.after < b.after; });
  return pairs;
}

Advice advice_on(const Question& q, Advice::Kind kind, std::vector<AdvisedPair> pairs) {
  Advice a;
  a.kind = kind;
  a.alternatives = q.alternatives;
  a.sizes = q.sizes;
  a.names = q.names;
  for (const AdvisedPair& p : pairs) {
    a.now_sigma = std::fmin(a.now_sigma, p.now);  // of a number and NaN the number
    a.expected_sigma = std::fmin(a.expected_sigma, p.after);
  }
  a.pairs = std::move(pairs);
  return a;
}

/// A question, where it is linearised, and what the recordings tell of it.
struct Posed {
  Question question;
  BatchResult at;
  Columns columns;
  planning::Information recorded;

  /// Its pairs with this information.
  std::vector<planning::Separation> apart(const planning::Information& info) const {
    return planning::separations(info, columns.traces, question.pairs);
  }
};

/// Pairs by what can be done for them.
struct Sorted {
  std::vector<AdvisedPair> open, helped, twins, hidden;
};

/// By what the whole pool taken together would tell.
Sorted sorted_pairs(const Posed& p, const Pool& pool, double wanted) {
  planning::Information whole = p.recorded;
  for (const auto& candidate : pool) whole += candidate.gain;
  const auto now = p.apart(p.recorded), most = p.apart(whole);
  Sorted out;
  for (std::size_t k = 0; k < most.size(); ++k) {
    const AdvisedPair pair{p.question.pairs[k], now[k].sigma, now[k].sigma};
    const bool nominal = p.question.alternatives[pair.pair.rival].causes.empty();
    const double by_shape = nominal ? most[k].sigma : std::sqrt(most[k].unlike) * most[k].alone;
    if (!nominal && (most[k].unlike < TraceLimits::unlike_anywhere ||
                     (inference::same_trace_of_unlike(most[k].unlike) && by_shape < wanted)))
      out.twins.push_back(pair);
    else if (by_shape < AdviceLimits::told)
      out.hidden.push_back(pair);
    else
      out.open.push_back(pair);
  }
  return out;
}

/// Leaves out the pairs that positions help the other way round. What fits an effect alone are also
/// that effect and another together, the other as small as it likes, and no position changes that;
/// yet where both act it is told.
void leave_out_helped(std::vector<AdvisedPair>& pairs, const std::vector<AdvisedPair>& helped) {
  std::erase_if(pairs, [&](const AdvisedPair& p) {
    const planning::Contest other_way{p.pair.rival, p.pair.truth};
    return std::ranges::find(helped, other_way, &AdvisedPair::pair) != helped.end();
  });
}

class Adviser {
 public:
  Adviser(const mc::Study& study, const std::vector<Recording>& recordings, const Diagnosis& d,
          const AdviseOptions& options)
      : study_(study), d_(d), options_(options), test_(study, recordings, d) {}

  inference::CandidateSet candidates() const {
    return inference::library_candidates(d_.nominal, theta_of(d_.nominal, test_.fit()),
                                         test_.timeline());
  }

  /// What looks most like a named cause, of each term and axis that it can be confused with.
  std::vector<Rival> rivals(const inference::CandidateSet& set) const {
    std::vector<Rival> all;
    const Columns named = columns_of(named_question(d_, set, {}).alternatives, d_.nominal,
                                     theta_of(d_.nominal, test_.fit()));
    for (std::size_t cause = 0; cause < d_.causes.size(); ++cause)
      for (const search::Confusable& like : d_.causes[cause].confusable_with) {
        auto signatures = named.signatures;
        std::vector<std::pair<Rival, std::vector<int>>> possible;  // with their columns
        for (std::size_t c = 0; c < set.candidates.size(); ++c) {
          if (set.candidates[c].term != like.term || set.candidates[c].axis != like.axis) continue;
          for (std::size_t v = 0; v < set.candidates[c].variants.size(); ++v) {
            possible.push_back({{cause, c, v}, {}});
            for (const int column : set.candidates[c].variants[v].columns) {
              possible.back().second.push_back(static_cast<int>(signatures.size()));
              signatures.push_back(set.signatures[static_cast<std::size_t>(column)]);
            }
          }
        }
        const inference::Projected p = test_.projector(signatures).candidates();
        double most = -1.0;
        std::optional<Rival> nearest;
        for (const auto& [rival, columns] : possible)
          if (const double c = std::abs(search::cosine(p, named.traces.front().columns, columns));
              c > most) {
            most = c;
            nearest = rival;
          }
        if (nearest) all.push_back(*nearest);
      }
    return all;
  }

  std::vector<Advice> answer(const Question& asked, IfTold if_told) const {
    if (asked.empty()) return {};
    const bool lambda =
        std::any_of(asked.alternatives.begin(), asked.alternatives.end(), holds_lambda);
    const BatchResult at = lambda ? with_expected_misalignments(test_.fit()) : test_.fit();
    const Posed all = posed(asked, at);
    const auto now = all.apart(all.recorded);
    std::vector<AdvisedPair> recorded;
    std::vector<planning::Contest> near;
    for (std::size_t k = 0; k < now.size(); ++k) {
      recorded.push_back({asked.pairs[k], now[k].sigma, now[k].sigma});
      if (now[k].sigma < options_.wanted) near.push_back(asked.pairs[k]);
    }
    if (near.empty() && if_told == IfTold::say_nothing) return {};
    if (near.empty())
      return {advice_on(asked, Advice::Kind::told, closest_first(std::move(recorded)))};

    const Posed open = posed(restricted(asked, near), at);
    const Position& first = study_.plan.positions.front();
    const Pool pool = planning::integrated(
        planning::position_pool(first.dwell, first.sample),
        [&](const planning::Addition& a) { return test_.added(a, at, open.columns.signatures); });
    return planned_advice(open, pool, count_pairs(asked.pairs));
  }

 private:
  Posed posed(Question q, const BatchResult& at) const {
    Columns columns = columns_of(q.alternatives, d_.nominal, theta_of(d_.nominal, at));
    planning::Information recorded = test_.recorded(at, columns.signatures);
    return {std::move(q), at, std::move(columns), std::move(recorded)};
  }

  /// The additions chosen for some pairs, in their order: what changes with time goes on from one
  /// to the next.
  planning::Addition chosen(const Posed& p, const Pool& pool,
                            const std::vector<planning::Contest>& pairs) const {
    planning::Addition in_turn;
    for (const std::size_t k : planning::choose_additions(
             p.recorded, pool, {p.columns.traces, pairs, options_.most, options_.wanted}))
      in_turn.insert(in_turn.end(), pool[k].positions.begin(), pool[k].positions.end());
    return in_turn;
  }

  std::vector<Advice> planned_advice(const Posed& p, const Pool& pool, std::size_t asked) const {
    Sorted sorted = sorted_pairs(p, pool, options_.wanted);
    std::vector<planning::Contest> open;
    for (const AdvisedPair& pair : sorted.open) open.push_back(pair.pair);
    planning::Addition plan = chosen(p, pool, open);
    planning::Information with = p.recorded;
    if (!plan.empty()) with += test_.added(plan, p.at, p.columns.signatures);
    const auto then = planning::separations(with, p.columns.traces, open);
    for (std::size_t k = 0; k < then.size(); ++k) {
      AdvisedPair& pair = sorted.open[k];
      const bool helps = then[k].sigma >= AdviceLimits::told && then[k].sigma > pair.now;
      if (helps) pair.after = then[k].sigma;
      (helps ? sorted.helped : sorted.hidden).push_back(pair);
    }
    leave_out_helped(sorted.twins, sorted.helped);
    leave_out_helped(sorted.hidden, sorted.helped);
    std::vector<Advice> all;
    const double usual = study_.plan.positions.front().dwell;
    if (!sorted.helped.empty()) {
      Advice a = advice_on(p.question, Advice::Kind::add, closest_first(std::move(sorted.helped)));
      for (std::size_t k = 0; k < plan.size(); ++k)
        plan[k].name = fmt::format("advised {}: {}", k + 1, planning::description(plan[k], usual));
      a.plan = std::move(plan);
      a.asked = asked;
      const planning::Contest& closest = a.pairs.front().pair;
      a.verified_sigma =
          test_.verified(a.plan, a.alternatives[closest.truth], a.alternatives[closest.rival],
                         theta_of(d_.nominal, p.at), options_.seed);
      all.push_back(std::move(a));
    }
    if (!sorted.twins.empty())
      all.push_back(advice_on(p.question, Advice::Kind::twins, std::move(sorted.twins)));
    if (!sorted.hidden.empty())
      all.push_back(advice_on(p.question, Advice::Kind::hidden, std::move(sorted.hidden)));
    for (Advice& a : all) {
      a.usual_dwell = usual;
      a.wanted = options_.wanted;
      a.most = options_.most;
      a.pool = pool.size();
    }
    return all;
  }

  const mc::Study& study_;
  const Diagnosis& d_;
  AdviseOptions options_;
  ExtendedTest test_;
};

/// Where most of the misfit is that nothing explains.
Advice repeat(const Diagnosis& d, const TestPlan& plan) {
  Advice a;
  a.kind = Advice::Kind::repeat;
  for (const Share& s : d.where.positions) {
    if (s.position < 1 || static_cast<std::size_t>(s.position) > plan.positions.size()) continue;
    a.position = s.position;
    a.position_name = plan.positions[static_cast<std::size_t>(s.position) - 1].name;
    break;
  }
  return a;
}

}  // namespace

std::vector<Advice> advise(const mc::Study& study, const std::vector<Recording>& recordings,
                           const Diagnosis& diagnosis, const AdviseOptions& options) {
  const Question open = open_question(diagnosis);
  if (!options.asked && open.empty()) return {};
  const Adviser adviser(study, recordings, diagnosis, options);
  if (!options.asked) return adviser.answer(open, IfTold::say_nothing);
  const inference::CandidateSet set = adviser.candidates();
  std::vector<Advice> all;
  if (!options.asked->empty()) {
    all = adviser.answer(asked_question(diagnosis, set, *options.asked), IfTold::say_so);
  } else if (diagnosis.verdict == Verdict::consistent) {
    return adviser.answer(hidden_question(diagnosis, set), IfTold::say_so);
  } else if (diagnosis.verdict == Verdict::named) {
    const bool varies = follows_what_varies(diagnosis.causes);
    const Question q =
        named_question(diagnosis, set, varies ? std::vector<Rival>{} : adviser.rivals(set));
    if (q.empty()) return {advice_on(q, varies ? Advice::Kind::varies : Advice::Kind::unlike, {})};
    return adviser.answer(q, IfTold::say_so);
  } else if (diagnosis.verdict == Verdict::unexplained) {
    return {repeat(diagnosis, study.plan)};
  }
  for (Advice& a : adviser.answer(open, IfTold::say_nothing)) all.push_back(std::move(a));
  // Who names several terms wants them told apart: that no plan can do it is the answer.
  const bool several = options.asked->size() > 1;
  std::ranges::stable_sort(all, {}, [&](const Advice& a) {
    if (several && a.kind == Advice::Kind::twins) return 0;
    return a.plan.empty() ? 2 : 1;
  });
  return all;
}

}  // namespace drift::diagnosis
