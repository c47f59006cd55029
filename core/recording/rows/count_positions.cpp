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

namespace drift {
namespace {

/// Rows first..last.
struct Rows {
  std::size_t first = 0, last = 0;
  std::size_t count() const { return last - first + 1; }
};

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// What moves from row to row.
class Motion {
 public:
  explicit Motion(const Recording& r)
      : r_(r),
        time_(r.find("time")->values),
        phase_(r.find("phase")),
        heading_(r.find("case_heading")) {}

  bool shown() const {
    for (std::size_t k = 0; k < r_.rows(); ++k)
      if (measured(r_, gimbal_channels, k) || measured(r_, accelerometer_channels, k)) return true;
    return false;
  }
  /// Whether the interval of a row is one of a slew, as far as commands and phases tell.
  bool commanded(std::size_t row) const {
    if (phase_ != nullptr) return phase_->values[row] == 1.0;
    const auto command = measured(r_, command_channels, row);
    return command && command->norm() > CountLimits::slew;
  }
  /// By what the case turns from a row to a later one [rad].
  double of_case(std::size_t from, std::size_t to) const {
    if (heading_ == nullptr) return 0.0;
    const double turn = heading_->values[to] - heading_->values[from];
    return std::isfinite(turn) ? std::abs(std::remainder(turn, 2.0 * std::numbers::pi)) : 0.0;
  }
  /// Whether platform or case are elsewhere in a row than in an earlier one. Accelerometers, which
  /// read the mean over a row, are asked where gimbals are not there.
  bool apart(std::size_t from, std::size_t to) const {
    double turn = of_case(from, to);
    const auto both = [&](const ChannelTriple& channels, auto&& angle) {
      const auto a = measured(r_, channels, from), b = measured(r_, channels, to);
      if (a && b) turn = std::max(turn, angle(*a, *b));
      return a && b;
    };
    if (!both(gimbal_channels, [](const Vec3& a, const Vec3& b) {
          return rotation_vector(gimbal_chain(a).transpose() * gimbal_chain(b)).norm();
        }))
      both(accelerometer_channels, angle_between);
    return turn > CountLimits::turn + CountLimits::drift * (time_[to] - time_[from]);
  }

 private:
  const Recording& r_;
  const std::vector<double>& time_;
  const Channel *phase_, *heading_;
};

/// Stretches of rows in whose intervals something is turned, in order.
std::vector<Rows> turns_of(const Motion& motion, std::size_t rows) {
  std::vector<Rows> all;
  for (std::size_t k = 1; k < rows; ++k) {
    if (!motion.commanded(k) && !motion.apart(k - 1, k)) continue;
    if (!all.empty() && all.back().last + 1 == k)
      all.back().last = k;
    else
      all.push_back({k, k});
  }
  // The row after a slew stands; the mean over the one before was on the way.
  for (Rows& t : all)
    while (t.last > t.first && motion.commanded(t.last - 1) && !motion.commanded(t.last) &&
           motion.of_case(t.last - 1, t.last) < CountLimits::turn)
      --t.last;
  // What is where it was, unbidden, was not turned: a reading that is none.
  std::erase_if(all, [&](const Rows& t) {
    return !motion.commanded(t.first) && !motion.commanded(t.last) &&
           !motion.apart(t.first - 1, t.last);
  });
  return all;
}

/// Whether a turn may be a dwell in which the case turns: unbidden, and no shorter than the stand
/// before it. It is said of the first.
std::string turning_dwell(const Motion& motion, const Recording& r, const Rows& t,
                          std::size_t stands_from) {
  for (std::size_t k = t.first; k <= t.last; ++k)
    if (motion.commanded(k)) return "";
  if (t.count() < t.first - stands_from || motion.of_case(t.first - 1, t.first) == 0.0) return "";
  return fmt::format(
      "from line {} on the case turns in {} rows, which may be a position of its own",
      r.lines[t.first], t.count());
}

/// How a turn is made.
enum class By { jump, command, hand };

By made_by(const Motion& motion, const Rows& t) {
  for (std::size_t k = t.first; k <= t.last; ++k)
    if (motion.commanded(k)) return By::command;
  // Caged anew from one row to the next: the interval of the second begins there.
  if (t.count() == 1) return By::jump;
  return motion.of_case(t.first - 1, t.last) > CountLimits::turn ? By::command : By::hand;
}

/// Leaves out rows.
void remove(Recording& r, const std::vector<bool>& out) {
  const auto without = [&](auto& values) {
    std::size_t k = 0;
    std::erase_if(values, [&](const auto&) { return out[k++]; });
  };
  for (Channel& c : r.channels) without(c.values);
  without(r.lines);
}

}  // namespace

std::string count_positions(Recording& r) {
  const Channel* time = r.find("time");
  if (r.find("position") != nullptr || time == nullptr || r.rows() == 0 ||
      !std::ranges::is_sorted(time->values))
    return "";
  const Motion motion(r);
  if (!motion.shown()) return "neither all gimbals nor all accelerometers show when it was turned";
  const std::vector<Rows> turns = turns_of(motion, r.rows());
  std::vector<double> position(r.rows(), 1.0), slew(r.rows(), 0.0);
  std::vector<bool> out(r.rows(), false);
  std::vector<std::size_t> begins{r.lines.front()};
  std::size_t stands_from = 0, left_out = 0;
  const auto too_short = [&](std::size_t end) -> std::optional<std::string> {
    if (end - stands_from >= CountLimits::fewest_rows) return std::nullopt;
    return fmt::format("from line {} on it stands for {} row{} alone", r.lines[stands_from],
                       end - stands_from, end - stands_from == 1 ? "" : "s");
  };
  for (const Rows& t : turns) {
    if (const auto why = too_short(t.first)) return *why;
    if (const std::string why = turning_dwell(motion, r, t, stands_from); !why.empty()) return why;
    const By by = made_by(motion, t);
    begins.push_back(r.lines[t.first]);
    std::fill(position.begin() + static_cast<std::ptrdiff_t>(t.first), position.end(),
              static_cast<double>(begins.size()));
    stands_from = by == By::jump ? t.first : t.last + 1;
    for (std::size_t k = t.first; k < stands_from; ++k) {
      slew[k] = by == By::command ? 1.0 : 0.0;
      out[k] = by == By::hand;
      left_out += by == By::hand;
    }
  }
  if (const auto why = too_short(r.rows())) return *why;
  const bool slewed = std::ranges::find(slew, 1.0) != slew.end();
  r.channels.push_back({"position", unit::one, std::move(position)});
  if (slewed && r.find("phase") == nullptr)
    r.channels.push_back({"phase", unit::one, std::move(slew)});
  remove(r, out);
  r.counted_positions = begins.size();
  constexpr std::size_t most = 12;
  const std::string more =
      begins.size() > most ? fmt::format(" and {} more", begins.size() - most) : "";
  const std::size_t count = begins.size();
  begins.resize(std::min(most, count));
  r.remarks.add(
      Weight::doubtful,
      fmt::format(
          "{}: no column tells the positions. {} counted, where it stands between turns, from "
          "line{} "
          "{}{} on: taken for those of the plan, in order{}",
          r.source.empty() ? "the recording" : r.source,
          count == 1 ? "One is" : fmt::format("{} are", count), count == 1 ? "" : "s",
          fmt::join(begins, ", "), more,
          left_out == 0
              ? ""
              : fmt::format("; {} rows in which it is turned, and by no command, are left out",
                            left_out)));
  return "";
}

}  // namespace drift
