#pragma once

#include <vector>

#include "analysis/preparation/assumed_field.hpp"
#include "core/recording/recording.hpp"
#include "core/sim/measurements.hpp"
#include "mc/study/study.hpp"

namespace drift::preparation {

/// A test as recordings show it: their chains one after another, and what was measured.
struct RecordedTest {
  Timeline timeline;
  Measurements measured;
  std::vector<std::size_t> ends;  ///< of each recording, the interval after its last
  FieldKnown field = FieldKnown::declared_or_recorded;
};

/// InputError (recording) if there is no recording, or one is not as files are read
/// (check_recording()).
void require_recordings(const std::vector<Recording>& recordings);

/// Lays recordings out by the study's plan, in the surroundings that they carry or, of a field that
/// is known, that [environment] declares; else with the field of a dipole. InputError (recording)
/// where one does not fit the plan, where nothing is measured, and as require_recordings();
/// (config) as require_own_terms().
RecordedTest recorded_test(const mc::Study& study, const std::vector<Recording>& recordings);

/// A test that is planned, at the site of one that was recorded: with the vectors that
/// [environment] declares, else with the means of those of the recorded test. InputError (config)
/// as require_own_terms().
Timeline planned_test(const mc::Study& study, const TestPlan& plan, const Timeline& recorded);

}  // namespace drift::preparation
