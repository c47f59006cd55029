#pragma once

#include <vector>

#include "core/config/section.hpp"
#include "core/physics/earth.hpp"
#include "core/plan/readout.hpp"
#include "core/plan/test_plan.hpp"
#include "core/recording/recording.hpp"

namespace drift {

/// [plan]: what kind of test, and its positions or its dwell detector.
struct PlanConfig {
  RecordingKind kind = RecordingKind::platform;
  TestPlan plan;                         ///< of a platform test
  std::vector<config::Place> places;     ///< of its positions, or the one of the preset
  double static_min = 2.0;               ///< strapdown: shortest dwell that counts [s]
  bool accelerometers_in_turns = false;  ///< strapdown: what they read in turns counts, too
};

/// Reads [plan]: a preset, or [[plan.position]] one by one, or kind = "strapdown".
PlanConfig read_plan(config::Section section);

/// Says where a plan has positions that no heading of the case lets a platform hold at this site.
void check_headings(const PlanConfig& config, const Site& site, config::Report& report);

/// Reads [site]; the latitude may be left out for a strapdown recording alone.
Site read_site(config::Section section, RecordingKind kind);

/// Reads [readout].
Readout read_readout(config::Section section);

}  // namespace drift
