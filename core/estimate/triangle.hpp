#pragma once

#include "core/base/linalg.hpp"

namespace drift {

/// The upper triangle R that a QR decomposition leaves of `rows`: R^T R = rows^T rows, to the
/// precision of the rows themselves (their squares would lose half the digits). Square; zero below
/// the last row if there are fewer rows than columns.
MatX triangle(const MatX& rows);

/// Rows of a above rows of b.
MatX stacked(const MatX& a, const MatX& b);

}  // namespace drift
