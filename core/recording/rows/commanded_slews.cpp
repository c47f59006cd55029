#include "core/recording/rows/commanded_slews.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/recording/gimbal_chain.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/count_positions.hpp"

namespace drift {
namespace {

/// Rows [first, end) of one slew.
struct CommandedRows {
  std::size_t first = 0, end = 0;
};

class CommandedSlews {
 public:
  explicit CommandedSlews(Recording& r)
      : r_(r),
        position_(std::ranges::find(r.channels, "position", &Channel::name)->values),
        time_(r.find("time")->values),
        heading_(r.find("case_heading")),
        slews_(r.rows(), 0.0) {}

  void take() {
    const std::vector<CommandedRows> all = stretches();
    for (std::size_t k = 0; k < all.size(); ++k)
      take(all[k], k > 0 ? all[k - 1].end : 0, k + 1 < all.size() ? all[k + 1].first : r_.rows());
    if (taken_ == 0) return;
    r_.channels.push_back({"phase", unit::one, std::move(slews_)});
    std::string text = fmt::format(
        "no column `phase`: {} rows beside a change of the position, in which commands turn the "
        "platform, are taken as the way to the next",
        taken_);
    if (renumbered_ > 0) text += fmt::format("; {} of them had the number before", renumbered_);
    r_.remarks.add(Weight::doubtful, text);
  }

 private:
  double command(std::size_t row) const {
    const auto rate = measured(r_, command_channels, row);
    return rate ? rate->norm() : 0.0;
  }
  bool case_turns(std::size_t row) const {
    if (heading_ == nullptr || row == 0 || row >= r_.rows()) return false;
    const double turn = heading_->values[row] - heading_->values[row - 1];
    return std::abs(std::remainder(turn, 2.0 * std::numbers::pi)) > CountLimits::still;
  }
  /// Rows that commands turn, in order, each with those beside it in which the case turns.
  std::vector<CommandedRows> stretches() const {
    std::vector<CommandedRows> all;
    for (std::size_t k = 0; k < r_.rows(); ++k) {
      if (command(k) <= CountLimits::slew) continue;
      if (all.empty() || all.back().end + CountLimits::fewest_rows <= k) all.push_back({k, k});
      all.back().end = k + 1;
    }
    for (CommandedRows& s : all) {
      while (s.first > 1 && case_turns(s.first - 1)) --s.first;
      while (case_turns(s.end)) ++s.end;
    }
    return all;
  }
  /// Whether the gimbals show another attitude than in the row before, by more than these rows do.
  bool elsewhere(const CommandedRows& s, std::size_t row) const {
    const auto from = measured(r_, gimbal_channels, row - 1),
               to = measured(r_, gimbal_channels, row);
    if (!from || !to) return false;
    const double lasts = time_[row] - time_[row - 1];
    double most = CountLimits::drift;
    for (std::size_t k = s.first; k < s.end; ++k) most = std::max(most, command(k));
    const double turned =
        rotation_vector(gimbal_chain(*from).transpose() * gimbal_chain(*to)).norm();
    return turned > CountLimits::turn + (most + CountLimits::drift) * lasts && !case_turns(row);
  }
  /// before, behind: where the dwells around it begin and end.
  void take(const CommandedRows& s, std::size_t before, std::size_t behind) {
    constexpr std::size_t fewest = CountLimits::fewest_rows;
    if (s.first < before + fewest || s.end + fewest > behind) return;
    std::vector<std::size_t> changes;
    for (std::size_t k = s.first + 1 - fewest; k < s.end + fewest; ++k)
      if (position_[k] != position_[k - 1]) changes.push_back(k);
    if (changes.size() != 1 || elsewhere(s, s.first) || elsewhere(s, s.end)) return;
    const std::size_t change = changes.front();
    const double last = position_[change - 1], next = position_[change];
    for (std::size_t k = std::min(change, s.first); k < std::max(change, s.end); ++k) {
      const double number = k < s.first ? last : next;
      renumbered_ += k >= s.first && k < s.end && position_[k] != number ? 1 : 0;
      position_[k] = number;
    }
    std::fill(slews_.begin() + static_cast<std::ptrdiff_t>(s.first),
              slews_.begin() + static_cast<std::ptrdiff_t>(s.end), 1.0);
    taken_ += s.end - s.first;
  }

  Recording& r_;
  std::vector<double>& position_;
  const std::vector<double>& time_;
  const Channel* heading_;
  std::vector<double> slews_;
  std::size_t taken_ = 0, renumbered_ = 0;
};

}  // namespace

void take_commanded_slews(Recording& r) {
  for (const char* name : {"time", "position", "cmd_x", "cmd_y", "cmd_z"})
    if (r.find(name) == nullptr) return;
  if (r.find("phase") != nullptr || r.rows() == 0) return;
  CommandedSlews(r).take();
}

}  // namespace drift
