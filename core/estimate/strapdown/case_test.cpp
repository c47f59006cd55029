#include "core/estimate/strapdown/case_test.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/check.hpp"
#include "core/base/nan.hpp"

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
    if (!s.measured(k) || (k > first && s.time[k] - s.time[k - 1] > 2.5 * s.interval)) return false;
  return true;
}

/// The attitude of least turn from the local axes that has `f_c` up.
Mat3 levelled(const Vec3& f_c, double azimuth) {
  const Vec3 up_c = f_c.normalized();
  const Mat3 least = Eigen::Quaterniond::FromTwoVectors(up_c, up_l).toRotationMatrix();
  return case_attitude(azimuth) * least;
}

/// Turn of the case from sample to sample: the trapezoid and coning, w_a x w_b dt^2 / 12.
Vec3 turned(const Signals& s, std::size_t k) {
  const double dt = s.time[k] - s.time[k - 1];
  return 0.5 * dt * (s.gyro[k - 1] + s.gyro[k]) + dt * dt / 12.0 * s.gyro[k - 1].cross(s.gyro[k]);
}

/// Sum of squares of rows about the mean of their dwell.
struct Scatter {
  double squares = 0.0, dof = 0.0;
  void add(const std::vector<Vec3>& rows) {
    if (rows.size() < 2) return;
    Vec3 mean = Vec3::Zero();
    for (const Vec3& r : rows) mean += r / static_cast<double>(rows.size());
    for (const Vec3& r : rows) squares += (r - mean).squaredNorm();
    dof += 3.0 * static_cast<double>(rows.size() - 1);
  }
  double sigma() const { return dof > 0.0 ? std::sqrt(squares / dof) : 0.0; }
};

/// A row at rest: means of the outputs.
struct Row {
  double t0 = 0.0, t1 = 0.0;
  Vec3 gyro = Vec3::Zero(), acc = Vec3::Zero();
};

Row mean(std::vector<Row>::const_iterator first, std::vector<Row>::const_iterator end) {
  const auto n = static_cast<double>(end - first);
  Row all{first->t0, std::prev(end)->t1};
  for (; first != end; ++first) {
    all.gyro += first->gyro / n;
    all.acc += first->acc / n;
  }
  return all;
}

/// 1 sigma of a row from the absolute differences of two: by their median, so that dwells in which
/// the unit was touched do not count. 0.6745: the normal's upper quartile.
double sigma_of_differences(std::vector<double> absolute) {
  const auto middle = absolute.begin() + static_cast<std::ptrdiff_t>(absolute.size() / 2);
  std::ranges::nth_element(absolute, middle);
  return *middle / (0.6745 * std::numbers::sqrt2);
}

class Layout {
 public:
  Layout(const Signals& signals, const std::vector<Dwell>& dwells, const Site& site, Carry carry)
      : signals_(signals), dwells_(dwells), carry_(carry) {
    test_.timeline.site = site;
    test_.timeline.of_case = true;
    test_.timeline.positions = static_cast<int>(dwells.size());
    test_.row = row_length(signals, dwells);
  }

