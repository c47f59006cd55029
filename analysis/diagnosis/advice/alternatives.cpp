#include "analysis/diagnosis/advice/alternatives.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/inference/thresholds.hpp"
#include "core/base/check.hpp"
#include "core/config/nearest.hpp"
#include "core/estimate/layout.hpp"

namespace drift::diagnosis {
namespace {

Alternative alternative(std::vector<search::Cause> causes, std::string asked = {}) {
  return {Alternative::Kind::causes, search::as_weighed(std::move(causes)), {}, std::move(asked)};
}

Alternative equation(Coupling coupling, std::vector<search::Cause> causes) {
  return {Alternative::Kind::equation, std::move(causes), coupling, {}};
}

/// A cause that nobody has measured: each linear parameter one prior sigma from where it is
/// nominally.
search::Cause cause_of(const inference::Candidate& c, const inference::Variant& variant,
                       const FilterSpec& nominal) {
  search::Cause cause;
  cause.term = c.term;
  cause.axis = c.axis;
  const auto add = [&](std::size_t i, double si, bool profiled) {
    const ParamSpec& spec = TermLibrary::specs[i];
    cause.parameters.push_back({std::string(spec.key.view()), i, si / spec.unit.to_si, 0.0,
                                std::string(spec.unit.symbol.view()), profiled});
  };
  for (const std::size_t i : c.params)
    add(i,
        i == closure_param
            ? 1.0 - value_left_out(i, nominal.coupling)
            : TermLibrary::specs[i].prior_si().mean() + TermLibrary::specs[i].prior_si().sigma(),
        false);
  for (const auto& [i, si] : variant.settings) add(i, si, true);
  return cause;
}

/// Time constants and the like of an effect that nobody has seen: from the middle of what is tried.
const inference::Variant& usual(const inference::Candidate& c) {
  return c.variants[c.variants.size() / 2];
}

/// Adds the two equations where the test is blind to lambda.
void add_equations(const Diagnosis& d, Question& q) {
  const CouplingFacts& nominal = facts(d.nominal.coupling);
  if (d.verdict != Verdict::consistent || !nominal.other) return;
  if (!(d.other_equation_gain > -inference::RemarkLimits::equation)) return;  // told, or not asked
  search::Cause cause;
  cause.term = closure_term;
  cause.parameters = {{"lambda", closure_param, *facts(*nominal.other).lambda, 0.0, "1", false}};
  q.pairs.push_back({q.alternatives.size(), q.alternatives.size() + 1});
  q.alternatives.push_back(equation(*nominal.other, {cause}));
  q.alternatives.push_back(equation(nominal.value, {}));
}

/// A term, an axis of it, or a parameter, as a user writes it.
struct Wish {
  std::string text;
  std::vector<const inference::Candidate*> single;  ///< its parameters, one by one
};

/// What a term follows that no plan of positions can set: the temperature, a column of the
/// recording.
CovariateSet followed(const TermInfo& term) {
  return term.needs.covariates & varying_covariates;
}
CovariateSet followed(const std::string& term) {
  return followed(TermLibrary::terms[*TermLibrary::find_term(term)]);
}

bool meant(const inference::Candidate& c, const std::string& text) {
  return c.term == text || c.term + "." + c.axis == text ||
         TermLibrary::specs[c.params.front()].key.view() == text;
}

/// Why a wish cannot be granted.
std::string refusal(const std::string& text) {
  std::vector<std::string_view> known;
  for (const TermInfo& t : TermLibrary::terms) known.push_back(t.key);
  const std::string term = text.substr(0, text.find('.'));
  const auto param = TermLibrary::find(text);
  const auto number =
      param ? TermLibrary::find_term(TermLibrary::owner(*param).key) : TermLibrary::find_term(term);
  if (!number)
    return fmt::format(
        "advise: no term or parameter '{}' (expected a term such as magnetic_drift, an axis of it "
        "such as "
        "magnetic_drift.y, or a parameter such as M_y). {}",
        text, config::suggestion(term, known, "`driftscope terms` lists all"));
  const TermInfo& t = TermLibrary::terms[*number];
  for (const CovariateSpec& c : known_covariates)
    if ((followed(t) & c.set()) != 0)
      return fmt::format(
          "advise: {} follows the {}, and positions are planned at one {} (expected a term that "
          "attitude, command or time shows). Let the {} vary within the dwells and record it",
          text, c.what, c.what, c.what);
  if (followed(t) != 0)
    return fmt::format(
        "advise: {} follows a column of the recording that no plan can foretell (expected a term "
        "that attitude, command or time shows). Let that column vary within the dwells",
        text);
  return fmt::format(
      "advise: nothing of {} can be asked for (expected a term that the nominal filter leaves out "
      "and that has an "
      "amplitude). `driftscope terms {}` explains it",
      text, t.key);
}

/// The candidates that each term asked for is made of. InputError (usage) where there are none.
std::vector<Wish> wishes_of(const inference::CandidateSet& set,
                            const std::vector<std::string>& terms) {
  std::vector<Wish> wishes;
  std::vector<std::string> wrong;
  for (const std::string& text : terms) {
    Wish wish{text, {}};
    for (const inference::Candidate& c : set.candidates)
      if (c.params.size() == 1 && meant(c, text) && followed(c.term) == 0)
        wish.single.push_back(&c);
    if (wish.single.empty()) wrong.push_back(refusal(text));
    wishes.push_back(std::move(wish));
  }
  if (!wrong.empty()) throw InputError(ExitCode::usage, std::move(wrong));
  return wishes;
}

Question all_against_all(std::vector<Alternative> all) {
  Question q;
  for (std::size_t c = 0; c < all.size(); ++c)
    for (std::size_t other = 0; other < all.size(); ++other)
      if (c != other && !all[c].causes.empty()) q.pairs.push_back({c, other});
  q.alternatives = std::move(all);
  return q;
}

}  // namespace

Question open_question(const Diagnosis& d) {
  Question q;
  if (d.verdict != Verdict::ambiguous) {
    add_equations(d, q);
    return q;
  }
  std::vector<std::vector<search::Cause>> sets;
  for (const search::Cause& c : d.causes) {
    const auto k = static_cast<std::size_t>(c.set);
    if (k >= sets.size()) sets.resize(k + 1);
    sets[k].push_back(c);
  }
  std::vector<Alternative> all;
  for (auto& set : sets)
    if (!set.empty() && !follows_what_varies(set)) all.push_back(alternative(std::move(set)));
  if (all.empty()) return q;
  if (all.size() == 1) all.emplace_back();
  return all_against_all(std::move(all));
}

Question hidden_question(const Diagnosis& d, const inference::CandidateSet& set) {
  Question q;
  q.sizes = Sizes::one_prior_sigma;
  q.alternatives.emplace_back();
  for (const inference::Candidate& c : set.candidates) {
    if (c.params.size() != 1 || c.params.front() == closure_param || followed(c.term) != 0)
      continue;
    q.pairs.push_back({q.alternatives.size(), 0});
    q.alternatives.push_back(alternative({cause_of(c, usual(c), d.nominal)}));
  }
  add_equations(d, q);
  return q;
}

Question named_question(const Diagnosis& d, const inference::CandidateSet& set,
                        const std::vector<Rival>& rivals) {
  Question q;
  q.alternatives.push_back(alternative(d.causes));
  for (const Rival& r : rivals) {
    std::vector<search::Cause> causes = d.causes;
    const inference::Candidate& c = set.candidates[r.candidate];
    if (followed(c.term) != 0) continue;
    causes[r.cause] = cause_of(c, c.variants[r.variant], d.nominal);
    q.pairs.push_back({0, q.alternatives.size()});
    q.alternatives.push_back(alternative(std::move(causes)));
  }
  return q;
}

Question asked_question(const Diagnosis& d, const inference::CandidateSet& set,
                        const std::vector<std::string>& terms) {
  const std::vector<Wish> wishes = wishes_of(set, terms);
  Question q{{}, {}, Sizes::as_found, terms};
  std::size_t found = 0;
  q.alternatives.emplace_back();
  std::vector<std::size_t> whole;  // the alternative that is a wish as a whole
  for (const Wish& wish : wishes) {
    search::Cause cause;
    for (const inference::Candidate* c : wish.single) {
      const search::Cause one = cause_of(*c, usual(*c), d.nominal);
      cause.term = one.term;
      for (const search::CauseParameter& p : one.parameters)
        if (std::ranges::find(cause.parameters, p.param, &search::CauseParameter::param) ==
            cause.parameters.end())
          cause.parameters.push_back(p);
    }
    whole.push_back(q.alternatives.size());
    q.alternatives.push_back(alternative({cause}, wish.text));
  }
  for (std::size_t k = 0; k < wishes.size(); ++k)
    for (const inference::Candidate* c : wishes[k].single) {
      search::Cause one = cause_of(*c, usual(*c), d.nominal);
      for (const search::Cause& named : d.causes)
        for (const search::CauseParameter& p : named.parameters)
          if (named.term == one.term && p.param == c->params.front()) {
            one.parameters.front().value = p.value;
            for (search::CauseParameter& own : one.parameters)
              for (const search::CauseParameter& at : named.parameters)
                if (own.profiled && own.param == at.param) own.value = at.value;
            ++found;
          }
      const std::size_t truth = q.alternatives.size();
      q.alternatives.push_back(alternative({one}));
      q.pairs.push_back({truth, 0});
      for (std::size_t other = 0; other < wishes.size(); ++other)
        if (other != k && std::ranges::find(wishes[other].single, c) == wishes[other].single.end())
          q.pairs.push_back({truth, whole[other]});
    }
  q.sizes = found == 0 ? Sizes::one_prior_sigma : Sizes::as_found_or_one_prior_sigma;
  return q;
}

void require_askable(const FilterSpec& nominal, const std::vector<std::string>& terms) {
  Timeline any;  // a field is assumed where none is known
  any.carried = every_known_covariate;
  wishes_of(inference::library_candidates(nominal, make_layout(nominal).theta, any), terms);
}

Columns columns_of(const std::vector<Alternative>& all, const FilterSpec& nominal,
                   const Theta& theta) {
  Columns out;
  for (const Alternative& a : all) {
    std::vector<double> amplitude;
    planning::Trace trace;
    for (const search::Cause& cause : a.causes) {
      Theta at = theta;
      for (const search::CauseParameter& p : cause.parameters)
        if (p.profiled) at[p.param] = p.value * TermLibrary::specs[p.param].unit.to_si;
      for (const search::CauseParameter& p : cause.parameters) {
        if (p.profiled) continue;
        const ParamSpec& spec = TermLibrary::specs[p.param];
        const double sigma = spec.prior_si().sigma();
        amplitude.push_back(
            (p.value * spec.unit.to_si - value_left_out(p.param, nominal.coupling)) / sigma);
        auto& specs = out.signatures;
        const auto same = std::ranges::find_if(specs, [&](const inference::SignatureSpec& s) {
          return s.param == p.param && s.theta == at;
        });
        trace.columns.push_back(static_cast<int>(same - specs.begin()));
        if (same == specs.end()) specs.push_back({p.param, at, sigma});
      }
    }
    trace.amplitude =
        Eigen::Map<const VecX>(amplitude.data(), static_cast<Eigen::Index>(amplitude.size()));
    out.traces.push_back(std::move(trace));
  }
  return out;
}

Question restricted(const Question& q, const std::vector<planning::Contest>& pairs) {
  Question out{{}, pairs, q.sizes, q.names};
  std::vector<std::size_t> place(q.alternatives.size(), q.alternatives.size());
  const auto keep = [&](std::size_t& k) {
    if (place[k] == q.alternatives.size()) {
      place[k] = out.alternatives.size();
      out.alternatives.push_back(q.alternatives[k]);
    }
    k = place[k];
  };
  for (planning::Contest& pair : out.pairs) {
    keep(pair.truth);
    keep(pair.rival);
  }
  return out;
}

bool holds_lambda(const Alternative& a) {
  return std::ranges::any_of(a.causes,
                             [](const search::Cause& c) { return c.term == closure_term; });
}

bool follows_what_varies(const std::vector<search::Cause>& causes) {
  return std::ranges::any_of(causes, [](const search::Cause& c) { return followed(c.term) != 0; });
}

}  // namespace drift::diagnosis
