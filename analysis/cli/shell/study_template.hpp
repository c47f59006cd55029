#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/recording/recording.hpp"

namespace drift::cli {

/// Study files that `driftscope new` writes.
enum class StudyKind { platform, strapdown, study, sweep, diagnose };

/// What a recording says of the plan it was made on.
struct RecordedPlan {
  struct Position {
    double length = 0.0;  ///< [s], a whole number of samples
    std::string axes;     ///< "x=N y=W z=U": only what is up is seen
  };
  double sample = 0.0;  ///< [s]
  std::vector<Position> positions;
};

/// Dwells, samples and the vertical axis of each position of a platform's recording.
RecordedPlan recorded_plan(const Recording& recording);

/// A study file with a comment at everything that is to be thought about. `mapping`: the
/// [recording] section of a file with columns of its own, or empty.
std::string study_template(StudyKind kind, const std::optional<RecordedPlan>& plan,
                           const std::string& mapping);

}  // namespace drift::cli
