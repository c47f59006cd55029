#include "core/plan/attitude/turn_at_change.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/linalg.hpp"
#include "core/physics/gimbals.hpp"
#include "core/plan/attitude_slips.hpp"
#include "core/plan/slew_check.hpp"

namespace drift {
namespace {

/// A stretch is looked at in so many places at most: an hour of rows every four seconds, in which a
/// turn of a degree in 30 s is more than `resolved`.
constexpr std::size_t looks = 1000;
/// Steps [rad] below this are no turn, however quietly the platform stands: a turn of
/// largest_mismatch has less than a hundredth outside.
constexpr double resolved = 0.01 * largest_mismatch;
/// A step so many times as long as nine of ten steps of the dwells is no noise: of one in three
/// axes 7.5 sigma, 4e-12.
constexpr double usual_part = 0.9, beyond_usual = 3.0;
/// So many looks without motion may lie between two parts of one turn.
constexpr std::size_t rest_between = 3;

/// What one kind of instrument shows.
class ShownAngles {
 public:
  ShownAngles(const Recording& recording, const ChannelTriple& channels)
      : recording_(recording), channels_(channels) {}

  bool at(std::size_t row) const { return measured(recording_, channels_, row).has_value(); }

  /// By how much it differs in two rows that were measured [rad].
  double apart(std::size_t a, std::size_t b) const {
    const Vec3 x = measured(recording_, channels_, a).value(),
               y = measured(recording_, channels_, b).value();
    if (channels_.names != gimbal_channels.names) return std::atan2(x.cross(y).norm(), x.dot(y));
    const auto between = [](const Mat3& from, const Mat3& to) {
      return rotation_vector(Mat3(from * to.transpose())).norm();
    };
    // A case that turns about a platform that stands moves the angles; a heading that is written
    // with the number, where the angles come rows later, moves the attitude.
    return std::min(
        between(gimbal_chain(x), gimbal_chain(y)),
        between(local_attitude_shown(recording_, a, x), local_attitude_shown(recording_, b, y)));
  }

  /// The rows of a stretch that are looked at: the first one measured of each `stride`.
  std::vector<std::size_t> looked_at(std::size_t first, std::size_t end, std::size_t stride) const {
    std::vector<std::size_t> rows;
    for (; first < end; first += stride)
      for (std::size_t row = first; row < std::min(end, first + stride); ++row)
        if (at(row)) {
          rows.push_back(row);
          break;
        }
    return rows;
  }

  /// What the dwell in the middle of a stretch moves by from look to look, nearly always; empty
  /// where nothing is seen of it.
  std::optional<double> usual_step(const RowStretch& s, std::size_t stride) const {
    const std::size_t quarter = s.rows() / parts_of_a_position;
    const auto rows = looked_at(s.first + quarter, s.end - quarter, stride);
    std::vector<double> steps;
    for (std::size_t k = 1; k < rows.size(); ++k) steps.push_back(apart(rows[k - 1], rows[k]));
    if (steps.empty()) return std::nullopt;
    const auto at = steps.begin() +
                    static_cast<std::ptrdiff_t>(usual_part * static_cast<double>(steps.size() - 1));
    std::ranges::nth_element(steps, at);
    return *at;
  }

 private:
  const Recording& recording_;
  const ChannelTriple& channels_;
};

/// The rows at both ends of all that moves, of which every part turns the platform; none of it does
/// if the whole does not.
std::optional<SeenTurn> moving(const ShownAngles& shown, const std::vector<std::size_t>& rows,
                               double limit) {
  std::optional<SeenTurn> turn;
  std::size_t begin = 0, end = 0;  // of a part, by looks
  const auto take_part = [&] {
    if (end > begin && shown.apart(rows[begin], rows[end]) > largest_mismatch)
      turn = SeenTurn{turn ? turn->first : rows[begin], rows[end]};
  };
  for (std::size_t k = 1; k < rows.size(); ++k) {
    if (!(shown.apart(rows[k - 1], rows[k]) > limit)) continue;
    if (end == 0 || k > end + rest_between) {
      take_part();
      begin = k - 1;
    }
    end = k;
  }
  take_part();
  if (turn && shown.apart(turn->first, turn->last) > largest_mismatch) return turn;
  return std::nullopt;
}

}  // namespace

std::optional<SeenTurn> turn_at_change(const Recording& recording, const ChannelTriple& channels,
                                       const RowStretch& before, const RowStretch& behind) {
  const ShownAngles shown(recording, channels);
  const std::size_t stride =
      std::max<std::size_t>(1, std::max(before.rows(), behind.rows()) / looks);
  const auto one = shown.usual_step(before, stride), other = shown.usual_step(behind, stride);
  if (!one || !other) return std::nullopt;
  const double limit = std::max(resolved, beyond_usual * std::max(*one, *other));
  const std::size_t back = before.rows() / parts_of_a_position + 1,
                    forth = behind.rows() / parts_of_a_position + 1;
  const auto rows = shown.looked_at(before.end - std::min(back, before.rows()),
                                    std::min(behind.first + forth, behind.end), stride);
  const auto turn = moving(shown, rows, limit);
  if (!turn) return std::nullopt;
  // From looks to rows: the last that stands as it did, and the first that stands as it will.
  std::size_t stood = turn->first;
  for (std::size_t row = stood + 1; row < turn->last; ++row)
    if (shown.at(row) && shown.apart(row, turn->first) <= limit) stood = row;
  SeenTurn out{turn->last, turn->last};
  for (std::size_t row = turn->last; row-- > stood + 1;) {
    if (!shown.at(row)) continue;
    out.first = row;
    if (shown.apart(row, turn->last) <= limit) out.last = row;
  }
  // Where nothing was measured nobody knows but by the number.
  if (stood < behind.first && behind.first < out.first) {
    if (out.last == out.first) out.last = behind.first;
    out.first = behind.first;
  }
  return out;
}

}  // namespace drift
