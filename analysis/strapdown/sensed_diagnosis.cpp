#include "analysis/strapdown/sensed_diagnosis.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "analysis/strapdown/findings.hpp"
#include "analysis/strapdown/sensed.hpp"

namespace drift::strapdown {
namespace {

using diagnosis::Diagnosis;
using diagnosis::Profile;
using search::CauseParameter;

/// How numbers of one parameter are taken over, in its unit. NaN stays NaN.
class SensedNumber {
 public:
  /// scales: the platform's (as_sensed).
  SensedNumber(std::size_t param, const Vec3& scales)
      : param_(param), scales_(scales), unit_(TermLibrary::specs[param].unit.to_si) {}

  double value(double v) const { return as_sensed(param_, v * unit_, scales_) / unit_; }
  double sigma(double v, double sigma) const { return std::abs(value(v + sigma) - value(v)); }
  bool mirrored() const { return value(1e-6) < value(0.0); }
  void interval(double& low, double& high) const {
    low = value(low);
    high = value(high);
    if (mirrored()) std::swap(low, high);
  }

 private:
  std::size_t param_;
  const Vec3& scales_;
  double unit_;
};

void sense(CauseParameter& p, const Vec3& scales) {
  const SensedNumber taken(p.param, scales);
  p.sigma = taken.sigma(p.value, p.sigma);
  p.value = taken.value(p.value);
  p.top = taken.value(p.top);
  taken.interval(p.low_95, p.high_95);
  for (double& v : p.any_of) v = taken.value(v);
  if (!taken.mirrored()) return;
  std::ranges::reverse(p.any_of);
  p.prior_sigmas = -p.prior_sigmas;
}

void sense(Profile& p, const Vec3& scales) {
  const SensedNumber taken(p.param, scales);
  p.sigma = taken.sigma(p.value, p.sigma);
  p.value = taken.value(p.value);
  p.top = taken.value(p.top);
  taken.interval(p.low_95, p.high_95);
  for (Profile::Point& at : p.points) at.value = taken.value(at.value);
  if (taken.mirrored()) std::ranges::reverse(p.points);
}

void sense(diagnosis::ShiftedParameter& p, const Vec3& before, const Vec3& after) {
  const SensedNumber was(p.param, before), is(p.param, after);
  p.sigma_before = was.sigma(p.before, p.sigma_before);
  p.before = was.value(p.before);
  p.sigma_after = is.sigma(p.after, p.sigma_after);
  p.after = is.value(p.after);
  p.shift_sigma = (p.after - p.before) / p.sigma_before;
}

/// The platform's scale factors with the causes of a set in the model. Those that it has already
/// are known of the first set alone: of the others they differ by what changes nothing.
Vec3 scales_with(const Diagnosis& d, Vec3 scales, int set) {
  const auto take = [&](std::size_t param, double value) {
    const std::size_t axis = param - TermLibrary::index("s_x");
    if (axis < 3)
      scales[static_cast<Eigen::Index>(axis)] = value * TermLibrary::specs[param].unit.to_si;
  };
  for (const diagnosis::ShiftedParameter& p : d.fit.shifted) take(p.param, p.after);
  for (const search::Cause& cause : d.causes)
    if (cause.set == set)
      for (const CauseParameter& p : cause.parameters) take(p.param, p.value);
  return scales;
}

void take_out(CauseParameter& p, double mean) {
  for (double* v : {&p.value, &p.top, &p.low_95, &p.high_95}) *v -= mean;
  p.less_mean = true;
}

void take_out(Profile& p, double mean) {
  for (double* v : {&p.value, &p.top, &p.low_95, &p.high_95}) *v -= mean;
  for (Profile::Point& at : p.points) at.value -= mean;
  p.less_mean = true;
}

/// Of the three of the nominal model, where all moved: each fit has a mean of its own.
bool take_out_of_shifted(std::vector<diagnosis::ShiftedParameter>& shifted) {
  double count = 0.0, before = 0.0, after = 0.0;
  for (const diagnosis::ShiftedParameter& p : shifted)
    if (is_input_axis_drift(p.param)) {
      count += 1.0;
      before += p.before;
      after += p.after;
    }
  if (count < 3.0) return false;
  for (diagnosis::ShiftedParameter& p : shifted)
    if (is_input_axis_drift(p.param)) {
      p.before -= before / count;
      p.after -= after / count;
      p.shift_sigma = (p.after - p.before) / p.sigma_before;
    }
  return true;
}

}  // namespace

void sense(Diagnosis& d, const EstimateResult& platform) {
  const Vec3 before = scales_of(platform), after = scales_with(d, before, 0);
  std::map<int, Vec3> of_set;
  for (const search::Cause& cause : d.causes)
    of_set.try_emplace(cause.set, scales_with(d, before, cause.set));
  for (search::Cause& cause : d.causes)
    for (CauseParameter& p : cause.parameters) sense(p, of_set.at(cause.set));
  for (Profile& p : d.profiles) sense(p, of_set.contains(p.set) ? of_set.at(p.set) : after);
  for (diagnosis::ShiftedParameter& p : d.fit.shifted) sense(p, before, after);
  for (search::CandidateScore& c : d.candidates)
    if (c.param) {
      const SensedNumber taken(*c.param, before);
      c.sigma = taken.sigma(c.amplitude, c.sigma);
      c.amplitude = taken.value(c.amplitude);
    }
}

void take_common_drift_out(Diagnosis& d) {
  std::map<int, std::vector<CauseParameter*>> of_input_axis;
  for (search::Cause& cause : d.causes)
    for (CauseParameter& p : cause.parameters)
      if (is_input_axis_drift(p.param)) of_input_axis[cause.set].push_back(&p);
  bool taken = take_out_of_shifted(d.fit.shifted);
  for (const auto& [set, parameters] : of_input_axis) {
    if (parameters.size() < 3) continue;
    double mean = 0.0;
    for (const CauseParameter* p : parameters) mean += p->value / 3.0;
    for (CauseParameter* p : parameters) {
      take_out(*p, mean);
      for (Profile& profile : d.profiles)
        if (profile.set == set && profile.param == p->param) take_out(profile, mean);
    }
    taken = true;
  }
  if (taken) d.remarks.emplace_back(diagnosis::remark::CommonDriftUnseen{});
}

}  // namespace drift::strapdown
