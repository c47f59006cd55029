#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/base/linalg.hpp"
#include "core/estimate/sequential/in_lanes/lane_math.hpp"

namespace drift {

/// Information (information.hpp) of several runs, one in each lane, and beside it the products of
/// rows with those of the sample before, which tell whether residuals are white.
///
/// Rows [t | e | zeros] come three at a time into panels of four columns, and are summed up when
/// these are full: tiles of 4 x 4 columns stay in registers.
class LaneInformation {
 public:
  explicit LaneInformation(std::size_t parameters);

  void clear();
  /// Where the next three rows go: column k of row i is at panel(k)[4 i + k % 4]. channel: 0 or 1;
  /// follows: whether the three of this channel before them are its neighbours in time.
  void begin_rows(int channel, bool follows);
  Pack* at(std::size_t k) { return &panel_[((k / 4) * most_rows + now_) * 4 + k % 4]; }
  /// Sums up what has come. neighbours: the products with rows before, too.
  void flush(bool neighbours);
  /// Whether begin_rows() may come without a flush.
  bool full() const { return rows_ + 3 > most_rows; }

  /// Factorises 1 + information; a lane in which it is not positive definite becomes NaN.
  void factorise();
  /// x <- (1 + information)^-1 x, shape: parameters.
  void solve(Pack* x) const;
  /// Four rows t become L^-1 t, L L^T = 1 + information: column k of row r at 4 k + r, padded() of
  /// them; those beyond the parameters are zero.
  void whiten(Pack* rows) const;
  std::size_t padded() const { return (n_ + 3) / 4 * 4; }
  /// Sum of t_k e, and of e^2 for k = parameters.
  const Pack& right(std::size_t k) const { return element(sum_, n_, k); }
  /// P = (1 + information)^-1, after factorise().
  void invert();
  /// P of the first lanes, one after the other, shape (parameters, parameters) each.
  void extract(std::span<MatX* const> lanes) const;
  /// Sum over neighbours s, w of (e_s - s d)(e_w - w d) + s P w^T.
  Pack lagged(const Pack* d) const;

 private:
  using Tile = std::array<Pack, 16>;
  static constexpr std::size_t carried = 6, most_rows = carried + 36;
  static std::size_t index(std::size_t I, std::size_t J) { return I * (I + 1) / 2 + J; }
  const Pack& element(const std::vector<Tile>& tiles, std::size_t i, std::size_t j) const {
    return tiles[index(i / 4, j / 4)][4 * (i % 4) + j % 4];  // i >= j, or in one tile
  }
  const Pack& factor(std::size_t i, std::size_t j) const {  // i >= j; tiles are transposed
    return factor_[index(i / 4, j / 4)][4 * (j % 4) + i % 4];
  }
  const Pack* panel(std::size_t I, std::size_t row) const {
    return &panel_[(I * most_rows + row) * 4];
  }
  void add_neighbours();

  std::size_t n_, tiles_;  ///< parameters; tiles along a side
  std::vector<Tile> sum_, neighbours_, factor_, inverse_;
  std::vector<Tile> inverse_factor_;  ///< work
  std::vector<Pack> inverse_diagonal_;
  std::vector<Pack> panel_;  ///< rows; the first six are the last ones before the flush, by channel
  std::vector<Pack> beside_;  ///< work: sums of the neighbours of a row, as panel_
  std::size_t rows_ = 0, now_ = 0;
  std::array<bool, 2> any_{};          ///< whether a channel has rows in panel_
  std::array<std::size_t, 2> last_{};  ///< where its last ones are
  struct Pair {
    std::size_t before, after;  ///< where three rows begin
  };
  std::array<std::vector<Pair>, 2> pairs_;  ///< by channel
};

}  // namespace drift
