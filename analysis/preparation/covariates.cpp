#include "analysis/preparation/covariates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/physics/term_library.hpp"

namespace drift::preparation {
namespace {

const std::vector<std::string> platform_channels{
    "time",       "position",     "phase",         "acc_x",        "acc_y",
    "acc_z",      "gimbal_outer", "gimbal_middle", "gimbal_inner", "cmd_x",
    "cmd_y",      "cmd_z",        "case_heading",  "loop_eta_x",   "loop_eta_y",
    "loop_eta_z", "loop_xi_x",    "loop_xi_y",     "loop_xi_z"};

}  // namespace

std::vector<Covariate> covariates_of(const std::vector<Recording>& recordings) {
  std::vector<Covariate> all;
  for (const Channel& c : recordings.front().channels) {
    if (std::find(platform_channels.begin(), platform_channels.end(), c.name) !=
        platform_channels.end())
      continue;
    Covariate v{c.name, {}};
    for (const Recording& r : recordings) {
      const Channel* other = r.find(c.name);
      if (other == nullptr || other->unit.dim != c.unit.dim) {
        v.value.insert(v.value.end(), r.rows(), std::nan(""));
        continue;
      }
      // Kelvins in one and degC in another.
      const double zero = celsius_offset(other->unit) - celsius_offset(c.unit);
      for (const double x : other->values) v.value.push_back(x + zero);
    }
    all.push_back(std::move(v));
  }
  return all;
}

std::vector<std::string> unmapped_temperature_of_terms(const mc::Study& study,
                                                       const Recording& recording) {
  std::vector<std::string> wrong;
  const std::string& unmapped = recording.unmapped_temperature;
  if (unmapped.empty()) return wrong;
  for (std::size_t t = 0; t < TermLibrary::num_terms; ++t) {
    const TermInfo& term = TermLibrary::terms[t];
    if ((term.needs.covariates & covariate("temperature").set()) == 0 ||
        std::ranges::none_of(study.filters,
                             [&](const FilterSpec& f) { return f.model().terms[t]; }))
      continue;
    wrong.push_back(
        fmt::format("{}: term '{}' needs the temperature, which no column is mapped "
                    "as (expected one). {}",
                    recording.source, term.key, unmapped));
  }
  return wrong;
}

}  // namespace drift::preparation
