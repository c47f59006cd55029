#pragma once

#include "mc/study/study.hpp"
#include "mc/task/run_task.hpp"

namespace drift::mc {

/// What a study asks run_study() for: the tasks of its points, and its stop rule where it has one.
/// InputError (config) if a point makes no study (study_points()) or has nothing to run
/// (StudyTask).
StudyWork work_of(const Study& study);

}  // namespace drift::mc
