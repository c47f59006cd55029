#include "analysis/forms/move_setting.hpp"

#include <cmath>

namespace drift::forms {
namespace {

/// How far the next points of the grid are from a setting, as a factor: harmonics lie half a cycle
/// of the whole test apart, time constants and widths a factor of two.
double grid_step(const Form& form, const Instants& at) {
  if (form.when.kind != TimePart::Kind::harmonic) return 2.0;
  const double length = at.t.maxCoeff() - at.t.minCoeff();
  return 1.0 + 0.5 * form.when.setting / length;
}

}  // namespace

Form with_setting_moved(Form form, const Instants& at, const Bins& bins,
                        const PlaceInformation& info) {
  double* setting = moved_setting(form);
  if (setting == nullptr) return form;
  const double step = std::log(grid_step(form, at)), start = *setting;
  const auto T_at = [&](double log_factor) {
    *setting = start * std::exp(log_factor);
    return info.score(bins.mean(columns_of(form, at))).T;
  };
  double best = 0.0, top = T_at(0.0);
  for (double width = step; width > 1e-3 * step; width *= 0.3)
    for (const double off : {-0.9, -0.6, -0.3, 0.3, 0.6, 0.9}) {
      const double at_here = best + off * width;
      if (std::abs(at_here) > step) continue;
      if (const double T = T_at(at_here); T > top) {
        top = T;
        best = at_here;
      }
    }
  *setting = start * std::exp(best);
  // Half a step of the grid down: what a fit through the full dynamics is left to find.
  *sigma_of_moved(form) = 0.5 * *setting * (1.0 - std::exp(-step));
  return form;
}

}  // namespace drift::forms
