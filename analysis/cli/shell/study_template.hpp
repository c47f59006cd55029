#pragma once

#include <optional>
#include <string>

#include "analysis/cli/shell/recorded_plan.hpp"

namespace drift::cli {

/// Study files that `driftscope new` writes.
enum class StudyKind { platform, strapdown, study, sweep, diagnose };

/// A study file with a comment at everything that is to be thought about. `mapping`: the
/// [recording] section of a file with columns of its own, or empty.
std::string study_template(StudyKind kind, const std::optional<RecordedPlan>& plan,
                           const std::string& mapping, const RecordedSite& site = {});

}  // namespace drift::cli
