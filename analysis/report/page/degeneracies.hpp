#pragma once

#include <string>
#include <vector>

#include "core/estimate/batch.hpp"
#include "core/physics/triads.hpp"

namespace drift::report {

/// A direction in which the parameters can move together without any effect on the data.
struct NamedDirection {
  struct Part {
    std::size_t param = 0;     ///< index in TermLibrary
    double coefficient = 0.0;  ///< in the parameter's unit
  };
  std::vector<Part> parts;  ///< in library order; parts that weigh little are left out
  std::string combination;  ///< "D_F_x - D_II_x - D_OO_x - D_SS_x"
  std::string reason;       ///< in words, where physics.md 2.4 knows it; else empty
};

/// Exact degeneracies in a readable basis.
///
/// The eigenvectors of a degenerate space are an arbitrary rotation of each other. Here directions
/// that physics knows (physics.md 2.4) come first, as far as they lie in the space (projection);
/// the rest is brought to reduced row echelon form with full pivoting, which makes every parameter
/// without any signal, and every group of parameters of its own, a direction of its own.
std::vector<NamedDirection> name_degeneracies(const Layout& layout, const Mounting& mounting,
                                              const std::vector<WeakDirection>& directions);

}  // namespace drift::report
