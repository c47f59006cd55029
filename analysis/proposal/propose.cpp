#include "analysis/proposal/propose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/forms/screen.hpp"
#include "analysis/forms/term_text.hpp"
#include "analysis/inference/thresholds.hpp"
#include "core/config/load.hpp"
#include "core/physics/own/own_terms.hpp"
#include "core/physics/own/own_terms_config.hpp"
#include "mc/task/campaign.hpp"

namespace drift::proposal {
namespace {

using forms::Form;
using forms::Instants;
using forms::ScreenedForm;
using forms::Screening;

/// A form as a term of the library.
struct Offered {
  ScreenedForm screened;
  std::string key;
  double largest() const { return screened.amplitude.cwiseAbs().maxCoeff(); }
};

/// A name that no term of the study has.
std::string free_key(std::size_t number) {
  for (std::size_t n = number;; ++n) {
    std::string key = fmt::format("form_{}", n);
    const auto& terms = own_terms().terms;
    if (std::ranges::find(terms, key, &OwnTerm::key) == terms.end()) return key;
  }
}

std::vector<Offered> offered(const Screening& screening, double alpha) {
  std::vector<Offered> out;
  std::size_t number = 1;
  for (const ScreenedForm& form : screening.best) {
    if (form.log_p > std::log(alpha)) continue;
    std::string key = free_key(number);
    number = std::stoul(key.substr(key.find('_') + 1)) + 1;
    out.push_back({form, std::move(key)});
  }
  return out;
}

/// Adds terms to those of the study, as a study file that has them would.
void put_into_library(const std::vector<Offered>& forms, const Instants& at) {
  std::string text;
  for (const Offered& f : forms) text += term_text(f.screened.form, at, f.key, f.largest());
  const config::Node root = config::parse_document(text, "proposal");
  config::Report report("proposal");
  config::Section section(report, &root, config::Place{}, "");
  OwnTermSet set = read_own_terms(section, own_terms());
  report.throw_if_wrong();
  set_own_terms(std::move(set));
}

/// The candidate that is the whole of a term, at its best setting.
std::optional<search::Choice> whole_of(const search::Fitted& base, const std::string& key) {
  std::optional<search::Choice> out;
  std::size_t most = 0;
  for (std::size_t k = 0; k < base.set.candidates.size(); ++k) {
    const inference::Candidate& c = base.set.candidates[k];
    if (c.term != key || c.params.size() <= most || base.scores[k].dof == 0) continue;
    most = c.params.size();
    out = {k, base.scores[k].variant};
  }
  return out;
}

/// The nominal fit with the forms among its candidates, under a noise that is known.
search::Fitted with_forms(const search::Search& found, const inference::NoiseModel& noise,
                          const MeasuredTest& test) {
  inference::NoiseEstimate known = found.nominal.noise;
  known.model = noise;
  known.driven = noise.driven();
  return search::examine(found.nominal.filter, test, found.nominal.fit, known);
}

struct Judged {
  const Offered* form = nullptr;
  search::Refit refit;
  double weight = 0.0;  ///< log of prior and evidence
};

std::vector<Judged> refitted(const search::Fitted& base, const std::vector<Offered>& forms,
                             const MeasuredTest& test, const search::ChanceThresholds& thresholds) {
  const auto all = mc::run_campaign(forms.size(), [&](std::size_t k) -> std::optional<Judged> {
    const auto choice = whole_of(base, forms[k].key);
    if (!choice) return std::nullopt;
    Judged j{&forms[k],
             search::refit(base, test, {*choice}, thresholds, search::noise_beside(base),
                           search::Sizes::of_library),
             0.0};
    j.weight = j.refit.log_bayes + forms[k].screened.form.log_prior;
    return j;
  });
  std::vector<Judged> fitting;
  for (const auto& j : all)
    if (j && j->refit.tolerable()) fitting.push_back(*j);
  std::ranges::stable_sort(fitting, std::greater{}, &Judged::weight);
  return fitting;
}

std::vector<search::CauseParameter> parameters_of(const Judged& best, const std::string& key) {
  std::vector<search::CauseParameter> out;
  const TermInfo& term = TermLibrary::terms[*TermLibrary::find_term(best.form->key)];
  for (std::size_t i = term.first; i < term.first + term.count; ++i) {
    const ParamSpec& spec = TermLibrary::specs[i];
    const ParameterEstimate* p = best.refit.after.fit.estimate.find(i);
    search::CauseParameter one;
    one.key = key + std::string(spec.key.view().substr(best.form->key.size()));
    one.param = i;
    one.unit = std::string(spec.unit.symbol.view());
    one.value = (p ? p->value : spec.prior_si().mean()) / spec.unit.to_si;
    one.sigma = (p ? p->sigma : 0.0) / spec.unit.to_si;
    one.profiled = spec.setting();
    out.push_back(std::move(one));
  }
  return out;
}

/// A parameter of the library, and how much of its trace the form's amplitude cannot copy.
struct Likeness {
  std::optional<std::size_t> param;
  double unlike = 1.0;
  bool in_nominal = false;

