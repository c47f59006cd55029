#pragma once

#include <cstddef>
#include <vector>

namespace drift {

/// Angles at instants `factor` readings apart, each from as many readings around it: the centre of
/// the parabola through them. No two share a reading. The error is the fourth derivative of an
/// angle times T^4 / 2000 (T: from the first reading to the last): 1e-3 arcsec at Earth rate and 60
/// s.
class AnglesAround {
 public:
  /// factor: readings from one angle to the next; stride: rows from one reading to the next;
  /// interval: of the rows [s].
  AnglesAround(std::size_t factor, std::size_t stride, double interval);

  /// By which the platform may turn meanwhile [rad]: then the error is 0.05 arcsec.
  static constexpr double largest_turn = 0.18;

  /// Whether `factor` is large enough: of three readings a parabola leaves no noise out.
  bool fits() const { return half_ >= 2; }
  /// How many readings one of the angles is worth: its noise is less by their root.
  double readings() const { return 1.0 / weight_[half_]; }
  /// From one angle to the next [s].
  double length() const { return length_; }
  /// Whether the rows around `row` are of first..last and evenly spaced in time t [s].
  bool around(std::size_t row, std::size_t first, std::size_t last,
              const std::vector<double>& t) const;
  /// The angle at `row` of the angles x [rad]. NaN where one is missing or lies far from the
  /// others: what is isolated is left to the fit, which knows the noise.
  double at(const std::vector<double>& x, std::size_t row) const;

 private:
  /// Of the k-th reading from the centre, in readings.
  double from_centre(std::size_t k) const {
    return static_cast<double>(k) - static_cast<double>(half_);
  }

  std::size_t half_, stride_;
  double reading_, length_;  ///< from one reading to the next, from one angle to the next [s]
  std::vector<double> weight_;
};

}  // namespace drift
