#pragma once

#include <array>
#include <vector>

#include "core/estimate/sequential/in_lanes/lane_math.hpp"

namespace drift {

/// Covariance of the parameters of several runs, one in each lane, in prior sigmas; three
/// independent rows of unit noise come in at a time (LaneFilter). The lower triangle stands in
/// tiles of 4 x 4 numbers.
class LaneCovariance {
 public:
  explicit LaneCovariance(std::size_t parameters);

  void reset();
  /// Where the next three rows [t | e] go: column k of row i is at(k)[4 i].
  Pack* at(std::size_t k) { return &rows_[k / 4 * row_tile + k % 4]; }
  /// Takes them in. step: what the estimate moves by; the innovations that are left, whitened.
  PackVec take(std::vector<Pack>& step);
  /// Of one lane, shape (parameters, parameters).
  void extract(int lane, MatX& P) const;
  double variance(std::size_t k, int lane) const { return element(k, k, lane); }

 private:
  static constexpr std::size_t row_tile = 12;  ///< three rows of four numbers
  static std::size_t index(std::size_t I, std::size_t J) { return I * (I + 1) / 2 + J; }
  template <bool owed>
  void multiply();
  double element(std::size_t i, std::size_t j, int lane) const;  ///< i >= j

  std::size_t n_, side_;  ///< parameters; tiles along a side
  std::vector<std::array<Pack, 16>> P_;
  std::vector<Pack> rows_, V_, gain_;  ///< V = P t^T; gain = V L^-T, as rows_
  // The matrix does not fit the first cache, so it is written as seldom as possible: an update
  // leaves it too large by gain gain^T, which the next one takes off.
  bool owed_ = false;
};

}  // namespace drift
