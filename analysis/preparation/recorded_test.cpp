#include "analysis/preparation/recorded_test.hpp"

#include <fmt/format.h>

#include "core/base/check.hpp"
#include "core/plan/environment.hpp"
#include "core/sim/own_term_steps.hpp"
#include "mc/study/own_terms_check.hpp"
#include "mc/study/own_terms_on_plan.hpp"

namespace drift::preparation {
namespace {

/// What numbers deviate from becomes their mean over all timelines, whatever their order.
void refer_to_common_mean(std::vector<Timeline>& timelines) {
  std::size_t intervals = 0;
  for (const Timeline& t : timelines) intervals += t.intervals.size();
  Covariates mean;
  for (const Timeline& t : timelines)
    for (std::size_t c = 0; c < covariate_components; ++c)
      mean.value[c] += t.mean.value[c] *
                       (static_cast<double>(t.intervals.size()) / static_cast<double>(intervals));
  for (Timeline& t : timelines) {
    for (Interval& i : t.intervals)
      for (std::size_t c = 0; c < covariate_components; ++c) {
        const double higher = t.mean.value[c] - mean.value[c];
        i.around0.value[c] += higher;
        i.around1.value[c] += higher;
      }
    t.mean = mean;
  }
}

/// The timelines one after another; recordings: what they are of.
Timeline joined(std::vector<Timeline> timelines, std::vector<JoinedRecording> recordings) {
  refer_to_common_mean(timelines);
  Timeline all = std::move(timelines.front());
  for (std::size_t k = 1; k < timelines.size(); ++k) {
    Timeline& next = timelines[k];
    const double shift = all.intervals.back().t1 - next.intervals.front().t0;
    for (Interval& i : next.intervals) {
      i.t0 += shift;
      i.t1 += shift;
      i.t_begin += shift;
      i.t_dwell += shift;
      i.chain += all.chains;
      i.first_node += all.nodes.size();
      all.intervals.push_back(i);
    }
    for (Node& n : next.nodes) n.t += shift;
    recordings[k].offset = shift;
    all.nodes.insert(all.nodes.end(), next.nodes.begin(), next.nodes.end());
    all.chains += next.chains;
    all.carried &= next.carried;
    all.loop_told = all.loop_told && next.loop_told;
    all.without_loop.insert(all.without_loop.end(), next.without_loop.begin(),
                            next.without_loop.end());
  }
  if (recordings.size() > 1) all.recordings = std::move(recordings);
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

void require_recordings(const std::vector<Recording>& recordings) {
  if (recordings.empty())
    throw InputError(
        ExitCode::recording,
        "no recording is given (expected at least one). Give one that was read or made");
  std::vector<std::string> wrong;
  for (const Recording& r : recordings) {
    try {
      check_recording(r, RecordingKind::platform);
    } catch (const InputError& error) {
      wrong.insert(wrong.end(), error.messages().begin(), error.messages().end());
    }
  }
  if (!wrong.empty()) throw InputError(ExitCode::recording, std::move(wrong));
}

RecordedTest recorded_test(const mc::Study& study, const std::vector<Recording>& recordings) {
  mc::require_own_terms(study);
  require_recordings(recordings);
  std::vector<Timeline> timelines;
  std::vector<Measurements> parts;
  std::vector<std::size_t> ends;
  FieldKnown field = FieldKnown::declared_or_recorded;
  std::vector<JoinedRecording> several;
  for (const Recording& r : recordings) {
    timelines.push_back(lay_out(r, study.plan, study.site));
    set_declared_vectors(timelines.back(), study.environment);
    if (assume_field(timelines.back(), study.site.latitude) == FieldKnown::assumed)
      field = FieldKnown::assumed;
    ends.push_back((ends.empty() ? 0 : ends.back()) + timelines.back().intervals.size());
    parts.push_back(measurements_of(r, study.readout));
    several.push_back({r.source.empty() ? fmt::format("recording {}", parts.size()) : r.source,
                       timelines.back().carried});
  }
  RecordedTest test{joined(std::move(timelines), std::move(several)), joined(parts),
                    std::move(ends), field};
  mc::resolve_own_terms_of_filters(test.timeline, study);
  if (!test.measured.acc.array().isFinite().any() && !test.measured.gimbal.array().isFinite().any())
    throw InputError(
        ExitCode::recording,
        fmt::format(
            "{}: nothing measured: every accelerometer and gimbal channel that [readout] asks "
            "for is absent or empty",
            recordings.front().source));
  return test;
}

Timeline planned_test(const mc::Study& study, const TestPlan& plan, const Timeline& recorded) {
  mc::require_own_terms(study);
  Timeline timeline = lay_out(plan, study.site);
  set_declared_vectors(timeline, study.environment);
  for (const CovariateSpec& c : known_covariates) {
    if (!c.is_vector() || !recorded.carries(c) || timeline.carries(c)) continue;
    Vec3 mean_l = Vec3::Zero();
    for (const Interval& i : recorded.intervals)
      mean_l += i.around1.vector(c) / static_cast<double>(recorded.intervals.size());
    timeline.set_vector(c, mean_l);
  }
  for (const FilterSpec& filter : study.filters) resolve_own_terms(timeline, filter);
  return timeline;
}

}  // namespace drift::preparation
