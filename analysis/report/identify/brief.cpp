#include <algorithm>
#include <cmath>

#include "analysis/report/identify/sections.hpp"
#include "core/estimate/start_consistency.hpp"

namespace drift::report {
namespace {

constexpr double nothing_learned = 0.8;  // posterior over prior sigma
constexpr double mostly = 0.5;           // of its variance
constexpr double surely_wrong = 5.0;     // [sigma] off the truth: no right model is, in any of 100

/// What is believed of a filter: with process noise, which the batch fit does not model, the EKF.
const EstimateResult& judged(const FilterView& v) {
  const identification::FilterRun& run = *v.id.runs_of(v.summary.filter).front();
  return v.spec().noise.any() ? run.ekf : run.batch.estimate;
}

bool believed(const FilterView& v) {
  const EstimateResult& result = judged(v);
  return result.status == EstimateStatus::ok && !misfit(result);
}

std::string misfit_text(const FilterView& v) {
  const EstimateResult& result = judged(v);
  return result.status != EstimateStatus::ok
             ? "did not converge"
             : fmt::format("misfits (chi-square per degree of freedom {}, 1 expected)",
                           number_text(result.statistic_per_dof()));
}

/// The part of a parameter's variance that is the prior's, along combinations of which the data say
/// nothing: there the variance is one in units of the prior.
double share_of_sums(const FilterView& v, std::size_t state, const ParameterEstimate& p) {
  double variance = 0.0;
  for (const WeakDirection& d : v.summary.degeneracies)
    variance += std::pow(d.direction[static_cast<Eigen::Index>(state)], 2);
  return variance / std::pow(p.learning_ratio(), 2);
}

/// How many parameters are worth what, and which: "14 learned, 4 prior only (eta_y, ...)".
std::string count_text(const FilterView& v) {
  constexpr std::size_t most = 6;
  struct Kind {
    Worth worth;
    std::string_view words;
    std::vector<std::string> keys;
  } kinds[] = {{Worth::wrong, "wrong by more than 5 sigma", {}},
               {Worth::untrusted, "not to be trusted", {}},
               {Worth::start_dependent, "dependent on the start", {}},
               {Worth::prior_only, "prior only", {}},
               {Worth::sum_only, "known in sums with others alone", {}},
               {Worth::learned, "learned", {}}};
  ParameterVerdict worst;
  for (std::size_t k = 0; k < v.summary.layout.size(); ++k) {
    const ParameterVerdict p = verdict_of(v, k);
    for (Kind& kind : kinds)
      if (kind.worth == p.worth) kind.keys.push_back(parameter_key(p.param));
    if (p.worth == Worth::wrong && (worst.worth != Worth::wrong || p.off > worst.off)) worst = p;
  }
  std::vector<std::string> parts;
  for (const Kind& kind : kinds) {
    if (kind.keys.empty()) continue;
    std::string part = fmt::format("{} {}", kind.keys.size(), kind.words);
    if (kind.worth == Worth::wrong)
      part += fmt::format(" (worst {}: {:.0f})", parameter_key(worst.param), worst.off);
    else if (kind.worth != Worth::learned && kind.worth != Worth::untrusted)
      part += fmt::format(" ({})", listed_up_to(kind.keys, most));
    parts.push_back(std::move(part));
  }
  return fmt::format("Filter {}: of {} parameters {}.", v.spec().name, v.summary.layout.size(),
                     fmt::join(parts, "; "));
}

struct Judgement {
  std::vector<std::string> good, bad;  ///< names; what is wrong with them
  bool wrong = false;                  ///< a filter that fits has a parameter that is wrong
  bool unlearned = false;              ///< a filter that fits learned nothing of one
  bool first_fits = false;             ///< the first filter, which `diagnose` would examine
};

Judgement judgement_of(const mc::Study& study, const identification::Identification& id) {
  Judgement j;
  for (const identification::FilterSummary& s : id.summaries) {
    const FilterView v{study, id, s};
    if (!believed(v)) {
      j.bad.push_back(fmt::format("filter {} {}", v.spec().name, misfit_text(v)));
      continue;
    }
    j.good.push_back(v.spec().name);
    j.first_fits = j.first_fits || s.filter == 0;
    for (std::size_t k = 0; k < s.layout.size(); ++k) {
      const Worth worth = verdict_of(v, k).worth;
      j.wrong = j.wrong || worth == Worth::wrong;
      j.unlearned = j.unlearned || worth == Worth::prior_only || worth == Worth::sum_only;
    }
  }
  return j;
}

std::string verdict_text(const Judgement& j) {
  if (j.good.empty())
    return fmt::format("Misfit: {}. Their estimates are not to be trusted.", listed(j.bad, "and"));
  if (!j.bad.empty())
    return fmt::format("Believe {}: the residuals are what it expects; {}.", listed(j.good, "and"),
                       listed(j.bad, "and"));
  return fmt::format("Fits: the residuals are what {} {} expect{}.",
                     j.good.size() == 1 ? "filter" : "filters", listed(j.good, "and"),
                     j.good.size() == 1 ? "s" : "");
}

}  // namespace

ParameterVerdict verdict_of(const FilterView& v, std::size_t state) {
  const EstimateResult& result = judged(v);
  ParameterVerdict out;
  out.param = v.summary.layout.params[state];
  const ParameterEstimate* p = result.find(out.param);
  if (p == nullptr) {
    out.worth = Worth::untrusted;
    return out;
  }
  if (v.id.truth) out.off = std::abs(p->value - v.id.truth->theta[out.param]) / p->sigma;
  const double ratio = v.summary.spread[state].ekf;
  if (out.off > surely_wrong)
    out.worth = Worth::wrong;
  else if (!believed(v))
    out.worth = Worth::untrusted;
  else if (p->learning_ratio() > nothing_learned)
    out.worth = Worth::prior_only;
  else if (std::isfinite(ratio) && start_verdict(ratio) == StartVerdict::depends_on_start)
    out.worth = Worth::start_dependent;
  else if (share_of_sums(v, state, *p) > mostly)
    out.worth = Worth::sum_only;
  return out;
}

Cell verdict_cell(const ParameterVerdict& verdict) {
  switch (verdict.worth) {
    case Worth::wrong:
      return {fmt::format("wrong by {:.0f} sigma", verdict.off), Tone::bad};
    case Worth::untrusted:
      return {"not to be trusted (misfit)", Tone::bad};
    case Worth::start_dependent:
      return {"depends on start", Tone::bad};
    case Worth::prior_only:
      return {"prior only", Tone::doubtful};
    case Worth::sum_only:
      return {"in a sum alone", Tone::doubtful};
    case Worth::learned:
      break;
  }
  return {"learned", Tone::good};
}

InBrief identification_in_brief(const mc::Study& study, const identification::Identification& id) {
  const Judgement j = judgement_of(study, id);
  InBrief brief;
  brief.verdict = verdict_text(j);
  brief.tone = j.good.empty() ? Tone::bad : j.wrong ? Tone::doubtful : Tone::good;
  for (const identification::FilterSummary& s : id.summaries)
    brief.more.push_back(count_text({study, id, s}));
  const std::string file = study.path.empty() ? "STUDY" : study.path;
  if (!j.first_fits)
    brief.next = fmt::format(
        "Next: driftscope diagnose {} {} says what the first filter of the study lacks.", file,
        id.simulated ? "RECORDING" : fmt::format("{}", fmt::join(id.sources, " ")));
  else if (j.unlearned)
    brief.next = fmt::format(
        "Next: driftscope rank {} --improve 3 proposes positions that show what this test does "
        "not.",
        file);
  return brief;
}

}  // namespace drift::report
