#pragma once

#include <cstdint>

#include "analysis/inference/projector.hpp"

namespace drift::inference {

/// p-value of a test that the innovations a model leaves are white, calibrated on this very test.
///
/// Statistic: Ljung and Box's Q over `lags` lags for every channel, autocovariances summed over the
/// cagings of the channel (short dwells count), the largest of the channels:
///   Q = sum_k n_k r_k^2, r_k = sum z_t z_{t+k} / sum z_t^2, n_k pairs k apart.
/// The chi-square that Q is compared with elsewhere does not hold where many parameters were fitted
/// to short records. Here its distribution is drawn: unit normals, a draw
/// of the parameters added, go through the same projection as the data (parametric bootstrap), so
/// that p = (1 + draws at or above the data) / (1 + draws) is uniform when the model is right. A
/// pure function of (problem, projector, draws, seed).
double whiteness_p(const MeasuredRows& problem, const Projector& projector, int lags = 10,
                   int draws = 399, std::uint64_t seed = 1);

}  // namespace drift::inference
