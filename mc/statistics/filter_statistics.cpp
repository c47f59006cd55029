#include "mc/statistics/filter_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "core/estimate/estimate_result.hpp"
#include "core/estimate/start_consistency.hpp"
#include "core/stats/chi_square.hpp"
#include "core/stats/chi_square_band.hpp"
#include "core/stats/normal.hpp"

namespace drift::mc {

bool ChiSquareSum::add(double value, double degrees) {
  if (!(degrees > 0.0) || std::isnan(value)) return false;
  sum += value;
  dof += degrees;
  const double below = chi_square_probability(value, degrees);
  const bool inside = below >= stats::band_tail && below <= 1.0 - stats::band_tail;
  in_band.count(inside);
  place.add(below);
  return inside;
}

double ChiSquareSum::low() const {
  return stats::chi_square_band(dof).low;
}
double ChiSquareSum::high() const {
  return stats::chi_square_band(dof).high;
}
double ChiSquareSum::sigmas_above() const {
  return dof > 0.0 ? stats::deviate(sum, dof) : 0.0;
}

double ParameterHealth::start_ratio() const {
  return start_depends.of > 0 ? std::sqrt(start_square / static_cast<double>(start_depends.of))
                              : std::nan("");
}

FilterStatistics::FilterStatistics(const StudyColumns::Filter& columns, const HealthRules& rules)
    : columns_(columns),
      rules_(rules),
      health_(columns.layout.size()),
      starts_(columns.starts),
      samples_(columns.layout.size()),
      values_(columns.starts),
      sigmas_(columns.starts) {
  for (std::size_t k = 0; k < columns.layout.size(); ++k) {
    errors_.emplace_back(columns.layout.sigma[static_cast<Eigen::Index>(k)]);
    samples_[k].reserve(most_samples);
  }
}

bool FilterStatistics::estimated(std::span<const double> row, std::size_t start) const {
  return row[columns_.at(start, StudyColumns::status)] == static_cast<double>(EstimateStatus::ok);
}

void FilterStatistics::add(std::span<const double> row) {
  for (std::size_t s = 0; s < starts_.size(); ++s) add_start(row, s);
  if (starts_.size() > 1) compare_starts(row);
  if (!estimated(row, 0)) return;
  for (std::size_t k = 0; k < errors_.size(); ++k) {
    const double error = row[columns_.estimate(0, k)] - row[columns_.truth[k]];
    const double sigma = row[columns_.sigma(0, k)];
    if (std::isnan(error)) continue;  // a truth that has no such parameter
    errors_[k].add(error, sigma);
    if (samples_[k].size() < most_samples) samples_[k].push_back({error, sigma});
  }
}

void FilterStatistics::add_start(std::span<const double> row, std::size_t start) {
  using C = StudyColumns;
  StartStatistics& s = starts_[start];
  const bool there = estimated(row, start);
  s.diverged.count(!there);
  if (!there) {  // a divergence is a failure that is not silent
    s.healthy.count(false);
    s.wrong.count(true);
    s.silent.count(false);
    s.silent_course.follow(s.silent);
    if (start == 0)
      for (ParameterHealth& h : health_) h.silent.count(false);
    return;
  }
  const auto of = [&](C::Field field) { return row[columns_.at(start, field)]; };
  const bool healthy = s.nis.add(of(C::nis), of(C::nis_dof));
  s.nees.add(of(C::nees), of(C::nees_dof));
  const auto judged =  // a truth may have no such parameter
      std::ranges::count_if(columns_.truth, [&](std::size_t c) { return !std::isnan(row[c]); });
  s.nees_all.add(of(C::nees_all), static_cast<double>(judged));
  if (std::isfinite(of(C::lag1)))
    s.white.count(std::abs(of(C::lag1)) < stats::half_width_95 / std::sqrt(of(C::nis_dof)));
  bool some_wrong = false;
  for (std::size_t k = 0; k < health_.size(); ++k) {
    const double sigma = row[columns_.sigma(start, k)];
    const double error = row[columns_.estimate(start, k)] - row[columns_.truth[k]];
    const bool claims = sigma < rules_.claims * columns_.layout.sigma[static_cast<Eigen::Index>(k)];
    const bool wrong = claims && std::abs(error) > rules_.far_off * sigma;
    some_wrong = some_wrong || wrong;
    if (start > 0) continue;
    health_[k].claims.count(claims);
    health_[k].wrong.count(wrong);
    health_[k].silent.count(wrong && healthy);
  }
  s.healthy.count(healthy);
  s.wrong.count(some_wrong);
  s.silent.count(some_wrong && healthy);
  s.silent_course.follow(s.silent);
}

void FilterStatistics::compare_starts(std::span<const double> row) {
  for (std::size_t s = 0; s < starts_.size(); ++s)
    if (!estimated(row, s)) return;
  for (std::size_t k = 0; k < health_.size(); ++k) {
    for (std::size_t s = 0; s < starts_.size(); ++s) {
      values_[s] = row[columns_.estimate(s, k)];
      sigmas_[s] = row[columns_.sigma(s, k)];
    }
    const double ratio = start_consistency(values_, sigmas_);
    health_[k].start_square += ratio * ratio;
    health_[k].start_depends.count(start_verdict(ratio) == StartVerdict::depends_on_start);
  }
}

}  // namespace drift::mc
