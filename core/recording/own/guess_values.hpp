#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/units.hpp"
#include "core/recording/own/guess.hpp"

namespace drift {

/// By what values a column is guessed whose name says nothing (look, new).
struct GuessLimits {
  /// [m/s^2] Gravity on Earth, from the summit of Huascaran to the Arctic Ocean.
  static constexpr double gravity_low = 9.764, gravity_high = 9.834;
  /// Part by which accelerometers that were not calibrated may be longer or shorter than gravity:
  /// scale factors to 1 %, and 5 mg of bias.
  static constexpr double scale_room = 0.015;
  /// Share of the rows that must be so. Slews and knocks take the rest. Tuned.
  static constexpr double most_rows = 0.75;
  /// [rad] within which an angle is held in a position, as a turntable does: 1 arcmin. A platform
  /// in free drift has that after 4 s, one that is level is off by more than that from row to row
  /// only where its gimbals are noisy: then it is not told apart.
  static constexpr double held = 2.9e-4;
  /// [rad] within which two instruments show one Up, as where a recording is compared with its
  /// plan.
  static constexpr double one_up = 0.175;
};

/// The unit that the file gives a column, in the header or by the ending of its name, if it is one.
std::optional<Unit> stated_unit(const GuessedColumn& column);

/// Whether numbers in a unit may be those of a channel: accelerations in m/s^2 are divided by
/// gravity, and gained over each sample (kind = "increments") they are velocities, rates are
/// angles.
bool measures(const Unit& unit, std::string_view channel);

/// Whether a column may be a channel by the unit that its header states: one of another dimension
/// is not. Without one, or with one that is not known, it may.
bool may_measure(const HeaderCell& header, std::string_view channel);

/// Finds accelerometers and the heading of the case among columns that no name tells: three whose
/// length is 1 g while they change, and one angle that changes only from position to position
/// while the gimbals move.
class GuessByValues {
 public:
  /// The columns with the channels that names gave them.
  explicit GuessByValues(const GuessedFile& file);

  void look_at_row(const std::vector<std::string_view>& cells);
  /// Names the channels; the unit of the accelerometers by their size comes back, "" if none are
  /// found, or if they are not in one unit: then each column has its own.
  std::string name_channels(GuessedFile& file);

 private:
  struct Triple {
    std::array<std::size_t, 3> columns{};
    std::size_t rows = 0;
    /// Rows whose length is 1 g in each choice of a unit for every column: first + 4 second + 16
    /// third.
    std::array<std::size_t, 64> as_units{};
    std::array<bool, 3> whole{true, true, true};
  };
  /// An angle, and how far it moves within positions.
  struct Angle {
    std::size_t column = 0;
    double to_rad = 1.0;
    double low = 0.0, high = 0.0;  ///< in this position [rad]
    double farthest = 0.0;         ///< within any position [rad]
    std::size_t rows = 0, missing = 0;
  };

  void begin_position();
  /// The units of its columns that make its length 1 g; empty if none do, or several.
  std::vector<std::string> units_of(const GuessedFile& file, const Triple& t) const;
  bool likely(const GuessedFile& file, const Triple& t) const;
  /// The axes of a triple in the order of its columns: as their names end, else x, y, z.
  static std::string axes_of(const GuessedFile& file, const Triple& t);

  std::vector<Triple> triples_;
  std::vector<Triple> named_;  ///< accelerometers by their names, without a unit for each; or none
  std::vector<Angle> angles_;  ///< that have no name yet
  std::vector<Angle> gimbals_;
  std::size_t position_ = 0;  ///< column
  bool has_position_ = false;
  std::string here_;  ///< text of the position
  std::size_t positions_ = 0;
};

}  // namespace drift
