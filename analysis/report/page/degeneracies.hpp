#pragma once

#include <string>
#include <vector>

#include "analysis/report/page/table.hpp"
#include "core/estimate/batch.hpp"
#include "core/physics/coupling.hpp"
#include "core/physics/triads.hpp"
#include "core/plan/excitation.hpp"

namespace drift::report {

/// A direction in which the parameters can move together with hardly an effect on the data.
struct NamedDirection {
  struct Part {
    std::size_t param = 0;     ///< index in TermLibrary
    double coefficient = 0.0;  ///< in the parameter's unit, as it is written
  };
  std::vector<Part> parts;  ///< in library order; the first counts 1
  std::string combination;  ///< "D_F_x - D_II_x - D_OO_x - D_SS_x"
  std::string reason;       ///< in words, where physics.md 2.4 knows it; else empty
  bool anywhere = false;    ///< whether by that reason no position of a laboratory shows it
  /// What one prior sigma along it, as it is written, leaves in the data [sigma]; 0 if nothing but
  /// rounding.
  double signal = 0.0;
  double unrounded = 0.0;  ///< the same with all parts and digits
};

/// What a test does not see, and what says so.
struct UnseenSpace {
  const std::vector<WeakDirection>& directions;  ///< weak_directions() below unseen_information
  const MatX& information_root;                  ///< of which they are; shape (n, n) of the layout
  const Excitation& excitation;                  ///< of the test
  Coupling coupling = Coupling::eq5;             ///< of the model
};

/// Directions that a test does not see, in a readable basis: those of which rounding alone is left
/// first, then those with a signal, however small.
///
/// The eigenvectors of a degenerate space are an arbitrary rotation of each other. Here parameters
/// without a signal of their own and directions that physics knows (physics.md 2.4) are taken out
/// of it, as far as they lie in it; the rest is brought to reduced row echelon form with full
/// pivoting, which makes every group of parameters of its own a direction of its own. Each is
/// written with as few parts, and these with as few digits, as leave it unseen as it is written:
/// less than unseen_information. `but`: a part of the space that is named elsewhere; of what
/// remains one direction is named for each that the space has more.
std::vector<NamedDirection> name_degeneracies(const Layout& layout, const Mounting& mounting,
                                              const UnseenSpace& space,
                                              const std::vector<WeakDirection>& but = {});

/// "12 are not seen at all, 2 leave less than 0.001 sigma at a prior sigma".
std::string unseen_text(const std::vector<WeakDirection>& directions, const MatX& information_root);

/// A table of directions with a note that says how to read it.
Table direction_table(std::string title);
/// Rows of it, under their common reasons.
void add_directions(Table& table, const std::vector<NamedDirection>& directions);

}  // namespace drift::report
