#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/recording/own/guess.hpp"

namespace drift {

/// The unit of gimbal angles that say none: accelerometers show Up, and only in one unit do the
/// gimbals show the same Up wherever the platform stood.
class GuessGimbalUnit {
 public:
  /// The columns with the channels that names gave them.
  explicit GuessGimbalUnit(const GuessedFile& file);

  void look_at_row(const std::vector<std::string_view>& cells);
  /// "deg", "gon", ...; empty where the gimbals say their unit, the accelerometers are not known or
  /// in different units, or no unit, or several, make the two one.
  std::string unit(const GuessedFile& file) const;

 private:
  std::vector<double> numbers_of(const std::vector<std::string_view>& cells) const;
  /// The largest difference of the gimbals between two rows, as a part of their range.
  double apart(const std::vector<double>& a, const std::vector<double>& b) const;

  std::optional<std::array<std::size_t, 3>> gimbals_;
  std::array<double, 3> low_{}, high_{};
  std::vector<double> before_;
  std::vector<std::vector<double>> kept_;  ///< all cells of rows at which the platform stood
};

/// Whether the digits of gimbal angles in degrees are minutes and seconds.
class GuessAngleDigits {
 public:
  /// The columns with the channels that names gave them.
  explicit GuessAngleDigits(const GuessedFile& file);

  void look_at_row(const std::vector<std::string_view>& cells);
  AngleDigits found(const GuessedFile& file) const;

 private:
  std::vector<std::pair<std::size_t, std::vector<double>>> gimbals_;  ///< column, numbers
};

/// Where two gimbals are named, the third may be called by a short word ("Mid").
void name_third_gimbal(GuessedFile& file);

}  // namespace drift
