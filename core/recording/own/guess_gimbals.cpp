#include "core/recording/own/guess_gimbals.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/recording/gimbal_chain.hpp"
#include "core/recording/own/csv_cells.hpp"
#include "core/recording/own/guess_names.hpp"
#include "core/recording/own/guess_values.hpp"
#include "core/recording/own/recording_unit.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/sexagesimal.hpp"

namespace drift {
namespace {

/// Parts of the range of a gimbal, between two rows.
constexpr double stands_below = 0.01, turned_beyond = 0.1;
constexpr std::size_t most_kept = 64;
constexpr std::size_t fewest = 4;  // sights: fewer fit several units

std::optional<std::array<std::size_t, 3>> columns_of(const GuessedFile& file,
                                                     const ChannelTriple& channels) {
  std::array<std::size_t, 3> columns{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto it = std::ranges::find(file.columns, channels.names[a], &GuessedColumn::channel);
    if (it == file.columns.end()) return std::nullopt;
    columns[a] = static_cast<std::size_t>(it - file.columns.begin());
  }
  return columns;
}

Vec3 vector_of(const std::vector<double>& row, const std::array<std::size_t, 3>& columns) {
  return {row[columns[0]], row[columns[1]], row[columns[2]]};
}

/// One number in all three is what a logger writes that has read nothing, or 0, the same in all
/// units.
bool tells_nothing(const Vec3& angles) {
  return angles[0] == angles[1] && angles[0] == angles[2];
}

}  // namespace

GuessGimbalUnit::GuessGimbalUnit(const GuessedFile& file) {
  gimbals_ = columns_of(file, gimbal_channels);
  if (!gimbals_) return;
  for (const std::size_t i : *gimbals_)
    if (file.columns[i].header.unit || stated_unit(file.columns[i])) gimbals_.reset();
  low_.fill(HUGE_VAL);
  high_.fill(-HUGE_VAL);
}

std::vector<double> GuessGimbalUnit::numbers_of(const std::vector<std::string_view>& cells) const {
  std::vector<double> row;
  for (const auto cell : cells) row.push_back(cell_number(cell));
  return row;
}

double GuessGimbalUnit::apart(const std::vector<double>& a, const std::vector<double>& b) const {
  double most = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
    if (high_[k] > low_[k])
      most = std::max(most, std::abs(a[(*gimbals_)[k]] - b[(*gimbals_)[k]]) / (high_[k] - low_[k]));
  return most;
}

void GuessGimbalUnit::look_at_row(const std::vector<std::string_view>& cells) {
  if (!gimbals_ || kept_.size() == most_kept) return;
  std::vector<double> row = numbers_of(cells);
  const Vec3 angles = vector_of(row, *gimbals_);
  if (!angles.allFinite() || tells_nothing(angles)) return;
  for (std::size_t k = 0; k < 3; ++k) {
    low_[k] = std::min(low_[k], row[(*gimbals_)[k]]);
    high_[k] = std::max(high_[k], row[(*gimbals_)[k]]);
  }
  const bool stood = !before_.empty() && apart(before_, row) < stands_below;
  if (stood && (kept_.empty() || apart(kept_.back(), row) > turned_beyond)) kept_.push_back(row);
  before_ = std::move(row);
}

std::string GuessGimbalUnit::unit(const GuessedFile& file) const {
  const auto acc = columns_of(file, accelerometer_channels);
  if (!gimbals_ || !acc) return "";
  for (const std::size_t i : *acc)
    if (file.columns[i].unit != file.columns[(*acc)[0]].unit) return "";
  std::vector<std::pair<double, std::string>> worst;  // angle between the two Ups [rad]
  for (const char* const symbol : {"deg", "rad", "gon", "mrad", "arcmin", "arcsec", "turn"}) {
    const double to_si = parse_recording_unit(symbol)->to_si;
    double most = 0.0;
    std::size_t sights = 0;
    for (const std::vector<double>& row : kept_) {
      const Vec3 force = vector_of(row, *acc);
      if (!force.allFinite() || force.isZero()) continue;
      const Vec3 up = gimbal_chain(to_si * vector_of(row, *gimbals_)).row(2);
      most = std::max(most, std::atan2(force.cross(up).norm(), force.dot(up)));
      ++sights;
    }
    if (sights >= fewest) worst.emplace_back(most, symbol);
  }
  if (worst.empty()) return "";
  std::ranges::sort(worst);
  const bool one = worst[0].first < GuessLimits::one_up && worst[0].first < 0.5 * worst[1].first;
  return one ? worst[0].second : "";
}

GuessAngleDigits::GuessAngleDigits(const GuessedFile& file) {
  for (std::size_t i = 0; i < file.columns.size(); ++i)
    if (file.columns[i].channel.starts_with("gimbal_")) gimbals_.push_back({i, {}});
}

void GuessAngleDigits::look_at_row(const std::vector<std::string_view>& cells) {
  for (auto& [column, numbers] : gimbals_) numbers.push_back(cell_number(cells[column]));
}

AngleDigits GuessAngleDigits::found(const GuessedFile& file) const {
  MinutesAndSeconds digits;
  for (const auto& [column, numbers] : gimbals_) {
    const GuessedColumn& c = file.columns[column];
    const auto unit = parse_recording_unit(c.unit);
    if (unit && same_unit(*unit, unit::deg)) digits.look_at(numbers);
  }
  return digits.text().empty() ? AngleDigits::automatic : AngleDigits::minutes_and_seconds;
}

void name_third_gimbal(GuessedFile& file) {
  std::string_view missing;
  std::size_t named = 0;
  for (const std::string_view channel : gimbal_channels.names)
    if (std::ranges::find(file.columns, channel, &GuessedColumn::channel) != file.columns.end())
      ++named;
    else
      missing = channel;
  if (named != 2) return;
  for (GuessedColumn& c : file.columns)
    if (c.channel.empty() && may_be_gimbal(c.header.name, missing) &&
        may_measure(c.header, missing)) {
      c.channel = missing;
      return;
    }
}

}  // namespace drift
