#include "analysis/blind/score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "analysis/inference/thresholds.hpp"
#include "core/physics/term_library.hpp"

namespace drift::blind {
namespace {

using diagnosis::Verdict;
using Alternative = std::vector<const AnswerCause*>;

/// The same term, and the same axis where both name one.
bool same(const std::string& term, const std::string& axis, const std::string& other_term,
          const std::string& other_axis) {
  return term == other_term && (axis.empty() || other_axis.empty() || axis == other_axis);
}

bool agrees(const HiddenEffect& hidden, const AnswerCause& cause) {
  return same(hidden.term, hidden.axis, cause.term, cause.axis);
}

bool holds(const Alternative& alternative, const HiddenEffect& hidden) {
  return std::any_of(alternative.begin(), alternative.end(),
                     [&](const AnswerCause* c) { return agrees(hidden, *c); });
}
bool holds_all(const Alternative& alternative, const std::vector<HiddenEffect>& effects) {
  return std::all_of(effects.begin(), effects.end(),
                     [&](const HiddenEffect& e) { return holds(alternative, e); });
}

/// Whether a cause is the hidden effect or leaves the same trace on the plan, as the answer says of
/// either.
bool is_twin(const Answer& answer, const HiddenEffect& hidden, const AnswerCause& cause) {
  if (agrees(hidden, cause)) return true;
  const auto lists = [](const AnswerCause& c, const std::string& term, const std::string& axis) {
    return std::any_of(c.confusable_with.begin(), c.confusable_with.end(),
                       [&](const search::Confusable& o) {
                         // A candidate of all axes can be like anything of one of them: that is no
                         // twin.
                         return inference::same_trace(o.cosine) && o.term == term && o.axis == axis;
                       });
  };
  return lists(cause, hidden.term, hidden.axis) ||
         std::any_of(answer.causes.begin(), answer.causes.end(), [&](const AnswerCause& c) {
           return agrees(hidden, c) && lists(c, cause.term, cause.axis);
         });
}

/// Whether each cause is a hidden effect or its twin, and each hidden effect has one.
bool is_twin(const Answer& answer, const std::vector<HiddenEffect>& effects,
             const Alternative& causes) {
  const auto twins = [&](const HiddenEffect& e, const AnswerCause* c) {
    return is_twin(answer, e, *c);
  };
  return std::all_of(effects.begin(), effects.end(),
                     [&](const HiddenEffect& e) {
                       return std::any_of(causes.begin(), causes.end(),
                                          [&](const AnswerCause* c) { return twins(e, c); });
                     }) &&
         std::all_of(causes.begin(), causes.end(), [&](const AnswerCause* c) {
           return std::any_of(effects.begin(), effects.end(),
                              [&](const HiddenEffect& e) { return twins(e, c); });
         });
}

bool is_drift_noise(const KeyEntry& key) {
  return key.effects.front().term == "drift_random_walk" ||
         key.effects.front().term == "markov_drift" || key.effects.front().term == "caging_drift";
}

/// Numbers of the hidden effects against those of the causes that name them, in the unit of the
/// key; only amplitudes: a profiled number has no sigma to be trusted.
std::vector<Pull> pulls_of(const KeyEntry& key, const Alternative& alternative) {
  std::vector<Pull> pulls;
  for (const HiddenEffect& e : key.effects)
    for (const AnswerCause* c : alternative) {
      if (!agrees(e, *c)) continue;
      for (const HiddenParameter& p : e.parameters)
        for (const auto& q : c->parameters) {
          const auto from = parse_unit(q.unit), to = parse_unit(p.unit);
          if (q.key != p.key || q.profiled || !(q.sigma > 0.0) || !from || !to) continue;
          const double factor = from->to_si / to->to_si;
          pulls.push_back({p.key, p.value, q.value * factor, q.sigma * factor});
        }
    }
  return pulls;
}

/// The part of the platform that a term belongs to; none for what is not in the library.
std::optional<Subsystem> subsystem_of(std::string_view term) {
  const auto known = TermLibrary::find_term(term);
  return known ? std::optional(TermLibrary::terms[*known].subsystem) : std::nullopt;
}

double overlap(double a0, double a1, double b0, double b1) {
  const double inner = std::min(a1, b1) - std::max(a0, b0),
               outer = std::max(a1, b1) - std::min(a0, b0);
  return inner > 0.0 && outer > 0.0 ? inner / outer : 0.0;
}

std::string called(const Answer& a) {
  if (a.failed) return "failed";
  if (a.verdict == Verdict::consistent || a.verdict == Verdict::unexplained || a.causes.empty())
    return std::string(diagnosis::text(a.verdict));
  if (a.verdict == Verdict::ambiguous) return "ambiguous";
  const std::string& term = a.causes.front().term;
  const bool one = std::all_of(a.causes.begin(), a.causes.end(),
                               [&](const AnswerCause& c) { return c.term == term; });
  return one ? term : "several";
}

}  // namespace

std::string TrialScore::hidden() const {
  const bool term = key.plan.stratum == Stratum::single && !key.effects.empty();
  return term ? key.effects.front().term : std::string(key_of(key.plan.stratum));
}

TrialScore score_trial(const KeyEntry& key, const Answer& answer) {
  constexpr std::size_t most_alternatives = 3;
  TrialScore s;
  s.key = key;
  s.answer = answer;
  s.called = called(answer);
  if (answer.failed) return s;
  s.believed_right = is_right(answer.belief, key);
  const bool effect = key.plan.stratum != Stratum::null && key.plan.stratum != Stratum::wrong_noise;
  s.detected = answer.verdict != Verdict::consistent;
  s.unexplained = answer.verdict == Verdict::unexplained;
  const auto alternatives = answer.alternatives();
  const bool names = answer.verdict == Verdict::named && !alternatives.empty();
  const bool offers = (names || answer.verdict == Verdict::ambiguous) && !alternatives.empty();
  if (!effect) {
    const bool walk =
        key.plan.stratum == Stratum::wrong_noise && is_drift_noise(key) && names &&
        std::all_of(answer.causes.begin(), answer.causes.end(),
                    [](const AnswerCause& c) { return c.term == "drift_random_walk"; });
    s.false_alarm = s.detected && !walk;
    s.confidently_wrong = names && !walk;
    return s;
  }
  for (const Alternative& a : alternatives) {
    if (!holds_all(a, key.effects)) continue;
    s.offered = s.offered || offers;
    s.in_set = s.offered && alternatives.size() <= most_alternatives;
    if (!names || alternatives.size() != 1) continue;
    s.exact = std::all_of(a.begin(), a.end(), [&](const AnswerCause* c) {
      return std::any_of(key.effects.begin(), key.effects.end(),
                         [&](const HiddenEffect& e) { return agrees(e, *c); });
    });
    s.extra = !s.exact;
    if (s.exact) s.pulls = pulls_of(key, a);
  }
  const bool all_twins =
      !alternatives.empty() &&
      std::all_of(alternatives.begin(), alternatives.end(),
                  [&](const Alternative& a) { return is_twin(answer, key.effects, a); });
  s.exact_or_twin = s.exact || (answer.verdict == Verdict::ambiguous && all_twins);
  const auto right = [&](const AnswerCause& c) {
    return std::any_of(key.effects.begin(), key.effects.end(),
                       [&](const HiddenEffect& e) { return agrees(e, c); });
  };
  s.confidently_wrong = names && std::none_of(answer.causes.begin(), answer.causes.end(), right);
  s.subsystem =
      offers && std::any_of(key.effects.begin(), key.effects.end(), [&](const HiddenEffect& e) {
        return subsystem_of(e.term) == subsystem_of(answer.causes.front().term);
      });
  if (key.plan.stratum == Stratum::local) {
    const HiddenEffect& e = key.effects.front();
    s.position_right = s.detected && answer.position == e.position;
    s.equation_right = s.detected && answer.equation == e.equation;
    if (s.position_right) s.overlap = overlap(e.start_s, e.end_s, answer.start_s, answer.end_s);
  }
  return s;
}

std::vector<TrialScore> score_trials(const std::vector<KeyEntry>& keys,
                                     const std::vector<Answer>& answers) {
  std::map<std::size_t, const Answer*> by_number;
  for (const Answer& a : answers) by_number[a.number] = &a;
  std::vector<TrialScore> scores;
  for (const KeyEntry& k : keys) {
    const auto found = by_number.find(k.plan.number);
    Answer none;
    none.number = k.plan.number;
    none.failed = true;
    none.failure = "not answered";
    scores.push_back(score_trial(k, found == by_number.end() ? none : *found->second));
  }
  return scores;
}

}  // namespace drift::blind
