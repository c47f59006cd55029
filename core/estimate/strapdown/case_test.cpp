#include "core/estimate/strapdown/case_test.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/check.hpp"
#include "core/base/nan.hpp"
#include "core/estimate/strapdown/stillness.hpp"
#include "core/estimate/strapdown/turn_reading.hpp"
#include "core/estimate/strapdown/unknown_north.hpp"

namespace drift::strapdown {
namespace {

/// Rows of equal length, so that all have the same noise: a dwell of every length has two.
double row_length(const Signals& signals, const std::vector<Dwell>& dwells) {
  double rest = 0.0, shortest = dwells.front().duration();
  for (const Dwell& d : dwells) {
    rest += d.duration();
    shortest = std::min(shortest, d.duration());
  }
  const double wanted = std::min(rest / rows_at_rest, 0.5 * shortest);
  const double samples = std::max(1.0, std::floor(wanted / signals.interval));
  return samples * signals.interval;
}

bool without_gap(const Signals& s, std::size_t first, std::size_t last) {
  for (std::size_t k = first; k <= last; ++k)
    if (!s.measured(k) || (k > first && s.time[k] - s.time[k - 1] > longest_step * s.interval))
      return false;
  return true;
}

/// Scatter of rows from one to the next of their dwell: what drifts slowly is not noise.
struct Scatter {
  double squares = 0.0, dof = 0.0;
  void add(const std::vector<Vec3>& rows) {
    for (std::size_t k = 1; k < rows.size(); ++k) {
      squares += 0.5 * (rows[k] - rows[k - 1]).squaredNorm();
      dof += 3.0;
    }
  }
  double sigma() const { return dof > 0.0 ? std::sqrt(squares / dof) : 0.0; }
};

class Layout {
 public:
  Layout(const Signals& signals, const std::vector<Dwell>& dwells, const Site& site, Carry carry,
         InTurns in_turns)
      : signals_(signals), dwells_(dwells), carry_(carry) {
    test_.timeline.reads_turns = in_turns == InTurns::read;
    DRIFT_EXPECTS(in_turns == InTurns::left_out || carry == Carry::through);
    test_.timeline.site = site;
    test_.timeline.site.north_known = carry == Carry::through;
    test_.timeline.of_case = true;
    test_.timeline.positions = static_cast<int>(dwells.size());
    test_.row = row_length(signals, dwells);
    if (carry == Carry::one_way) stillness_ = stillness_of(signals, dwells);
    if (carry == Carry::one_way) drift_ = drift_at_rest();
    test_.still = carry == Carry::one_way ? stillness_.still : std::vector(dwells.size(), true);
  }

  CaseTest made(const std::vector<double>& azimuth) {
    azimuth_ = azimuth;
    for (std::size_t d = 0; d < dwells_.size(); ++d) {
      const bool carried = d > 0 && without_gap(signals_, at_, dwells_[d].first);
      if (carried) {
        carry(d, dwells_[d].first, What::way);
        test_.ways.push_back(d);
      } else {
        if (d > 0) ++test_.ways_with_gap;
        cage_next(d);
      }
      at_ = dwells_[d].first;
      const std::vector<MeanReading> rows = rows_of(dwells_[d]);
      if (carry_ == Carry::through)
        for (const MeanReading& row : rows) add_rest(row, d);
      else
        take_halves(d, carried && d + 1 < dwells_.size());
    }
    finish();
    return std::move(test_);
  }

 private:
  enum class What { way, held };  ///< on the way to a dwell, or in one that is no rest

  Vec3 drift_at_rest() const {
    Vec3 sum = Vec3::Zero();
    double still = 0.0;
    for (std::size_t d = 0; d < dwells_.size(); ++d)
      if (stillness_.still[d]) {
        sum += dwells_[d].gyro;
        still += 1.0;
      }
    return sum / still;
  }

  void cage_next(std::size_t d) {
    const auto chain = static_cast<std::size_t>(test_.timeline.chains++);
    test_.R_lp.push_back(levelled(dwells_[d].acc, chain < azimuth_.size() ? azimuth_[chain] : 0.0));
    cage_ = true;
  }

