#pragma once

#include "core/ode/handles.hpp"

namespace drift::detail {

/// A serial SUNDIALS vector of length n, zero-filled, whose operations are compiled with this
/// program.
///
/// Debian builds SUNDIALS 6.4.1 without optimisation; with these operations an integration takes
/// about half the time. Sums are taken in an order that depends on n alone, never on the address,
/// so that results are the same bits in every thread. Clones inherit the operations.
VectorPtr make_vector(int n, _SUNContext* context);

}  // namespace drift::detail
