#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mc/store/study_reader.hpp"

namespace drift::mc {

/// How far one study point is.
struct PointState {
  std::uint64_t runs = 0, failed = 0;  ///< results
  bool by_rule = false;                ///< the stop rule had enough of them
  bool complete = false;
  double cpu_s = 0.0;  ///< that they took
};

/// How far a study is, and whether results that were there are gone.
struct StudyState {
  std::vector<PointState> points;
  std::uint64_t asked = 0;  ///< runs per point; with a stop rule: at most
  std::uint64_t runs = 0, failed = 0;
  std::size_t complete = 0;    ///< points
  std::size_t by_rule = 0;     ///< points that the stop rule ended before `asked` runs
  std::size_t lost = 0;        ///< points that were complete once and are not any more
  std::uint64_t finished = 0;  ///< runs per point with which the study was complete once

  bool all() const { return complete == points.size(); }
  /// "the stop rule ended 2 of 3 points early, after 128 to 640 of at most 20000 runs"; empty if
  /// none.
  std::string ended_by_rule() const;
  /// Where `lost`: "the study was complete with 100 runs per point; of 1 of 2 points ...".
  std::string was_complete() const;
};

/// Reads all results once.
StudyState state_of(StudyReader& reader, const StopRules& rules);

}  // namespace drift::mc
