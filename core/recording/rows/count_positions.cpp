#include "core/recording/rows/count_positions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "core/recording/gimbal_chain.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/turned_rows.hpp"
#include "core/stats/median.hpp"

namespace drift {
namespace {

/// Rows first..last.
struct Rows {
  std::size_t first = 0, last = 0;
  std::size_t count() const { return last - first + 1; }
};

/// What moves between rows.
class Motion {
 public:
  explicit Motion(const Recording& r)
      : r_(r),
        time_(r.find("time")->values),
        phase_(r.find("phase")),
        heading_(r.find("case_heading")) {
    std::vector<double> turns, steps;
    for (std::size_t k = 1; k < r.rows(); ++k) {
      steps.push_back(time_[k] - time_[k - 1]);
      if (const auto turn = turned(k - 1, k); turn && !commanded(k)) turns.push_back(*turn);
    }
    if (turns.empty()) return;
    const auto low = turns.begin() + static_cast<std::ptrdiff_t>(turns.size() / 5);
    std::ranges::nth_element(turns, low);
    usual_turn_ = *low;
    usual_step_ = stats::median(steps);
  }

  bool shown() const {
    for (std::size_t k = 0; k < r_.rows(); ++k)
      if (reads(k)) return true;
    return false;
  }
  bool reads(std::size_t row) const {
    return measured(r_, gimbal_channels, row) || measured(r_, accelerometer_channels, row);
  }
  /// Whether the interval of a row is one of a slew, as far as commands and phases tell.
  bool commanded(std::size_t row) const {
    if (phase_ != nullptr) return phase_->values[row] == 1.0;
    const auto command = measured(r_, command_channels, row);
    return command && command->norm() > CountLimits::slew;
  }
  /// By what the case turns from a row to a later one, whole turns counted [rad].
  double of_case(std::size_t from, std::size_t to) const {
    if (heading_ == nullptr) return 0.0;
    double sum = 0.0;
    for (std::size_t before = from, k = from + 1; k <= to; ++k) {
      const double turn = heading_->values[k] - heading_->values[before];
      if (std::isfinite(turn)) sum += std::remainder(turn, whole_turn);
      if (std::isfinite(heading_->values[k])) before = k;
    }
    return std::abs(sum);
  }
  /// By what the platform turns against the case, or Up on it where a gimbal is not read [rad].
  std::optional<double> turned(std::size_t from, std::size_t to) const {
    const auto angles = [&](std::size_t row) { return measured(r_, gimbal_channels, row); };
    const auto force = [&](std::size_t row) { return measured(r_, accelerometer_channels, row); };
    if (const auto a = angles(from), b = angles(to); a && b)
      return rotation_vector(gimbal_chain(*a).transpose() * gimbal_chain(*b)).norm();
    if (const auto a = force(from), b = force(to); a && b)
      return std::atan2(a->cross(*b).norm(), a->dot(*b));
    return std::nullopt;
  }
  /// Whether platform or case do not stand from a row to a later one.
  bool moves(std::size_t from, std::size_t to) const {
    const double steps = std::max(1.0, (time_[to] - time_[from]) / usual_step_);
    const double still = CountLimits::still + CountLimits::usual * usual_turn_ * steps;
    return std::max(turned(from, to).value_or(0.0), of_case(from, to)) > still;
  }
  /// Whether they are elsewhere in a row than in an earlier one.
  bool elsewhere(std::size_t from, std::size_t to) const {
    return std::max(turned(from, to).value_or(0.0), of_case(from, to)) > allowed(from, to);
  }
  /// Whether the platform turns, and not only the case below it.
  bool of_platform(std::size_t from, std::size_t to) const {
    const double turn = turned(from, to).value_or(0.0);
    const bool gimbals = measured(r_, gimbal_channels, from) && measured(r_, gimbal_channels, to);
    // Angles do not tell whole turns of the case.
    const double with_case =
        gimbals ? std::abs(std::remainder(of_case(from, to), whole_turn)) : 0.0;
    return turn > with_case + allowed(from, to);
  }

 private:
  static constexpr double whole_turn = 2.0 * std::numbers::pi;
  /// By what a platform that stands may be elsewhere in a later row [rad].
  double allowed(std::size_t from, std::size_t to) const {
    return CountLimits::turn + CountLimits::drift * (time_[to] - time_[from]);
  }

