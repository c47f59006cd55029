#include "analysis/diagnosis/alternatives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/config/nearest.hpp"

namespace drift::diagnosis {
namespace {

constexpr auto lambda = TermLibrary::index("lambda");

double base_of(std::size_t param, const FilterSpec& nominal) {
  return param == lambda && nominal.coupling == Coupling::eq6 ? 1.0 : 0.0;
}

/// "magnetic_drift.y", "g2_drift (D_IS_x)": one parameter tells more than its term.
std::string label_of(const search::Cause& c) {
  const auto linear = std::ranges::count_if(
      c.parameters, [](const search::CauseParameter& p) { return !p.profiled; });
  const std::string own =
      linear == 1 && !c.parameters.empty() && !c.parameters[0].key.starts_with(c.term)
          ? fmt::format(" ({})", c.parameters[0].key)
          : "";
  return fmt::format("{}{}{}{}", c.term, c.axis.empty() ? "" : ".", c.axis, own);
}

Alternative alternative(std::vector<search::Cause> causes) {
  Alternative a;
  for (const search::Cause& c : causes) a.label += (a.label.empty() ? "" : " + ") + label_of(c);
  a.causes = std::move(causes);
  return a;
}

Alternative nothing() {
  return {"the nominal model", {}, {}, VecX()};
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
        i == lambda
            ? 1.0 - base_of(i, nominal)
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
  const bool six = d.nominal.coupling == Coupling::eq6;
  if (d.verdict != Verdict::consistent || (d.nominal.coupling != Coupling::eq5 && !six)) return;
  if (!(d.other_equation_gain > -equation_told)) return;  // told, or not asked
  search::Cause cause;
  cause.term = "frame_closure";
  cause.parameters = {{"lambda", lambda, six ? 0.0 : 1.0, 0.0, "1", false}};
  q.pairs.push_back({q.alternatives.size(), q.alternatives.size() + 1});
  q.alternatives.push_back({six ? "eq. (5)" : "eq. (6)", {cause}, {}, {}});
  q.alternatives.push_back({six ? "eq. (6)" : "eq. (5)", {}, {}, VecX()});
}

/// A term, an axis of it, or a parameter, as a user writes it.
struct Wish {
  std::string text;
  std::vector<const inference::Candidate*> single;  ///< its parameters, one by one
};

/// Positions are planned at one temperature: what follows it stays unseen in any of them.
bool needs_temperature(const std::string& term) {
  return TermLibrary::terms[*TermLibrary::find_term(term)].needs.temperature;
}

bool follows_temperature(const std::vector<search::Cause>& causes) {
  return std::ranges::any_of(causes,
                             [](const search::Cause& c) { return needs_temperature(c.term); });
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
  if (t.needs.temperature)
    return fmt::format(
        "advise: {} follows the temperature, and positions are planned at one temperature "
        "(expected a term that "
        "attitude, command or time shows). Let the temperature vary within the dwells and record "
        "it",
        text);
  if (t.needs.field)
    return fmt::format(
        "advise: {} needs the magnetic field, and neither the recording nor [environment] gives it "
        "(expected columns "
        "field_n, field_w, field_u). Record it: no position helps before",
        text);
  return fmt::format(
      "advise: nothing of {} can be asked for (expected a term that the nominal filter leaves out "
      "and that has an "
      "amplitude). `driftscope terms {}` explains it",
      text, t.key);
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
    if (!set.empty() && !follows_temperature(set)) all.push_back(alternative(std::move(set)));
  if (all.empty()) return q;
  if (all.size() == 1) all.push_back(nothing());
  return all_against_all(std::move(all));
}

Question hidden_question(const Diagnosis& d, const inference::CandidateSet& set) {
  Question q;
  q.size = "at one prior sigma";
  q.alternatives.push_back(nothing());
  for (const inference::Candidate& c : set.candidates) {
    if (c.params.size() != 1 || c.params.front() == lambda || needs_temperature(c.term)) continue;
    q.pairs.push_back({q.alternatives.size(), 0});
    q.alternatives.push_back(alternative({cause_of(c, usual(c), d.nominal)}));
  }
  add_equations(d, q);
  return q;
}

Question named_question(const Diagnosis& d, const inference::CandidateSet& set,
                        const std::vector<Rival>& rivals) {
  Question q;
  if (follows_temperature(d.causes)) return q;
  q.alternatives.push_back(alternative(d.causes));
  for (const Rival& r : rivals) {
    std::vector<search::Cause> causes = d.causes;
    const inference::Candidate& c = set.candidates[r.candidate];
    if (needs_temperature(c.term)) continue;
    causes[r.cause] = cause_of(c, c.variants[r.variant], d.nominal);
    q.pairs.push_back({0, q.alternatives.size()});
    q.alternatives.push_back(alternative(std::move(causes)));
  }
  return q;
}

Question asked_question(const Diagnosis& d, const inference::CandidateSet& set,
                        const std::vector<std::string>& terms) {
  std::vector<Wish> wishes;
  std::vector<std::string> wrong;
  for (const std::string& text : terms) {
    Wish wish{text, {}};
    for (const inference::Candidate& c : set.candidates)
      if (c.params.size() == 1 && meant(c, text) && !needs_temperature(c.term))
        wish.single.push_back(&c);
    if (wish.single.empty()) wrong.push_back(refusal(text));
    wishes.push_back(std::move(wish));
  }
  if (!wrong.empty()) throw InputError(ExitCode::usage, std::move(wrong));

  Question q;
  std::size_t found = 0;
  q.alternatives.push_back(nothing());
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
    q.alternatives.push_back(alternative({cause}));
    q.alternatives.back().label = wish.text;
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
  q.size = found == 0 ? "at one prior sigma" : "at the sizes found, others at one prior sigma";
  return q;
}

std::vector<inference::SignatureSpec> number_signatures(std::vector<Alternative>& all,
                                                        const FilterSpec& nominal,
                                                        const Theta& theta) {
  std::vector<inference::SignatureSpec> specs;
  for (Alternative& a : all) {
    std::vector<double> amplitude;
    for (const search::Cause& cause : a.causes) {
      Theta at = theta;
      for (const search::CauseParameter& p : cause.parameters)
        if (p.profiled) at[p.param] = p.value * TermLibrary::specs[p.param].unit.to_si;
      for (const search::CauseParameter& p : cause.parameters) {
        if (p.profiled) continue;
        const ParamSpec& spec = TermLibrary::specs[p.param];
        const double sigma = spec.prior_si().sigma();
        amplitude.push_back((p.value * spec.unit.to_si - base_of(p.param, nominal)) / sigma);
        const auto same = std::ranges::find_if(specs, [&](const inference::SignatureSpec& s) {
          return s.param == p.param && s.theta == at;
        });
        a.columns.push_back(static_cast<int>(same - specs.begin()));
        if (same == specs.end()) specs.push_back({p.param, at, sigma});
      }
    }
    a.amplitude =
        Eigen::Map<const VecX>(amplitude.data(), static_cast<Eigen::Index>(amplitude.size()));
  }
  return specs;
}

void prune(Question& q) {
  std::vector<Alternative> kept;
  std::vector<std::size_t> place(q.alternatives.size(), q.alternatives.size());
  const auto keep = [&](std::size_t& k) {
    if (place[k] == q.alternatives.size()) {
      place[k] = kept.size();
      kept.push_back(q.alternatives[k]);
      kept.back().columns.clear();
    }
    k = place[k];
  };
  for (Contest& pair : q.pairs) {
    keep(pair.truth);
    keep(pair.rival);
  }
  q.alternatives = std::move(kept);
}

bool holds_lambda(const Alternative& a) {
  return std::ranges::any_of(a.causes,
                             [](const search::Cause& c) { return c.term == "frame_closure"; });
}

}  // namespace drift::diagnosis
