#pragma once

#include "analysis/inference/marginal.hpp"

namespace drift::inference {

/// Sums of products of rows under white noise, kept by instrument: the marginal likelihood for any
/// two factors without going through the rows again. With U the scaled columns of a chain and P
/// what its rows feel of the attitude, U' V^-1 U = U'U - U'P (1 + P'P)^-1 P'U (Woodbury).
class WhiteSums {
 public:
  /// columns: [parameters, r0, ...], a row of `width` numbers after the other.
  WhiteSums(const MeasuredRows& rows, const std::vector<double>& columns, std::size_t width,
            std::size_t parameters);

  /// Of noise that drives nothing.
  Marginal at(const NoiseModel& noise) const;

 private:
  struct Instrument {
    MatX products;  ///< of [parameters, r0], lower triangle
    MatX attitude;  ///< psi' [psi, parameters, r0] of every chain, three rows each
    Eigen::Index rows = 0;
  };
  Instrument accelerometers_, gimbals_;
  double log_det_ = 0.0;  ///< of the rows at factors of 1
};

}  // namespace drift::inference
