#pragma once

#include <algorithm>

#include "analysis/inference/noise/noise_states.hpp"
#include "core/estimate/lanes.hpp"

namespace drift::inference {

/// Covariance of the noise states between rows, in lanes: column after column, each with zeros up
/// to whole lanes. Whole lanes alone are written and read: a part of one that was just written
/// would have to be waited for, and row after row waits for the one before.
template <int states>
class NoiseCovariance {
 public:
  static constexpr int others = states - 3;
  static constexpr int whole = static_cast<int>(whole_lanes(states));  ///< numbers of a column

  NoiseCovariance(const NoiseStates& used, const NoiseModel& noise) : white_rate_(used.white >= 0) {
    const OverPairs initial = initial_covariance(used, noise);
    for (Eigen::Index c = 0; c < initial.cols(); ++c)
      for (Eigen::Index r = 0; r < initial.rows(); ++r) initial_[c][r] = initial(r, c);
    std::fill_n(decay_, 3, 1.0);
    begin(Anew::recording);
  }

  void begin(Anew what) {
    if (what == Anew::recording) {
      std::copy_n(&initial_[0][0], states * whole, &P_[0][0]);
      return;
    }
    for (int c = 0; c < states; ++c)
      for (int r = 0; r < (c < 3 ? states : 3); ++r) P_[c][r] = c == r ? 1.0 : 0.0;
  }

  /// P <- F P F' + Q of F = [1, drive; 0, decay].
  void move(const NoiseStep& step) {
    if constexpr (others > 0) {
      for (int m = 0; m < others; ++m) {
        std::copy_n(&step.drive(0, m), 3, drive_[m]);
        decay_[3 + m] = step.decay[m];
        variance_[m][3 + m] = step.kicked && m < 3 ? 0.0 : step.variance[m];
      }
      if (white_rate_)
        for (int j = 0; j < 3; ++j) {
          std::copy_n(&(step.kicked ? step.kick : step.anew)(0, j), 3, at_once_[j]);
          if constexpr (others >= 3) at_once_[j][3 + j] = step.kicked ? 1.0 : 0.0;
        }
      // P F': columns of the attitude, then of the others.
      for (int d = 0; d < deep; ++d) {
        Lanes attitude[3];
        for (int i = 0; i < 3; ++i) attitude[i] = at(P_[i], d);
        for (int m = 0; m < others; ++m) {
          const Lanes other = at(P_[3 + m], d);
          for (int i = 0; i < 3; ++i)
            attitude[i] = mul_add(other, broadcast(step.drive(i, m)), attitude[i]);
          put(P_[3 + m], d, times(other, broadcast(step.decay[m])));
        }
        for (int i = 0; i < 3; ++i) put(P_[i], d, attitude[i]);
      }
      // F of that: rows of the attitude are in the first lanes.
      for (int c = 0; c < states; ++c) {
        Lanes top[high];
        for (int d = 0; d < high; ++d) top[d] = times(at(P_[c], d), at(decay_, d));
        for (int m = 0; m < others; ++m)
          for (int d = 0; d < high; ++d)
            top[d] = mul_add(at(drive_[m], d), broadcast(P_[c][3 + m]), top[d]);
        for (int d = high; d < deep; ++d) put(P_[c], d, times(at(P_[c], d), at(decay_, d)));
        for (int d = 0; d < high; ++d) put(P_[c], d, top[d]);
      }
      for (int m = 0; m < others; ++m)
        for (int d = 0; d < deep; ++d)
          put(P_[3 + m], d, plus(at(P_[3 + m], d), at(variance_[m], d)));
      if constexpr (others >= 3)
        if (white_rate_) add_at_once(step);
    }
  }

  /// What a row with these weights on the states says, of white noise sigma: its variance. gain:
  /// written, `states` numbers, and as far as whole lanes go.
  double take(const double* h, bool reads_others, double sigma, double* gain) {
    Lanes seen[deep];  // P h
    for (int d = 0; d < deep; ++d) {
      seen[d] = times(at(P_[0], d), broadcast(h[0]));
      seen[d] = mul_add(at(P_[1], d), broadcast(h[1]), seen[d]);
      seen[d] = mul_add(at(P_[2], d), broadcast(h[2]), seen[d]);
    }
    if (reads_others)
      for (int m = 3; m < states; ++m)
        for (int d = 0; d < deep; ++d) seen[d] = mul_add(at(P_[m], d), broadcast(h[m]), seen[d]);
    alignas(64) double Ph[whole], less[whole];
    for (int d = 0; d < deep; ++d) put(Ph, d, seen[d]);
    double S = (h[0] * Ph[0] + h[1] * Ph[1]) + (h[2] * Ph[2] + sigma * sigma);
    if (reads_others)
      for (int m = 3; m < states; ++m) S += h[m] * Ph[m];
    const Lanes inverse = broadcast(1.0 / S), minus = broadcast(-1.0);
    for (int d = 0; d < deep; ++d) {
      const Lanes g = times(seen[d], inverse);
      store(gain + d * width, g);
      put(less, d, times(g, minus));
    }
    for (int m = 0; m < states; ++m)
      for (int d = 0; d < deep; ++d)
        put(P_[m], d, mul_add(seen[d], broadcast(less[m]), at(P_[m], d)));
    return S;
  }

 private:
  static constexpr int width = static_cast<int>(lane_width);
  static constexpr int deep = whole / width;            ///< lanes of a column
  static constexpr int high = (3 + width - 1) / width;  ///< that hold rows of the attitude
  static constexpr int high_at_once = std::min(deep, (6 + width - 1) / width);

  static Lanes at(const double* column, int d) { return load(column + d * width); }
  static void put(double* column, int d, Lanes a) { store(column + d * width, a); }
  static Lanes times(Lanes a, Lanes b) { return mul_add(a, b, broadcast(0.0)); }
  static Lanes plus(Lanes a, Lanes b) { return mul_add(a, broadcast(1.0), b); }

  /// What acts on the attitude at once: Q += L L' of L = [kick; 1], with a new value of the white
  /// rate noise, or [anew; 0].
  void add_at_once(const NoiseStep& step) {
    const Mat3& of_attitude = step.kicked ? step.kick : step.anew;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int d = 0; d < high_at_once; ++d)
          put(P_[i], d, mul_add(at(at_once_[j], d), broadcast(of_attitude(i, j)), at(P_[i], d)));
    if (step.kicked)
      for (int j = 0; j < 3; ++j)
        for (int d = 0; d < high_at_once; ++d)
          put(P_[3 + j], d, plus(at(at_once_[j], d), at(P_[3 + j], d)));
  }

  alignas(64) double P_[states][whole] = {};
  alignas(64) double initial_[states][whole] = {};
  // Of a step, with zeros up to whole lanes: columns of drive, of L, of the diagonal variance.
  alignas(64) double drive_[others > 0 ? others : 1][whole] = {};
  alignas(64) double variance_[others > 0 ? others : 1][whole] = {};
  alignas(64) double at_once_[3][whole] = {};
  alignas(64) double decay_[whole] = {};
  bool white_rate_;
};

}  // namespace drift::inference
