#include "analysis/preparation/covariates/covariate_gaps.hpp"

#include <algorithm>
#include <cmath>

#include "core/physics/own/own_terms.hpp"
#include "core/recording/rows/row_spacing.hpp"

namespace drift::preparation {
namespace {

/// Seconds that every row lasts; where rows are missing, or the platform was caged in between, what
/// is usual.
std::vector<double> lengths_of_rows(const Recording& r, const std::vector<double>& planned) {
  const RowSpacing spacing = row_spacing(r, planned);
  std::vector<double> lengths(r.rows());
  for (std::size_t row = 0; row < r.rows(); ++row) {
    const double length = row == 0 || spacing.gap(row) ? spacing.usual[row] : spacing.step[row];
    lengths[row] = std::isfinite(length) ? length : 0.0;
  }
  return lengths;
}

/// Bridges what is missing of one column.
class Bridge {
 public:
  Bridge(std::vector<double>& values, const std::vector<double>& time,
         const std::vector<double>& recorded)
      : values_(values), time_(time), recorded_(recorded) {
    Recording readings;
    readings.channels = {{"time", unit::s, {}}};
    for (std::size_t row = 0; row < values.size(); ++row)
      if (std::isfinite(values[row])) {
        read_.push_back(row);
        readings.channels.front().values.push_back(recorded[row]);
      }
    if (!read_.empty()) usual_ = row_spacing(readings);
  }

  bool has_readings() const { return !read_.empty(); }

  void close() {
    for (std::size_t k = 1; k < read_.size(); ++k) {
      const std::size_t a = read_[k - 1], b = read_[k];
      if (usual_.gap(k) && usual_.missing(k) > 1.0) continue;
      const double from = values_[a], slope = (values_[b] - from) / (time_[b] - time_[a]);
      for (std::size_t row = a + 1; row < b; ++row)
        values_[row] = from + slope * (time_[row] - time_[a]);
    }
    const std::size_t first = read_.front(), last = read_.back();
    for (std::size_t row = 0; row < first; ++row) hold(row, first, usual_.usual.front());
    for (std::size_t row = last + 1; row < values_.size(); ++row)
      hold(row, last, usual_.usual.back());
  }

 private:
  /// NaN as what is usual: there is one reading.
  void hold(std::size_t row, std::size_t reading, double usual) {
    const double away = std::abs(recorded_[row] - recorded_[reading]);
    if (!RowSpacing::lost_within(away, usual)) values_[row] = values_[reading];
  }

  std::vector<double>& values_;
  const std::vector<double>&time_, &recorded_;
  std::vector<std::size_t> read_;
  RowSpacing usual_;
};

}  // namespace

std::vector<FollowedColumn> followed_columns() {
  std::vector<FollowedColumn> all;
  for (const CovariateSpec& c : known_covariates)
    for (std::size_t k = 0; k < c.components(); ++k)
      all.push_back({std::string(c.column(k).view()), c.set()});
  for (std::size_t k = 0; k < own_terms().covariates.size(); ++k)
    all.push_back({own_terms().covariates[k], further_column(k)});
  return all;
}

std::vector<ColumnGaps> bridge_covariates(Recording& recording,
                                          const std::vector<double>& planned) {
  std::vector<ColumnGaps> all;
  std::vector<double> lengths, recorded;
  for (FollowedColumn& column : followed_columns()) {
    const auto c = std::ranges::find(recording.channels, column.name, &Channel::name);
    if (c == recording.channels.end()) continue;
    std::vector<double>& values = c->values;
    const auto missing = [&](std::size_t row) { return !std::isfinite(values[row]); };
    ColumnGaps gaps{std::move(column), 0, values.size()};
    if (lengths.empty()) {
      lengths = lengths_of_rows(recording, planned);
      double sum = 0.0;
      for (const double length : lengths) recorded.push_back(sum += length);
    }
    double stretch = 0.0;
    std::size_t begins = 0;
    for (std::size_t row = 0; row < values.size(); ++row) {
      if (!missing(row)) {
        stretch = 0.0;
        continue;
      }
      if (row == 0 || !missing(row - 1)) begins = row;
      ++gaps.rows;
      gaps.seconds += lengths[row];
      stretch += lengths[row];
      if (stretch > gaps.longest || gaps.rows == 1) {
        gaps.longest = stretch;
        gaps.line = recording.lines[begins];
      }
    }
    if (gaps.rows == 0) continue;
    Bridge bridge(values, recording.find("time")->values, recorded);
    if (!bridge.has_readings()) continue;
    bridge.close();
    for (std::size_t row = 0; row < values.size(); ++row) gaps.unknown += missing(row) ? 1 : 0;
    all.push_back(std::move(gaps));
  }
  return all;
}

}  // namespace drift::preparation
