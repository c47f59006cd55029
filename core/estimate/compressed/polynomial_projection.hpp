#pragma once

#include <span>

#include "core/base/linalg.hpp"

namespace drift {

/// When a reading was taken, the stretch it belongs to lasting from -1 to 1, and its 1 sigma.
struct ReadingTime {
  double begin = 0.0, end = 0.0;
  double sigma = 1.0;
};

/// What of a channel is read: the mean from begin to end, or its value at the end.
enum class Reading { mean, at_end };

/// Coefficients of the Legendre polynomials of degree 0 to count - 1 that come closest to values at
/// equidistant nodes from -1 to 1, at least as many: shape (count, nodes).
MatX legendre_fit(std::size_t count, std::size_t nodes);

/// Integrals from -1 to each of the nodes of the polynomials that fit values there, shape (nodes,
/// nodes). fit: of the nodes.
MatX legendre_integral(const MatX& fit);

/// What readings of something smooth say, white noise of the given sigmas in them, is what their
/// projections on polynomials say: fewer rows, of unit variance and uncorrelated, degree by degree.
struct PolynomialProjection {
  MatX basis;     ///< orthonormal columns, of readings by their sigmas, shape (readings, rows)
  MatX of_nodes;  ///< rows of the values at the nodes, shape (rows, nodes) [1/unit]
};

/// fit: legendre_fit of the nodes. As many rows as polynomials, or as readings if these are fewer.
PolynomialProjection polynomial_projection(Reading what, std::span<const ReadingTime> readings,
                                           const MatX& fit);

}  // namespace drift
