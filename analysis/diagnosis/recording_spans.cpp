#include "analysis/diagnosis/recording_spans.hpp"

#include "analysis/identification/recording_names.hpp"
#include "analysis/preparation/recorded_test.hpp"

namespace drift::diagnosis {

std::vector<RecordingSpan> recording_spans(const mc::Study& study,
                                           const std::vector<Recording>& recordings) {
  if (recordings.size() < 2) return {};
  const preparation::RecordedTest test = preparation::recorded_test(study, recordings);
  const auto names = identification::recording_names(recordings);
  std::vector<RecordingSpan> spans;
  std::size_t first = 0;
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    const Interval &begin = test.timeline.intervals[first],
                   &end = test.timeline.intervals[test.ends[k] - 1];
    const Channel* time = recordings[k].find("time");
    const double own = time && !time->values.empty() ? time->values.front() : begin.t1;
    spans.push_back({names[k], begin.t0, end.t1, begin.t1 - own});
    first = test.ends[k];
  }
  return spans;
}

}  // namespace drift::diagnosis
