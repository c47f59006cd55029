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
  if (interval.turn) m.turn = &*interval.turn;
  if (timeline.carried == 0) return m;
  for (std::size_t k = 0; k < a.value.size(); ++k) {
    const double change = b.value[k] - a.value[k];
    m.covariates.value[k] = a.value[k] + part * change;
    m.rates.value[k] = change / interval.length();
  }
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

/// The columns of a covariate: "temperature [degC]", "field_n, field_w, field_u [gauss]".
std::string columns_in_words(const CovariateSpec& c);

/// What the coupling and each term of the model need that the timeline does not carry, in words.
std::vector<std::string> missing_covariates(const DriftModel& model, const Timeline& timeline);

/// InputError (recording) if there is any.
void require_covariates(const DriftModel& model, const Timeline& timeline);

}  // namespace drift
