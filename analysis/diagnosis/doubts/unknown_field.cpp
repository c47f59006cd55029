#include "analysis/diagnosis/doubts/unknown_field.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string_view>

#include "analysis/inference/thresholds.hpp"
#include "core/stats/normal.hpp"

namespace drift::diagnosis {
namespace {

bool follows_field(std::string_view term) {
  const auto found = TermLibrary::find_term(term);
  return found && identification::follows_field(TermLibrary::terms[*found]);
}

bool names_one(const Diagnosis& d) {
  return std::ranges::any_of(d.causes,
                             [](const search::Cause& c) { return follows_field(c.term); });
}

/// Whether something that follows the field was found, or may have lost by the field alone.
bool may_follow_field(const Diagnosis& d) {
  double top = 0.0, own = 0.0;
  for (const search::CandidateScore& c : d.candidates) {
    top = std::max(top, c.score);
    if (follows_field(c.term)) own = std::max(own, c.score);
  }
  return names_one(d) ||
         (d.verdict != Verdict::consistent && own > inference::SiteLimits::worth_asking * top);
}

void add_error(search::CauseParameter& p, const identification::FieldFound& field) {
  const double more = field.sigma_of(p.param) / TermLibrary::specs[p.param].unit.to_si;
  if (!(more > 0.0)) return;
  const double half = stats::half_width_95 * more;
  p.low_95 = p.value - std::hypot(p.value - p.low(), half);
  p.high_95 = p.value + std::hypot(p.high() - p.value, half);
  p.sigma = std::hypot(p.sigma, more);
}

}  // namespace

mc::Study with_field(mc::Study study, const Vec3& field_l) {
  CovariateCourse& course = study.environment[covariate("field")];
  for (int k = 0; k < 3; ++k) course.mean[static_cast<std::size_t>(k)] = field_l[k];
  return study;
}

Diagnosis with_error_of_field(Diagnosis d, const mc::Study& study,
                              const std::vector<Recording>& recordings,
                              const DiagnoseOptions& options) {
  if (!remark_in<remark::FieldAssumed>(d) || !may_follow_field(d)) return d;
  const auto began = std::chrono::steady_clock::now();
  auto field = identification::field_found(study, recordings, d.nominal);
  if (!field) return d;
  std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  if (field->another()) {
    DiagnoseOptions there = options;
    there.search.read_off = {covariate("field").set(), field->log_prior};
    Diagnosis again = diagnose(with_field(study, field->field_l), recordings, there);
    for (const auto& [stage, seconds] : d.seconds) took += std::chrono::duration<double>(seconds);
    d = std::move(again);
  }
  d.seconds.emplace_back("field", took.count());
  for (search::Cause& cause : d.causes)
    for (search::CauseParameter& p : cause.parameters) add_error(p, *field);
  if (names_one(d)) d.field = std::move(field);
  return d;
}

}  // namespace drift::diagnosis