  void meet(std::size_t other, double cosine, bool nominal) {
    if (const double u = 1.0 - cosine * cosine; u < unlike) *this = {other, u, nominal};
  }
};

/// The parameter of a known term whose trace is the likest. What the nominal model estimates has
/// no trace left beside it: there the whole one is compared.
Likeness likest(const search::Fitted& base, const search::Choice& form) {
  Likeness found;
  const std::vector<int> own = search::columns_of(base.set, {form});
  if (own.size() != 1) return found;  // a pair of amplitudes is no one parameter
  const auto is_own = [](std::size_t param) {
    return std::ranges::find(own_terms().terms, TermLibrary::owner(param).key, &OwnTerm::key) !=
           own_terms().terms.end();
  };
  for (std::size_t k = 0; k < base.set.candidates.size(); ++k) {
    const inference::Candidate& c = base.set.candidates[k];
    if (c.params.size() != 1 || is_own(c.params.front()) || base.scores[k].dof == 0) continue;
    for (const inference::Variant& v : c.variants)
      found.meet(c.params.front(), search::cosine(base.projected, own, v.columns), false);
  }
  const VecX column = base.projector->extra().col(own.front());
  const std::vector<std::size_t> params = make_layout(base.filter).params;
  for (std::size_t k = 0; k < params.size(); ++k) {
    const VecX other = base.projector->theta().col(static_cast<Eigen::Index>(k));
    if (!is_own(params[k]) && other.norm() > 0.0)
      found.meet(params[k], column.dot(other) / (column.norm() * other.norm()), true);
  }
  return found;
}

/// The form with the setting that the full dynamics found.
Form settled(const Judged& best) {
  Form form = best.form->screened.form;
  double* setting = moved_setting(form);
  if (setting == nullptr) return form;
  const TermInfo& term = TermLibrary::terms[*TermLibrary::find_term(best.form->key)];
  for (std::size_t i = term.first; i < term.first + term.count; ++i)
    if (const ParameterEstimate* p = best.refit.after.fit.estimate.find(i);
        p && TermLibrary::specs[i].setting()) {
      *setting = p->value;
      *sigma_of_moved(form) = p->sigma;
    }
  return form;
}

}  // namespace

std::optional<diagnosis::Proposal> propose(const search::Search& found,
                                           const inference::NoiseModel& noise,
                                           const MeasuredTest& test, double alpha,
                                           const diagnosis::FoldOptions& folds) {
  const std::size_t places = most_own_terms - own_terms().terms.size();
  const inference::Projector projector(found.nominal.problem.bare(), noise);
  const Screening screening =
      forms::screen_forms(found.nominal.problem, test.timeline, projector, places);
  const std::vector<Offered> forms = offered(screening, alpha);
  if (forms.empty()) return std::nullopt;

  const Instants at = forms::instants_of(test.timeline);
  const std::string key = forms.front().key;  // free, whichever is proposed
  const KeptOwnTerms kept;
  put_into_library(forms, at);
  const search::Fitted base = with_forms(found, noise, test);
  const std::vector<Judged> fitting = refitted(base, forms, test, found.thresholds);
  if (fitting.empty()) return std::nullopt;
  const Judged& best = fitting.front();
  const diagnosis::HeldOut held =
      diagnosis::held_out(base, best.refit.after, test, {best.refit.choices.front().candidate},
                          found.thresholds.library_threshold, folds);
  if (held.folds.empty() || !held.improves) return std::nullopt;

  diagnosis::Proposal out;
  const Form form = settled(best);
  out.acts_on = std::string(name_in(own_targets, form.place));
  out.equation = equation_of(form, at);
  out.text = term_text(form, at, key, best.form->largest());
  if (const Likeness like = likest(base, best.refit.choices.front());
      like.param && inference::same_trace_of_unlike(like.unlike)) {
    out.known = std::string(TermLibrary::specs[*like.param].key.view());
    out.in_nominal = like.in_nominal;
  }
  out.parameters = parameters_of(best, key);
  out.forms = screening.forms;
  out.p_value = std::exp(best.form->screened.log_p);
  out.positions = held.folds.size();
  out.held_out_gain = held.log_score_gain;
  out.chi2_per_dof_before = held.chi2_per_dof_before;
  out.chi2_per_dof_after = held.chi2_per_dof_after;
  return out;
}

}  // namespace drift::proposal
