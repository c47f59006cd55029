#pragma once

#include <span>
#include <vector>

#include "mc/statistics/error_statistics.hpp"
#include "mc/task/study_columns.hpp"

namespace drift::mc {

/// When the statistics of an estimate call it healthy, or wrong.
struct HealthRules {
  double claims = 0.5;  ///< a sigma below this share of the prior's claims to know the parameter
  double far_off =
      5.0;  ///< an error beyond this many sigmas of such a parameter makes the run wrong
};

/// A sum of chi-squares and of their degrees of freedom over runs.
struct ChiSquareSum {
  double sum = 0.0, dof = 0.0;
  stats::Rate in_band;     ///< single runs inside their own 95 % band
  DistributionBins place;  ///< of single runs in the chi-square of their degrees
  /// Whether it lies inside its band.
  bool add(double value, double degrees);
  double mean() const { return sum / dof; }  ///< 1 for an honest filter
  /// Where mean() lies with 95 % probability if the filter is honest.
  double low() const;
  double high() const;
  bool holds() const { return mean() >= low() && mean() <= high(); }
  /// The normal number that is as rarely exceeded as mean() if the filter is honest.
  double sigmas_above() const;
};

/// What the runs say of one filter started in one way.
struct StartStatistics {
  ChiSquareSum nis, nees, nees_all;
  stats::Rate white;     ///< lag-1 correlation inside its 95 % band
  stats::Rate healthy;   ///< NIS of the run inside its 95 % band
  stats::Rate wrong;     ///< some parameter that the filter claims to know is more than 5 sigma off
  stats::Rate silent;    ///< wrong and healthy: the silent failure rate
  stats::Rate diverged;  ///< no estimate at all
  RateCourse silent_course;  ///< `silent` as it came about
};

/// Silent failure and dependence on the start of one parameter.
struct ParameterHealth {
  stats::Rate claims;          ///< runs that claim to know it
  stats::Rate wrong;           ///< runs that claim to know it and are more than 5 sigma off
  stats::Rate silent;          ///< the same with healthy statistics
  double start_square = 0.0;   ///< sum of squared start-consistency ratios
  stats::Rate start_depends;   ///< ratio beyond 5: the answer depends on the start
  double start_ratio() const;  ///< root mean square over runs; NaN with one start
};

/// A run for the scatter picture.
struct Sample {
  double error = 0.0, sigma = 0.0;  ///< SI
};

/// Everything about one filter at one study point, fed run by run. Parameters and the rates of
/// ParameterHealth are those of start 0; the starts share their data.
class FilterStatistics {
 public:
  FilterStatistics(const StudyColumns::Filter& columns, const HealthRules& rules);

  /// row: of a run whose simulation succeeded.
  void add(std::span<const double> row);

  const StudyColumns::Filter& columns() const { return columns_; }
  const std::vector<ErrorStatistics>& errors() const { return errors_; }  ///< layout order
  const std::vector<ParameterHealth>& health() const { return health_; }  ///< layout order
  const std::vector<StartStatistics>& starts() const { return starts_; }
  const std::vector<std::vector<Sample>>& samples() const {
    return samples_;
  }  ///< of the first runs

  static constexpr std::size_t most_samples = 300;

 private:
  bool estimated(std::span<const double> row, std::size_t start) const;
  void add_start(std::span<const double> row, std::size_t start);
  void compare_starts(std::span<const double> row);

  StudyColumns::Filter columns_;
  HealthRules rules_;
  std::vector<ErrorStatistics> errors_;
  std::vector<ParameterHealth> health_;
  std::vector<StartStatistics> starts_;
  std::vector<std::vector<Sample>> samples_;
  std::vector<double> values_, sigmas_;  ///< work
};

}  // namespace drift::mc