  void add(Interval i, const Vec3& acc) {
    i.chain = test_.timeline.chains - 1;
    i.cage = std::exchange(cage_, false);
    test_.timeline.intervals.push_back(i);
    test_.read_over.emplace_back(i.t0, i.t1);
    acc_.push_back(acc);
  }

  void add_rest(const MeanReading& row, std::size_t d) {
    Interval i;
    i.t0 = row.start;
    i.t1 = row.end;
    i.position = static_cast<int>(d);
    i.rest = true;
    i.omega_cmd_p = row.gyro;
    add(i, row.acc);
  }

  double longest_turn() const {
    return carry_ == Carry::through ? longest_turn_row : longest_turn_row_one_way;
  }

  /// The fastest rate of the samples behind `first` up to `last` [rad/s].
  double fastest(std::size_t first, std::size_t last) const {
    double rate = 0.0;
    for (std::size_t k = first + 1; k <= last; ++k)
      rate = std::max(rate, (signals_.gyro[k] - drift_).norm());
    return rate;
  }

  /// Whether a row that has turned so far, from readings that sum up to `sum`, takes one more.
  bool has_room(const Mat3& R, const Vec3& sum, std::size_t k, double length) const {
    const Vec3 angle = rotation_vector(R), next = turned(signals_, k + 1, drift_);
    const double times =
        test_.timeline.reads_turns && speeds_up(signals_, k) ? longer_while_speeding_up : 1.0;
    return angle.norm() + next.norm() < times * longest_turn() &&
           length < times * longest_way_row &&
           (carry_ == Carry::through || (angle - sum).norm() < largest_bend);
  }

  /// The readings carry the attitude on to sample `last`. In a dwell that is no rest the
  /// accelerometers are read, too.
  void carry(std::size_t d, std::size_t last, What what) {
    Mat3 R = Mat3::Identity();
    Vec3 sum = Vec3::Zero();
    std::size_t begin = at_;
    const bool reads_turn = what == What::way && test_.timeline.reads_turns;
    const std::size_t start = at_;
    std::vector<Vec3> f;
    const bool steady = carry_ == Carry::through && what == What::way && !reads_turn;
    const double change = steady ? largest_change * fastest(at_, last) : 0.0;
    if (reads_turn) f = carried_force(signals_, at_, last, dwells_[d - 1].acc, dwells_[d].acc);
    for (std::size_t k = at_ + 1; k <= last; ++k) {
      R = R * rotation(turned(signals_, k, drift_));
      sum += turned(signals_, k, drift_);
      const double length = signals_.time[k] - signals_.time[begin];
      const bool alike =
          !steady || k == last || (signals_.gyro[k + 1] - signals_.gyro[begin]).norm() < change;
      if (k < last && alike && has_room(R, sum, k, length)) continue;
      Interval i;
      i.t0 = signals_.time[begin];
      i.t1 = signals_.time[k];
      i.position = static_cast<int>(d);
      i.slew = what == What::way;
      i.omega_cmd_p = rotation_vector(R) / length + drift_;
      Vec3 acc = Vec3::Constant(nan_value);
      if (what == What::held) {
        i.samples = length / stillness_.half;
        acc = mean_reading(signals_, begin, k).acc;
      } else if (reads_turn) {
        i.samples = length / test_.row;
        const TurnReading read =
            turn_reading(signals_, begin, k, f[begin - start], test_.timeline.site.gravity);
        i.turn = read.turn;
        acc = read.acc;
      }
      add(i, acc);
      R.setIdentity();
      sum.setZero();
      begin = k;
    }
    at_ = last;
  }

  /// The gyros of a still dwell are read once: what they wander by from dwell to dwell its halves
  /// have in common.
  void take_halves(std::size_t d, bool in_two_chains) {
    const std::size_t ends[] = {dwells_[d].first, middle_of(dwells_[d]), dwells_[d].last};
    const Vec3 gyro = mean_reading(signals_, ends[0], ends[2]).gyro;
    at_ = ends[0];
    for (const int half : {0, 1}) {
      if (half == 1 && in_two_chains) cage_next(d);
      if (test_.still[d]) {
        MeanReading row = mean_reading(signals_, ends[half], ends[half + 1]);
        row.gyro = gyro;
        add_rest(row, d);
        if (half == 0) test_.read_over.back() = {signals_.time[ends[0]], signals_.time[ends[2]]};
        if (half == 1) again_.push_back(test_.timeline.intervals.size() - 1);
      } else {
        carry(d, ends[half + 1], What::held);
      }
      at_ = ends[half + 1];
    }
  }

