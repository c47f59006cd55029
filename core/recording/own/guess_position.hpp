#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/recording/own/guess.hpp"

namespace drift {

/// By what a column of numbers is taken for that of the positions (look, new).
struct PositionLimits {
  static constexpr std::size_t fewest_changes = 2, most_changes = 1000;
  static constexpr std::size_t fewest_rows = 4;  ///< of a position
  /// Labels that are no numbers 1, 2, 3, ... are listed one by one up to this.
  static constexpr std::size_t most_labels = 100;
  /// Numbers up to so many times as many as there are may be those of a longer plan.
  static constexpr double most_left_out = 4.0;
  /// Part of the widest range of accelerometers (or gimbals) that is a turn, and that none makes
  /// within a position: positions are 45 deg and more apart, a dwell drifts by some. Tuned.
  static constexpr double turn = 0.1;
};

/// Finds the numbers of positions under a name that says nothing: whole numbers without a unit,
/// each in one stretch of rows, in all of which the accelerometers (or else the gimbals) stand and
/// between most of which they or the gimbals turn. A clock of hours is not that, nor a counter.
class GuessPosition {
 public:
  /// The columns with the channels that names gave them. A column that is called the position's is
  /// the only candidate: then its numbers are listed where a plan cannot have them.
  explicit GuessPosition(const GuessedFile& file);

  void look_at_row(const std::vector<std::string_view>& cells);
  /// Names the channel, if one column alone is so and no other is the position's.
  void name_channel(GuessedFile& file) const;

 private:
  /// Rows with one label, and all their cells in its second quarter and in its second half.
  struct Stretch {
    std::string label;
    std::size_t rows = 0;
    std::vector<double> early, late;
  };
  struct Candidate {
    std::size_t column = 0;
    std::vector<Stretch> stretches;
    std::set<double> labels;
    bool may_be = true;
    bool turned = false;  ///< the row before is of no position
  };

  static bool begin(Candidate& candidate, std::string_view label);
  static bool says_turned(Candidate& candidate, double number);
  static bool is_position(const Candidate& candidate, const GuessedFile& file);

  /// The numbers of the stretches, where they are not those that a plan has.
  static std::vector<std::string> own_labels(const Candidate& candidate);

  std::vector<Candidate> candidates_;
  bool named_ = false;  ///< the candidate's name says what it is
};

}  // namespace drift