  CaseTest made(const std::vector<double>& azimuth) {
    for (std::size_t d = 0; d < dwells_.size(); ++d) {
      bool carried = d > 0 && without_gap(signals_, at_, dwells_[d].first);
      if (d > 0) {
        if (carried) {
          take_way(d);
          test_.ways.push_back(d);
        } else {
          ++test_.ways_with_gap;
        }
      }
      const std::vector<Row> rows = rows_of(dwells_[d]);
      const bool parts = carried && carry_ == Carry::one_way && d + 1 < dwells_.size();
      const std::size_t first_part = parts ? rows.size() / 2 : rows.size();
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const bool cage = k == 0 ? !carried : k == first_part;
        if (cage) {
          const auto chain = static_cast<std::size_t>(test_.timeline.chains++);
          test_.R_lp.push_back(
              levelled(dwells_[d].acc, chain < azimuth.size() ? azimuth[chain] : 0.0));
        }
        add(rows[k], static_cast<int>(d), cage);
      }
    }
    finish();
    return std::move(test_);
  }

 private:
  void add(Interval i, const Vec3& acc, bool rest) {
    i.chain = test_.timeline.chains - 1;
    i.rest = rest;
    i.slew = !rest;
    test_.timeline.intervals.push_back(i);
    acc_.push_back(acc);
  }

  double longest_turn() const {
    return carry_ == Carry::through ? longest_turn_row : longest_turn_row_one_way;
  }

  void take_way(std::size_t d) {
    const std::size_t last = dwells_[d].first;
    Mat3 R = Mat3::Identity();
    std::size_t begin = at_;
    for (std::size_t k = at_ + 1; k <= last; ++k) {
      R = R * rotation(turned(signals_, k));
      const Vec3 angle = rotation_vector(R);
      const double length = signals_.time[k] - signals_.time[begin];
      const bool full = k < last &&
                        angle.norm() + turned(signals_, k + 1).norm() < longest_turn() &&
                        length < longest_way_row;
      if (full) continue;
      Interval i;
      i.t0 = signals_.time[begin];
      i.t1 = signals_.time[k];
      i.position = static_cast<int>(d);
      i.omega_cmd_p = angle / length;
      add(i, Vec3::Constant(nan_value), false);
      R.setIdentity();
      begin = k;
    }
  }

  /// Whole rows; what is left of the dwell belongs to the way to the next.
  std::vector<Row> rows_of(const Dwell& dwell) {
    const auto samples = static_cast<std::size_t>(std::lround(test_.row / signals_.interval));
    const double inverse = 1.0 / static_cast<double>(samples);
    std::vector<Row> rows;
    std::vector<Vec3> accs, gyros;
    for (at_ = dwell.first; at_ + samples <= dwell.last; at_ += samples) {
      Row row{signals_.time[at_], signals_.time[at_ + samples]};
      for (std::size_t k = at_ + 1; k <= at_ + samples; ++k) {
        row.gyro += inverse * signals_.gyro[k];
        row.acc += inverse * signals_.acc[k];
      }
      accs.push_back(row.acc);
      gyros.push_back(row.gyro);
      rows.push_back(row);
    }
    of_acc_.add(accs);
    of_gyro_.add(gyros);
    return carry_ == Carry::one_way ? halves(rows) : rows;
  }

  /// Two rows of a dwell, and how they differ.
  std::vector<Row> halves(const std::vector<Row>& rows) {
    const auto middle = rows.begin() + static_cast<std::ptrdiff_t>(rows.size() / 2);
    const Row first = mean(rows.begin(), middle), second = mean(middle, rows.end());
    for (int a = 0; a < 3; ++a) {
      acc_halves_.push_back(std::abs(second.acc[a] - first.acc[a]));
      gyro_halves_.push_back(std::abs(second.gyro[a] - first.gyro[a]));
    }
    return {first, second};
  }

  void add(const Row& row, int position, bool cage) {
    Interval i;
    i.t0 = row.t0;
    i.t1 = row.t1;
    i.position = position;
    i.cage = cage;
    i.omega_cmd_p = row.gyro;
    add(i, row.acc, true);
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
    const bool halved = carry_ == Carry::one_way;
    test_.readout.accelerometer_noise =
        halved ? sigma_of_differences(acc_halves_) : of_acc_.sigma();
    test_.readout.gimbal_noise = halved ? sigma_of_differences(gyro_halves_) : of_gyro_.sigma();
    test_.angle_random_walk = of_gyro_.sigma() * std::sqrt(test_.row);
    place_nodes(test_.timeline, test_.R_lp, longest_turn());
  }

  const Signals& signals_;
  const std::vector<Dwell>& dwells_;
  Carry carry_;
  CaseTest test_;
  std::size_t at_ = 0;  ///< sample up to which the recording is laid out
  std::vector<Vec3> acc_;
  Scatter of_acc_, of_gyro_;
  std::vector<double> acc_halves_, gyro_halves_;
};

}  // namespace

CaseTest lay_out_case(const Signals& signals, const std::vector<Dwell>& dwells, const Site& site,
                      Carry carry, const std::vector<double>& azimuth) {
  DRIFT_EXPECTS(!dwells.empty());
  return Layout(signals, dwells, site, carry).made(azimuth);
}

}  // namespace drift::strapdown
