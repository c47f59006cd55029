#pragma once

#include "core/estimate/batch.hpp"

namespace drift::blind {

/// Which part of a signal the nominal fit of a test takes for its own parameters, and which it
/// leaves:
///
///   left^2 = s' (1 + J J')^-1 s = s's - |L^-1 J's|^2,   L L' = 1 + J'J,
///
/// J: all measurements with respect to the nominal parameters and the attitude of every caging, in
/// declared sigmas per prior sigma, at the truth. Independent of the code that diagnoses.
class Absorption {
 public:
  Absorption(const FilterSpec& nominal, const Timeline& timeline, const Readout& readout,
             const Measurements& clean, const Theta& theta, const std::vector<Vec3>& psi0_l);

  /// Difference of two sets of measurements, in declared sigmas, row by row of the fit.
  VecX signal(const Measurements& with, const Measurements& without) const;

  struct Size {
    double left = 0.0;      ///< [sigma]
    double absorbed = 0.0;  ///< part of the signal's square that the fit takes, 0..1
  };
  Size size_of(const VecX& signal) const;
  /// Products of what is left of signals; columns: signals. Shape (signals, signals).
  MatX left_products(const MatX& signals) const;
  /// Cosine of what is left of two signals.
  double cosine(const VecX& a, const VecX& b) const;

 private:
  double left_product(const VecX& a, const VecX& b) const;
  const Timeline* timeline_;
  Readout readout_;
  MatX J_;  ///< shape (rows, parameters + 3 chains)
  MatX L_;
};

}  // namespace drift::blind
