#include "analysis/preparation/gravity_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/preparation/input_thresholds.hpp"
#include "core/physics/term_library.hpp"
#include "core/recording/recording_units.hpp"
#include "core/stats/median.hpp"

namespace drift::preparation {
namespace {

/// By how much the study's own priors let bias and scale lengthen the specific force [g].
double room_of_priors(const mc::Study& study) {
  double variance = 0.0;
  for (const FilterSpec& filter : study.filters) {
    double sum = 0.0;
    for (std::size_t p = 0; p < TermLibrary::num_params; ++p) {
      const std::string_view name = TermLibrary::specs[p].key.view();
      const bool along = name.size() == 4 && (name.starts_with("K0_") || name.starts_with("K1_"));
      if (!along || !filter.active[p]) continue;
      const Prior& prior = filter.priors[p];
      const double most = std::abs(prior.mean()) + GravityLimits::sigmas * prior.sigma();
      sum += most * most;
    }
    variance = std::max(variance, sum);
  }
  return std::sqrt(variance);
}

}  // namespace

std::string other_than_one_g(const mc::Study& study, const Recording& recording) {
  const std::vector<double> lengths = specific_forces(recording);
  if (lengths.size() < GravityLimits::enough) return "";
  const double f = stats::upper_median(lengths);
  const double room = GravityLimits::room + room_of_priors(study);
  if (std::abs(f - 1.0) <= room) return "";
  const Unit& unit = recording.find("acc_x")->unit;
  const std::string_view other = unit_of_one_g(f / unit.to_si);
  return fmt::format(
      "{}:acc_x: the accelerometers together read {:.4g} g, as half of the rows of dwells show "
      "(expected 1 g within {:.2g}). {}",
      recording.source, f, room,
      other.empty() ? "Correct their unit or scale: no unit known here explains it"
                    : fmt::format("Correct their unit: the numbers look like [{}], not [{}]", other,
                                  unit.symbol.view()));
}

}  // namespace drift::preparation
