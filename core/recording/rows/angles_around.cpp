#include "core/recording/rows/angles_around.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/stats/median.hpp"

namespace drift {

AnglesAround::AnglesAround(std::size_t factor, std::size_t stride, double interval)
    : half_((factor - 1) / 2),
      stride_(stride),
      reading_(interval * static_cast<double>(stride)),
      length_(reading_ * static_cast<double>(factor)) {
  if (!fits()) return;
  const double count = 2.0 * static_cast<double>(half_) + 1.0;
  double squares = 0.0, fourths = 0.0;
  for (std::size_t k = 0; k <= 2 * half_; ++k) {
    const double square = from_centre(k) * from_centre(k);
    squares += square;
    fourths += square * square;
  }
  for (std::size_t k = 0; k <= 2 * half_; ++k)
    weight_.push_back((fourths - squares * from_centre(k) * from_centre(k)) /
                      (count * fourths - squares * squares));
}

bool AnglesAround::around(std::size_t row, std::size_t first, std::size_t last,
                          const std::vector<double>& t) const {
  const std::size_t far = half_ * stride_;
  if (!fits() || row < first + far || row + far > last) return false;
  const double lasts = t[row + far] - t[row - far];
  return std::abs(lasts - 2.0 * static_cast<double>(half_) * reading_) < 0.5 * reading_;
}

double AnglesAround::at(const std::vector<double>& x, std::size_t row) const {
  constexpr double far = 8.0;  // [medians of the bends] 5.4 sigma
  std::vector<double> beside, bends;
  double centre = 0.0;
  for (std::size_t k = 0; k < weight_.size(); ++k) {
    beside.push_back(
        std::remainder(x[row + k * stride_ - half_ * stride_] - x[row], 2.0 * std::numbers::pi));
    centre += weight_[k] * beside[k];
    if (k >= 2) bends.push_back(std::abs(beside[k] - 2.0 * beside[k - 1] + beside[k - 2]));
  }
  if (!std::isfinite(centre)) return std::numeric_limits<double>::quiet_NaN();
  const double most = *std::ranges::max_element(bends);
  const double usual = stats::upper_median(std::move(bends));
  return most > far * usual ? std::numeric_limits<double>::quiet_NaN() : x[row] + centre;
}

}  // namespace drift