  /// Whole rows; what is left of the dwell belongs to the way to the next.
  std::vector<MeanReading> rows_of(const Dwell& dwell) {
    const auto samples = static_cast<std::size_t>(std::lround(test_.row / signals_.interval));
    std::vector<MeanReading> rows;
    std::vector<Vec3> accs, gyros;
    for (; at_ + samples <= dwell.last; at_ += samples) {
      rows.push_back(mean_reading(signals_, at_, at_ + samples));
      accs.push_back(rows.back().acc);
      gyros.push_back(rows.back().gyro);
    }
    of_acc_.add(accs);
    if (test_.still[static_cast<std::size_t>(&dwell - dwells_.data())]) of_gyro_.add(gyros);
    return rows;
  }

  void finish() {
    const auto n = static_cast<Eigen::Index>(acc_.size());
    test_.measured.acc.resize(3, n);
    test_.measured.gimbal.setConstant(3, n, nan_value);
    for (Eigen::Index i = 0; i < n; ++i) {
      test_.measured.acc.col(i) = acc_[static_cast<std::size_t>(i)];
      if (test_.timeline.intervals[static_cast<std::size_t>(i)].rest)
        test_.measured.gimbal.col(i).setZero();
    }
    for (const std::size_t i : again_)
      test_.measured.gimbal.col(static_cast<Eigen::Index>(i)).setConstant(nan_value);
    const bool halved = carry_ == Carry::one_way;
    test_.readout.accelerometer_noise = halved ? stillness_.acc_noise : of_acc_.sigma();
    test_.readout.gimbal_noise = of_gyro_.sigma();
    test_.angle_random_walk = of_gyro_.sigma() * std::sqrt(test_.row);
    if (halved) {
      const UnknownNorth north = unknown_north(test_.timeline, drift_);
      const double of_half = stillness_.gyro_noise;
      test_.readout.gimbal_noise_at_most = true;
      test_.readout.gimbal_noise = std::sqrt(0.5 * of_half * of_half + north.variance);
      test_.angle_random_walk = std::hypot(test_.angle_random_walk, std::sqrt(north.walk));
      test_.row = stillness_.half;
    }
    place_nodes(test_.timeline, test_.R_lp, longest_turn());
  }

  const Signals& signals_;
  const std::vector<Dwell>& dwells_;
  Carry carry_;
  std::vector<double> azimuth_;
  Stillness stillness_;  ///< of Carry::one_way
  CaseTest test_;
  /// Taken out while samples are joined to rows, and put back: a drift of 20 deg/s would bend a row
  /// of a second by more than any misalignment does.
  Vec3 drift_ = Vec3::Zero();
  std::size_t at_ = 0;  ///< sample up to which the recording is laid out
  bool cage_ = false;   ///< the next row begins a chain
  std::vector<Vec3> acc_;
  std::vector<std::size_t> again_;  ///< rows at rest whose gyros are in the row before
  Scatter of_acc_, of_gyro_;
};

}  // namespace

Mat3 levelled(const Vec3& f_c, double azimuth) {
  const Vec3 up_c = f_c.normalized();
  const Mat3 least = Eigen::Quaterniond::FromTwoVectors(up_c, up_l).toRotationMatrix();
  return case_attitude(azimuth) * least;
}

CaseTest lay_out_case(const Signals& signals, const std::vector<Dwell>& dwells, const Site& site,
                      Carry carry, const std::vector<double>& azimuth, InTurns in_turns) {
  DRIFT_EXPECTS(!dwells.empty());
  return Layout(signals, dwells, site, carry, in_turns).made(azimuth);
}

}  // namespace drift::strapdown
