#pragma once

#include "core/plan/timeline.hpp"
#include "mc/study/sweep.hpp"
#include "mc/task/study_columns.hpp"

namespace drift::mc {

/// A run of one study point: the truth is drawn and simulated once, then every filter estimates
/// from every start on the same data. Columns: StudyColumns.
class StudyTask final : public RunTask {
 public:
  /// InputError (config) if there is nothing to simulate or to estimate with, if the plan is none
  /// of a platform, if the loop is fed back from a filter (then every filter makes its own data),
  /// if the estimator cannot model what a filter claims (unmodelled.hpp), or as
  /// require_own_terms().
  explicit StudyTask(Study study);

  const std::vector<Column>& columns() const override { return named_; }
  /// InputError (config) as require_own_terms(): what was read since is another study's.
  std::unique_ptr<RunWorker> worker() const override;
  std::size_t together() const override;

  /// Whether runs are estimated by a filter of the study in lock step: such as LaneIntervals can,
  /// whose surroundings are those of every run.
  bool goes_in_lanes(const FilterSpec& filter) const;

  const Study& study() const { return study_; }
  const Timeline& timeline() const { return timeline_; }
  const StudyColumns& layout() const { return layout_; }

 private:
  Study study_;
  Timeline timeline_;
  StudyColumns layout_;
  std::vector<Column> named_;
};

/// The tasks of all points, in their order.
std::vector<TaskPoint> study_tasks(const std::vector<StudyPoint>& points);

}  // namespace drift::mc
