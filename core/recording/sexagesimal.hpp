#pragma once

#include <bitset>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drift {

/// The angle [deg] of a text in degrees, minutes and seconds: "-89°57'40.7\"", "-89:57:40.7",
/// "-89 57 40.7"; with the mark of degrees, minutes alone, too: "45°30.25'". Empty if it is none.
std::optional<double> angle_in_minutes_and_seconds(std::string_view text);

/// The angle [deg] of a number that holds degrees, minutes and seconds: 45.504167 of 45.3015. NaN
/// where its minutes or seconds are 60 or more.
double angle_from_minutes_and_seconds(double number);

/// Whether angles in decimal degrees are degrees, minutes and seconds in one number (45.3015 for
/// 45 deg 30' 15"), which shows by what does not stand there: no first or second pair of decimals
/// is 60 or more.
class MinutesAndSeconds {
 public:
  /// The numbers of one more column, in the order of the rows.
  void look_at(const std::vector<double>& degrees);

  /// The chance that decimal degrees look so by accident; 1 if they do not look so.
  ///
  /// Counted are the second pairs that differ, 00 left out, for a coarse readout repeats its own:
  /// the first one in a hundredth of a degree that its column comes to for the first time, for one
  /// that is held there shows those beside it; and all in a hundredth that it passes through on the
  /// way from one neighbour to the other, for steps below 0.4 of it would show one from 60 on. That
  /// so many of 99 are all among the 59 below 60 has the chance of a draw without replacement.
  double chance() const;

  /// What is wrong, and what to do; empty above a chance of five sigmas.
  std::string text() const;

 private:
  static constexpr std::size_t most_pairs = 100;
  bool may_be_ = true;
  std::size_t numbers_ = 0;
  std::bitset<most_pairs> seconds_;
};

}  // namespace drift
