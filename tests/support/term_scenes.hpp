#pragma once

#include <fmt/format.h>

#include <string>

#include "core/plan/environment.hpp"
#include "core/sim/predict.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::test {

inline Environment harbin_day() {
  Environment e;
  for (const CovariateSpec& c : known_covariates) {
    const double usual = c.usual * c.unit.to_si;
    CovariateCourse& course = e[c];
    if (c.is_vector()) {
      course.mean = {0.52 * usual, 0.04 * usual, -0.96 * usual};
    } else {
      course.mean[0] = 2.0 * usual;
      course.amplitude = 0.05 * usual;
      course.period = 7200.0;
      course.ramp = 0.02 * usual / 3600.0;
    }
  }
  return e;
}

/// The same as a section of a study.
inline std::string harbin_day_text() {
  std::string text = "[environment]\n";
  const Environment day = harbin_day();
  for (const CovariateSpec& c : known_covariates) {
    const auto add = [&](std::string_view key, double value, const Unit& unit) {
      text += fmt::format("{} = \"{:.9g} {}\"\n", key, value / unit.to_si, unit.symbol.view());
    };
    for (std::size_t k = 0; k < c.components(); ++k) add(c.column(k), *day[c].mean[k], c.unit);
    if (c.is_vector()) continue;
    add(fmt::format("{}_amplitude", c.name), day[c].amplitude, c.unit);
    add(fmt::format("{}_period", c.name), day[c].period, unit::hour);
    add(fmt::format("{}_ramp", c.name), day[c].ramp, c.unit_per_hour());
  }
  return text;
}

/// Makes of a test one of a case that turns while its accelerometers are read: as it is told, and
/// with an acceleration beside.
inline void read_turns(Timeline& timeline) {
  timeline.reads_turns = true;
  for (Interval& i : timeline.intervals) {
    const Mat3 w = skew(Vec3(i.omega_cmd_p + Vec3(0.02, -0.03, 0.01)));
    const Mat3 acceleration = skew(Vec3(0.004, 0.002, -0.003));
    i.turn = CaseTurn{i.omega_cmd_p, (acceleration + w * w) / 9.8};
  }
}

/// A test in which every effect shows: with slews and commands, or at 45 deg; temperature and field
/// known.
inline Timeline scene(std::string_view preset, CommandLaw mode, double dwell = 600.0,
                      double sample = 60.0) {
  Timeline timeline = preset_timeline(preset, mode, dwell, sample);
  set_environment(timeline, harbin_day(), 1, 0);
  read_turns(timeline);
  return timeline;
}

inline ParamMask term_params(std::size_t term) {
  TermMask mask;
  mask.set(term);
  return TermLibrary::params_of(mask);
}

/// Amplitudes of the parameters of a term, alternately 0.8 and -1.2 of their prior sigma; what is
/// nonlinear at its default, a step early enough to be seen.
inline void set_term(Theta& theta, std::size_t term, double factor = 1.0) {
  const TermInfo& info = TermLibrary::terms[term];
  for (std::size_t i = info.first; i < info.first + info.count; ++i) {
    const Prior prior = TermLibrary::specs[i].prior_si();
    theta[i] = prior.mean();
    if (TermLibrary::specs[i].amplitude() && i != closure_param)
      theta[i] += factor * (i % 2 ? 0.8 : -1.2) * prior.sigma();
  }
  if (info.key == "mass_unbalance_step") theta[param("dD_t0")] = 3000.0;
  if (info.key == closure_term) theta[closure_param] = 0.4 * factor;
}

/// The coupling under which a term acts: lambda alone needs one that has it.
inline Coupling coupling_for(std::size_t term) {
  return TermLibrary::terms[term].key == closure_term ? Coupling::lambda : Coupling::eq6;
}

/// Every term that a recording shows: no random ones.
inline std::vector<std::size_t> visible_terms() {
  std::vector<std::size_t> terms;
  for (std::size_t t = 0; t < TermLibrary::terms.size(); ++t)
    if (!TermLibrary::terms[t].stochastic()) terms.push_back(t);
  return terms;
}

/// Largest difference of two sets of measurements: [g], and [rad] over turns.
inline double difference(const Measurements& a, const Measurements& b) {
  double worst = (a.acc - b.acc).cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < a.gimbal.cols(); ++i)
    for (int k = 0; k < 3; ++k)
      worst = std::max(worst, std::abs(angle_difference(a.gimbal(k, i), b.gimbal(k, i))));
  return worst;
}

}  // namespace drift::test
