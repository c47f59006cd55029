#include "analysis/preparation/recorded_test.hpp"

#include <fmt/format.h>

#include "core/base/check.hpp"
#include "core/plan/environment.hpp"

namespace drift::preparation {
namespace {

Timeline joined(std::vector<Timeline> timelines) {
  Timeline all = std::move(timelines.front());
  for (std::size_t k = 1; k < timelines.size(); ++k) {
    Timeline& next = timelines[k];
    const double shift = all.intervals.back().t1 - next.intervals.front().t0;
    const double warmer = next.mean_temperature - all.mean_temperature;  // one reference for all
    for (Interval& i : next.intervals) {
      i.around0.temperature += warmer;
      i.around1.temperature += warmer;
      i.t0 += shift;
      i.t1 += shift;
      i.t_begin += shift;
      i.t_dwell += shift;
      i.chain += all.chains;
      i.first_node += all.nodes.size();
      all.intervals.push_back(i);
    }
    for (Node& n : next.nodes) n.t += shift;
    all.nodes.insert(all.nodes.end(), next.nodes.begin(), next.nodes.end());
    all.chains += next.chains;
    all.has_temperature = all.has_temperature && next.has_temperature;
    all.has_field = all.has_field && next.has_field;
  }
  return all;
}

Measurements joined(const std::vector<Measurements>& parts) {
  Eigen::Index n = 0;
  for (const auto& p : parts) n += p.acc.cols();
  Measurements all{Mat3X(3, n), Mat3X(3, n)};
  Eigen::Index at = 0;
  for (const auto& p : parts) {
    all.acc.middleCols(at, p.acc.cols()) = p.acc;
    all.gimbal.middleCols(at, p.acc.cols()) = p.gimbal;
    at += p.acc.cols();
  }
  return all;
}

}  // namespace

RecordedTest recorded_test(const mc::Study& study, const std::vector<Recording>& recordings) {
  std::vector<Timeline> timelines;
  std::vector<Measurements> parts;
  std::vector<std::size_t> ends;
  FieldKnown field = FieldKnown::declared_or_recorded;
  for (const Recording& r : recordings) {
    timelines.push_back(lay_out(r, study.plan, study.site));
    set_known_field(timelines.back(), study.environment);
    if (assume_field(timelines.back(), study.site.latitude) == FieldKnown::assumed)
      field = FieldKnown::assumed;
    ends.push_back((ends.empty() ? 0 : ends.back()) + timelines.back().intervals.size());
    parts.push_back(measurements_of(r, study.readout));
  }
  RecordedTest test{joined(std::move(timelines)), joined(parts), std::move(ends), field};
  if (!test.measured.acc.array().isFinite().any() && !test.measured.gimbal.array().isFinite().any())
    throw InputError(
        ExitCode::recording,
        fmt::format(
            "{}: nothing measured: every accelerometer and gimbal channel that [readout] asks "
            "for is absent or empty",
            recordings.front().source));
  return test;
}

Timeline planned_test(const mc::Study& study, const TestPlan& plan) {
  Timeline timeline = lay_out(plan, study.site);
  set_known_field(timeline, study.environment);
  assume_field(timeline, study.site.latitude);
  return timeline;
}

}  // namespace drift::preparation
