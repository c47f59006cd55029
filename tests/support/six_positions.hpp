#pragma once

#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/preparation/prepare.hpp"
#include "core/plan/environment.hpp"
#include "core/sim/measurements.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::test {

/// A study of six positions at Harbin with the truth at zero.
inline mc::Study six_study(const PlanDefaults& defaults) {
  mc::Study s;
  s.path = "study.toml";
  s.site = harbin;
  s.plan = preset_plan("six", defaults).value();
  s.truth = base_truth(Coupling::eq5);
  s.filters = {base_filter(Coupling::eq5)};
  return s;
}
inline mc::Study six_study(double dwell = 1200.0, double sample = 60.0) {
  PlanDefaults defaults;
  defaults.dwell = dwell;
  defaults.sample = sample;
  return six_study(defaults);
}

inline Recording simulated(const mc::Study& s) {
  const Timeline timeline = lay_out(s.plan, s.site);
  const TruthDraw draw = draw_truth(s.truth, timeline.chains, 1, 0);
  Simulator simulator(s.truth, s.readout);
  return make_recording(timeline, simulator.run(timeline, draw, 1, 0).measured, s.readout);
}

/// A recording during which the temperature swings by 3 K in three hours, of a truth that has these
/// values [SI].
inline Recording simulated_in_a_swing(
    const mc::Study& s, std::initializer_list<std::pair<std::string_view, double>> values) {
  Timeline timeline = lay_out(s.plan, s.site);
  Environment swing;
  CovariateCourse& course = swing[covariate("temperature")];
  course.mean.front() = 25.0;
  course.amplitude = 3.0;
  course.period = 10800.0;
  set_environment(timeline, swing, 1, 0);
  TruthDraw draw = draw_truth(s.truth, timeline.chains, 1, 0);
  for (const auto& [key, value] : values) draw.theta[param(key)] = value;
  return make_recording(timeline, Simulator(s.truth, s.readout).run(timeline, draw, 1, 0).measured,
                        s.readout);
}

/// Six positions of 20 minutes without drift of second order in g, but for D_SS_x, which the
/// nominal filter does not know; what they are to be misunderstood as, a test says.
struct SixWithHidden {
  mc::Study study;
  Recording recording;

  /// law: null where the plan leaves it open. hidden: D_SS_x [deg/h/g^2].
  explicit SixWithHidden(std::optional<CommandLaw> law, double hidden) {
    PlanDefaults defaults;
    defaults.dwell = 1200.0;
    defaults.mode = law;
    study = six_study(defaults);
    study.truth.active &= ~only({"D_II", "D_OO", "D_SS", "D_IO", "D_IS", "D_OS"});
    study.filters.front().active = study.truth.active;
    recording = recorded(hidden);
  }

  /// By the plan and at the site of the study as they are now.
  Recording recorded(double hidden) const {
    const Timeline timeline = lay_out(study.plan, study.site);
    TruthSpec with_hidden = study.truth;
    with_hidden.active |= only({"D_SS_x"});
    TruthDraw draw = draw_truth(study.truth, timeline.chains, 1, 0);
    draw.theta[param("D_SS_x")] = hidden * deg_per_h;
    return make_recording(timeline,
                          Simulator(with_hidden, study.readout).run(timeline, draw, 1, 0).measured,
                          study.readout);
  }
};

inline bool says(const preparation::Prepared& p, std::string_view text) {
  for (const auto& remark : p.remarks)
    if (remark.find(text) != std::string_view::npos) return true;
  return false;
}

inline std::vector<double>& channel(Recording& r, std::string_view name) {
  for (Channel& c : r.channels)
    if (c.name == name) return c.values;
  throw std::runtime_error("no such channel");
}

}  // namespace drift::test
