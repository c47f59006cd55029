#include "analysis/strapdown/case_diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/diagnosis/advice/patched_study.hpp"
#include "analysis/strapdown/case_errors.hpp"
#include "analysis/strapdown/score.hpp"
#include "core/base/check.hpp"

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
  for (auto& signal : d.signals) signal.equation = equation_of_case(signal.equation);
  for (auto& noise : d.noise)
    if (noise.component == "gimbal_white") noise.component = "gyro_white";
  for (auto& remark : d.remarks)
    if (auto* free = std::get_if<diagnosis::remark::FreeInputExplains>(&remark))
      free->equation = equation_of_case(free->equation);
}

void sense(search::CauseParameter& p) {
  const double unit = TermLibrary::specs[p.param].unit.to_si;
  if (p.param == closure_param) {
    p.value = 1.0 - p.value;
    return;
  }
  const Sensed s = as_sensed(p.param, p.value * unit, p.sigma * unit);
  p.value = s.value / unit;
  p.sigma = s.sigma / unit;
}

void sense(diagnosis::ShiftedParameter& p) {
  const double unit = TermLibrary::specs[p.param].unit.to_si;
  const Sensed before = as_sensed(p.param, p.before * unit, p.sigma_before * unit),
               after = as_sensed(p.param, p.after * unit, p.sigma_after * unit);
  p.before = before.value / unit;
  p.sigma_before = before.sigma / unit;
  p.after = after.value / unit;
  p.sigma_after = after.sigma / unit;
  p.shift_sigma = (p.after - p.before) / p.sigma_before;
}

/// Root mean square errors of the nominal and of the patched model, on the data of the fit.
std::vector<diagnosis::ErrorOfKind> errors_of(const Diagnosis& d, const CaseStudy& of,
                                              double gravity) {
  const auto of_model = [&](const FilterSpec& filter) {
    const BatchResult fit = fit_batch(filter, of.measured(), make_layout(filter).theta);
    return case_errors(of.test, filter.model(), theta_of(filter, fit), fit.psi0_l);
  };
  const CaseErrors before = of_model(d.nominal), after = d.has_patch ? of_model(d.patched) : before;
  return {{"gyro rate in dwells", "deg/h", root_mean_square(before.gyro) / unit::deg_per_h.to_si,
           root_mean_square(after.gyro) / unit::deg_per_h.to_si},
          {"up after a turn", "deg", root_mean_square(before.up) / unit::deg.to_si,
           root_mean_square(after.up) / unit::deg.to_si},
          {"gravity in dwells", "m/s^2", root_mean_square(before.gravity) * gravity,
           root_mean_square(after.gravity) * gravity}};
}

}  // namespace

Diagnosis diagnose_case(const mc::Study& study, const CaseStudy& of,
                        const diagnosis::DiagnoseOptions& options) {
  if (study.filters.empty())
    throw InputError(ExitCode::config,
                     fmt::format("{}: no [[filter]]: its first is the nominal model (expected "
                                 "one). Add a section [[filter]] with name, coupling and terms",
                                 study.path));
  const FilterSpec& nominal = study.filters.front();
  diagnosis::DiagnoseOptions as_asked = options;
  as_asked.proposing =
      diagnosis::Proposing::left_out;  // a strapdown study takes no term of its own
  Diagnosis d = diagnosis::diagnose(case_filter(nominal, of), of.measured(), {}, {}, as_asked);
  d.errors = errors_of(d, of, study.site.gravity);
  rename(d);
  for (search::Cause& cause : d.causes)
    for (search::CauseParameter& p : cause.parameters) sense(p);
  for (diagnosis::ShiftedParameter& p : d.fit.shifted) sense(p);
  for (auto& remark : d.remarks)
    if (auto* other = std::get_if<diagnosis::remark::OtherEquation>(&remark))
      other->nominal = nominal.coupling;
  d.nominal = nominal;
  // Another equation is the other one: what lies between the two is for the report.
  std::vector<search::Cause> effects = d.causes;
  const auto closure = [](const search::Cause& c) { return c.term == closure_term; };
  const bool other_equation = std::erase_if(effects, closure) > 0;
  d.patched = diagnosis::patched_filter(nominal, effects);
  if (other_equation) d.patched.coupling = facts(nominal.coupling).other.value_or(nominal.coupling);
  return d;
}

}  // namespace drift::strapdown
