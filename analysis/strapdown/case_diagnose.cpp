#include "analysis/strapdown/case_diagnose.hpp"

#include "analysis/diagnosis/advice/patched_study.hpp"
#include "analysis/diagnosis/diagnose_recordings.hpp"
#include "analysis/diagnosis/doubts/site_doubt.hpp"
#include "analysis/strapdown/case_times.hpp"
#include "analysis/strapdown/consumer_grade.hpp"
#include "analysis/strapdown/sensed_diagnosis.hpp"
#include "core/base/check.hpp"
#include "mc/study/own_terms_check.hpp"

namespace drift::strapdown {
namespace {

using diagnosis::Diagnosis;

/// "gyro_x" for "gimbal_outer": what stands in the place of the gimbals.
std::string channel_of_case(const std::string& name) {
  constexpr std::pair<std::string_view, std::string_view> names[] = {
      {"gimbal_outer", "gyro_x"}, {"gimbal_middle", "gyro_y"}, {"gimbal_inner", "gyro_z"}};
  for (const auto& [platform, on_case] : names)
    if (name == platform) return std::string(on_case);
  return name;
}

/// "gyro y" for "platform rate y".
std::string equation_of_case(const std::string& equation) {
  constexpr std::string_view rate = "platform rate ";
  return equation.starts_with(rate) ? "gyro " + equation.substr(rate.size()) : equation;
}

void rename(Diagnosis& d) {
  for (std::string& name : d.where.channel_names) name = channel_of_case(name);
  for (auto& share : d.where.channels) share.name = channel_of_case(share.name);
  for (auto& hit : d.where.windows) hit.equation = equation_of_case(hit.equation);
  d.where.equation = equation_of_case(d.where.equation);
  for (std::string& equation : d.where.equations) equation = equation_of_case(equation);
  for (auto& signal : d.signals) signal.equation = equation_of_case(signal.equation);
  for (auto& noise : d.noise)
    if (noise.component == "gimbal_white") noise.component = "gyro_white";
  for (auto& remark : d.remarks) {
    if (auto* free = std::get_if<diagnosis::remark::FreeInputExplains>(&remark))
      free->equation = equation_of_case(free->equation);
    if (auto* period = std::get_if<diagnosis::remark::PeriodExplains>(&remark))
      period->equation = equation_of_case(period->equation);
  }
}

/// What held-out dwells and turns are missed by, without and with the causes.
std::vector<diagnosis::ErrorOfKind> errors_of(const Diagnosis& d, const CaseIdentification& id) {
  const CaseScores& before = id.fits.front();
  if (before.gravity.count == 0) return {};
  CaseScores after = before;
  if (d.has_patch) {
    const BatchResult fit =
        fit_batch(d.patched, id.study.measured(), theta_of(d.patched, id.fits.front().fit));
    after = scores_of(d.patched, fit, id.study, id.division, id.seed);
  }
  std::vector<diagnosis::ErrorOfKind> all;
  if (before.gyro.count > 0)
    all.push_back({"gyro rate in dwells", "deg/h", before.gyro.held_out, after.gyro.held_out});
  if (before.up.count > 0)
    all.push_back({"up after a turn", "deg", before.up.held_out, after.up.held_out});
  all.push_back({"gravity in dwells", "ug", before.gravity.held_out / unit::ug.to_si,
                 after.gravity.held_out / unit::ug.to_si});
  return all;
}

void remark(Diagnosis& d, const CaseIdentification& id) {
  for (const std::string& text : id.study.remarks)
    d.remarks.emplace_back(diagnosis::remark::Input{text});
  if (!id.study.saturated.empty())
    d.remarks.insert(d.remarks.begin(), diagnosis::remark::SaturatedGyro{id.study.saturated});
  d.remarks.emplace_back(diagnosis::remark::NoDeclaredNoise{});
  for (const Unobservable& u : id.fits.front().unobservable)
    d.remarks.emplace_back(diagnosis::remark::NotObservable{u.what, u.reason});
}

/// The room that what was found has in the priors of the nominal model, for the patched study.
void take_room(Diagnosis& d, const FilterSpec& as_fitted) {
  const auto* beyond = diagnosis::remark_in<diagnosis::remark::BeyondPrior>(d);
  if (beyond == nullptr || !beyond->taken) return;
  for (const auto& p : beyond->parameters)
    d.patched.priors[p.estimate.param] = as_fitted.priors[p.estimate.param];
}

/// Another latitude against what was found; where causes leave nothing and it does not, it is none.
void take_latitude(Diagnosis& d, const CaseIdentification& id) {
  if (!id.latitude) return;
  identification::LatitudeDoubt doubt = *id.latitude;
  // Where the gyros do not see the Earth as the study has it, the model of the test is another.
  if (id.study.compass.sees_earth) {
    doubt = diagnosis::against_causes(doubt, d);
    if (!doubt.alone() && d.verdict != diagnosis::Verdict::unexplained) return;
  }
  (doubt.less_likely ? d.other_latitude : d.site_doubt) = doubt;
  if (d.wrong_study()) d = diagnosis::of_another_study(std::move(d));
}

}  // namespace

Diagnosis diagnose_case(const mc::Study& study, const CaseIdentification& id,
                        const diagnosis::DiagnoseOptions& options) {
  mc::require_own_terms(study);
  DRIFT_DEMAND(!study.filters.empty() && id.fits.size() == study.filters.size());
  const FilterSpec& nominal = study.filters.front();
  diagnosis::DiagnoseOptions as_asked = options;
  as_asked.proposing =
      diagnosis::Proposing::left_out;  // a strapdown study takes no term of its own
  Diagnosis d =
      diagnosis::diagnose(case_filter(nominal, id.study), id.study.measured(), {}, {}, as_asked);
  d.of_case = true;
  d.errors = errors_of(d, id);
  rename(d);
  sense(d, id.fits.front().fit.estimate);
  if (!id.study.compass.sees_earth) take_common_drift_out(d);
  for (auto& remark : d.remarks)
    if (auto* other = std::get_if<diagnosis::remark::OtherEquation>(&remark)) {
      other->nominal = nominal.coupling;
      other->of_case = true;
    }
  remark(d, id);
  // As it was fitted: of gyros that do not see the Earth a consumer's priors (case_filter).
  d.nominal = nominal;
  if (!id.study.compass.sees_earth) take_consumer_priors(d.nominal);
  // Another equation is the other one: of what lies between the two a case shows (1 - lambda) E
  // alone.
  std::vector<search::Cause> effects = d.causes;
  const auto closure = [](const search::Cause& c) { return c.term == closure_term; };
  for (search::Cause& c : d.causes)
    if (closure(c)) c.parameters.clear();
  const bool other_equation = std::erase_if(effects, closure) > 0;
  const FilterSpec as_fitted = std::move(d.patched);
  d.patched = diagnosis::patched_filter(nominal, effects, d.nominal);
  take_room(d, as_fitted);
  if (other_equation) d.patched.coupling = facts(nominal.coupling).other.value_or(nominal.coupling);
  take_latitude(d, id);
  take_times(d, id, nominal);
  return d;
}

}  // namespace drift::strapdown
