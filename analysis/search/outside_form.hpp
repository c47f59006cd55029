#pragma once

#include "analysis/search/search.hpp"

namespace drift::search {

/// Log evidence, with the prior of the noise, that one thing outside the library drives the mean
/// and hangs on the attitude: a product of forces, a harmonic of a gimbal, a threshold. It is every
/// form of that kind in the grammar of proposals (forms/grammar.hpp), weighed by its prior, of a
/// size that nobody knows. What hangs on time instead is seen as a window, a period or an input of
/// free form (posterior.cpp). An explanation by the library may fit such a thing nearly as well,
/// with more parameters: without this alternative it would be sure of itself.
///
/// Under the declared noise and, where the best explanation prefers the one estimated beside it,
/// under that too; the noise estimated beside the nominal model holds part of the effect.
double log_evidence_of_a_form(const Search& found, const MeasuredTest& test);

}  // namespace drift::search
