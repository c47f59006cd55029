#include "mc/engine/study_work.hpp"

#include <memory>

#include "mc/statistics/stop_rule.hpp"
#include "mc/study/sweep.hpp"
#include "mc/task/study_task.hpp"

namespace drift::mc {

StudyWork work_of(const Study& study) {
  const auto points = std::make_shared<const std::vector<StudyPoint>>(study_points(study));
  StudyWork work{study_tasks(*points), {}};
  if (stop_rule(*points)) work.stop_rules = [points](std::size_t) { return stop_rule(*points); };
  return work;
}

}  // namespace drift::mc
