#pragma once

#include "analysis/discovery/examination.hpp"

namespace drift::discovery {

/// How held-out positions are predicted.
enum class FoldMethod {
  linear,    ///< by conditioning the linearised test: exact up to second order, no fit
  refitted,  ///< both models fitted again without the position, through the full dynamics
};

/// Predicts every position from all the others, with the nominal and with the patched model.
///
/// log p(y_p | y_rest) = log p(y) - log p(y_rest), parameters and attitudes marginalised; chi-square
/// likewise. Nested: the cause is chosen anew from the other positions alone (discovery.md 0.9), the
/// nominal model where nothing there is significant.
HeldOut held_out(const Examination& nominal, const Examination& patched, const Test& test,
                 const std::vector<std::size_t>& named, double library_threshold, FoldMethod method);

/// A linear problem without the rows of some positions (from 0).
LinearProblem without_positions(const LinearProblem& problem, const std::vector<int>& positions);

/// Measurements with those of some positions taken out.
Measurements without_positions(const Measurements& measured, const Timeline& timeline, const std::vector<int>& positions);

}  // namespace drift::discovery
