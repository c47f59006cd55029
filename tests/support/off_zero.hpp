#pragma once

#include <string_view>

#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::test {

/// A study of a plan with the model that the simulated platform has.
inline mc::Study study_off_zero(std::string_view preset, const PlanDefaults& defaults) {
  mc::Study s;
  s.site = harbin;
  s.plan = preset_plan(preset, defaults).value();
  s.filters = {base_filter(Coupling::eq5)};
  return s;
}

/// Its recording "rec.csv", of which one column of angles reads so many degrees too much.
inline Recording recording_off_zero(const mc::Study& s, std::string_view column, double deg,
                                    std::uint64_t run) {
  const TruthSpec truth = base_truth(Coupling::eq5);
  const Timeline timeline = lay_out(s.plan, s.site);
  const TruthDraw draw = draw_truth(truth, timeline.chains, 7, run);
  Recording r = make_recording(
      timeline, Simulator(truth, s.readout).run(timeline, draw, 7, run).measured, s.readout);
  r.source = "rec.csv";
  for (Channel& c : r.channels)
    if (c.name == column)
      for (double& angle : c.values) angle += deg * drift::detail::deg;
  return r;
}

}  // namespace drift::test
