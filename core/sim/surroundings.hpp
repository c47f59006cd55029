#pragma once

#include <algorithm>

#include "core/base/check.hpp"
#include "core/physics/drift_model.hpp"
#include "core/plan/timeline.hpp"

namespace drift {

/// What an instant t [s] within an interval looks like, whatever the platform's attitude.
inline Moment moment_at(const Timeline& timeline, const Interval& interval, double t) {
  const double part = (t - interval.t0) / interval.length();
  const Covariates &a = interval.around0, &b = interval.around1;
  Moment m;
  m.t = t - interval.t_begin;
  m.t_p = interval.slew ? 0.0 : t - interval.t_dwell;
  m.slew = interval.slew;
  m.heading = interval.heading0 + part * (interval.heading1 - interval.heading0);
  m.omega_ie_l = timeline.site.omega_ie_l();
  m.temperature = a.temperature + part * (b.temperature - a.temperature);
  m.field_l = a.field_l + part * (b.field_l - a.field_l);
  m.temperature_rate = (b.temperature - a.temperature) / interval.length();
  if (interval.turn) m.turn = &*interval.turn;
  if (timeline.has_further != 0)
    for (std::size_t k = 0; k < most_covariates; ++k)
      m.covariates[k] = a.further[k] + part * (b.further[k] - a.further[k]);
  return m;
}

/// Fills what `needs` asks for, for one attitude.
template <class S>
void fill_surroundings(const Needs& needs, const Moment& now, const Mat3T<S>& R_lp, const S* memory,
                       Surroundings<S>& out) {
  DRIFT_DEMAND(memory != nullptr || !needs.memory);
  out.now = now;
  out.R_lp = R_lp;
  if (needs.gimbals)
    out.gimbal = gimbal_angles<S>(case_attitude(now.heading).transpose().template cast<S>() * R_lp);
  out.memory = memory;
}

/// What each term of the model needs that the timeline does not carry, in words.
std::vector<std::string> missing_covariates(const DriftModel& model, const Timeline& timeline);

/// InputError (recording) if there is any.
void require_covariates(const DriftModel& model, const Timeline& timeline);

}  // namespace drift