  const Recording& r_;
  const std::vector<double>& time_;
  const Channel *phase_, *heading_;
  double usual_turn_ = 0.0, usual_step_ = 1.0;  ///< from row to row [rad], [s]: of one that stands
};

/// Stretches of rows in whose intervals something is turned, in order.
std::vector<Rows> turns_of(const Motion& motion, std::size_t rows) {
  std::vector<Rows> all;
  std::size_t read = 0;  // the last row with readings
  for (std::size_t k = 1; k < rows; ++k) {
    if (!motion.reads(k) && !motion.commanded(k)) continue;
    if (motion.commanded(k) || motion.moves(read, k)) {
      const std::size_t first = motion.commanded(k) ? k : read + 1;
      if (!all.empty() && all.back().last + 1 >= first)
        all.back().last = k;
      else
        all.push_back({first, k});
    }
    if (motion.reads(k)) read = k;
  }
  // The row after a slew stands; the mean over the one before was on the way.
  for (Rows& t : all)
    while (t.last > t.first && motion.commanded(t.last - 1) && !motion.commanded(t.last) &&
           motion.of_case(t.last - 1, t.last) < CountLimits::turn)
      --t.last;
  // What is where it was, unbidden, was not turned: a reading that is none, or a disturbance.
  std::erase_if(all, [&](const Rows& t) {
    return !motion.commanded(t.first) && !motion.commanded(t.last) &&
           !motion.elsewhere(t.first - 1, t.last);
  });
  return all;
}

/// How a turn is made.
enum class By { command, case_alone, hand };

By made_by(const Motion& motion, const Rows& t) {
  for (std::size_t k = t.first; k <= t.last; ++k)
    if (motion.commanded(k)) return By::command;
  const bool case_alone = motion.of_case(t.first - 1, t.last) > CountLimits::turn &&
                          !motion.of_platform(t.first - 1, t.last);
  return case_alone ? By::case_alone : By::hand;
}

/// What becomes of the rows.
struct Counted {
  std::vector<double> position, slew;
  std::vector<bool> out, arrives;   ///< arrives: at the end of a turn by hand
  std::vector<std::size_t> begins;  ///< lines
  std::size_t left_out = 0;
};

std::string count(const Recording& r, const Motion& motion, Counted& c) {
  const std::size_t rows = r.rows();
  c = {std::vector<double>(rows, 1.0),
       std::vector<double>(rows, 0.0),
       std::vector<bool>(rows, false),
       std::vector<bool>(rows, false),
       {},
       0};
  std::size_t stands_from = 0;
  const auto leave_out = [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) c.out[k] = true;
    c.left_out += to - from;
  };
  const auto stand = [&](std::size_t end) {
    c.begins.push_back(r.lines[stands_from]);
    for (std::size_t k = stands_from; k < end; ++k)
      c.position[k] = static_cast<double>(c.begins.size());
  };
  const auto too_short = [&](std::size_t end) {
    return fmt::format("from line {} on it stands for {} row{} alone",
                       r.lines[std::min(stands_from, rows - 1)], end - stands_from,
                       end - stands_from == 1 ? "" : "s");
  };
  for (const Rows& t : turns_of(motion, rows)) {
    const By by = made_by(motion, t);
    const bool shorter = t.first - stands_from < CountLimits::fewest_rows;
    // A log that begins while it is turned yet has no position there.
    if (shorter && (!c.begins.empty() || by != By::hand)) return too_short(t.first);
    if (by == By::case_alone && t.count() >= t.first - stands_from)
      return fmt::format(
          "from line {} on the case turns in {} rows, no fewer than it stood before: "
          "that may be a position of its own",
          r.lines[t.first], t.count());
    if (shorter)
      leave_out(stands_from, t.first);
    else
      stand(t.first);
    for (std::size_t k = t.first; by != By::hand && k <= t.last; ++k) {
      c.position[k] = static_cast<double>(c.begins.size() + 1);
      c.slew[k] = 1.0;
    }
    // It arrives in the last row, whose readings of the end are good. Where that is the only one,
    // it was caged anew between two rows.
    if (by == By::hand) leave_out(t.first, t.last);
    c.arrives[t.last] = by == By::hand && t.count() > 1;
    stands_from = by == By::hand ? t.last : t.last + 1;
  }
  if (rows - stands_from >= CountLimits::fewest_rows)
    stand(rows);
  else if (c.slew[stands_from == 0 ? 0 : stands_from - 1] == 1.0 || c.begins.empty())
    return too_short(rows);
  else
    leave_out(stands_from, rows);
  return "";
}

std::string remark(const Counted& c, bool commands) {
  constexpr std::size_t most = 12;
  const std::size_t count = c.begins.size();
  std::vector<std::size_t> begins(
      c.begins.begin(), c.begins.begin() + static_cast<std::ptrdiff_t>(std::min(most, count)));
  std::string text = fmt::format(
      "no column tells the positions: {} counted, where the platform stands between turns, from "
      "line{} {}{} on, and taken for those of the plan, in order",
      count == 1 ? "1 is" : fmt::format("{} are", count), count == 1 ? "" : "s",
      fmt::join(begins, ", "), count > most ? fmt::format(" and {} more", count - most) : "");
  if (c.left_out > 0)
    text += fmt::format("; {} row{} in which it is turned, and by no command, {} left out",
                        c.left_out, c.left_out == 1 ? "" : "s", c.left_out == 1 ? "is" : "are");
  if (c.left_out > 0 && !commands) text += " (if commands turned it, record cmd_x, cmd_y, cmd_z)";
  return text;
}

}  // namespace

std::string count_positions(Recording& r) {
  const Channel* time = r.find("time");
  if (r.find("position") != nullptr || time == nullptr || r.rows() == 0 ||
      !std::ranges::is_sorted(time->values))
    return "";
  const Motion motion(r);
  if (!motion.shown()) return "neither all gimbals nor all accelerometers show when it was turned";
  Counted c;
  if (std::string why = count(r, motion, c); !why.empty()) return why;
  const bool commands = r.find("cmd_x") != nullptr;
  r.remarks.add(Weight::doubtful, remark(c, commands));
  r.facts.emplace_back(positions_counted, fmt::format("{}", c.begins.size()));
  for (Channel& channel : r.channels)
    for (std::size_t k = 0; channel.name.starts_with("acc_") && k < r.rows(); ++k)
      if (c.arrives[k]) channel.values[k] = nan_value;  // the mean is of the turn, too
  r.channels.push_back({"position", unit::one, std::move(c.position)});
  if (std::ranges::find(c.slew, 1.0) != c.slew.end() && r.find("phase") == nullptr)
    r.channels.push_back({"phase", unit::one, std::move(c.slew)});
  leave_out_rows(r, c.out);
  return "";
}

}  // namespace drift
