#pragma once

#include <string>
#include <vector>

#include "analysis/inference/signatures.hpp"

namespace drift::inference {

/// Values of nonlinear parameters: (param, SI value).
using Settings = std::vector<std::pair<std::size_t, double>>;

/// Every combination of the grids of a term's settings but those `known`, moments spread over the
/// test; one empty one without any.
std::vector<Settings> settings_of(const TermInfo& term, const ParamMask& known,
                                  const Timeline& timeline);

/// One way a candidate may look: its columns, at one setting of the nonlinear parameters.
struct Variant {
  std::vector<int> columns;  ///< of LinearProblem::extra
  Settings settings;
  double share =
      1.0;  ///< prior chance of this setting, over that of one point of the library's grid
  bool between = false;  ///< put between the points of the library's grid (refine_grids())
};

/// Physics that may be missing: a term, or an axis or group of it.
struct Candidate {
  std::string term;   ///< key of the term
  std::string axis;   ///< "x", "outer", ...; empty if it belongs to none or to all
  std::string label;  ///< "magnetic_drift.y", "g2_drift D_IS_x": no two of a set have the same
  std::vector<std::size_t>
      params;                     ///< linear parameters, same order as the columns of each variant
  std::vector<Variant> variants;  ///< neighbours on the grid stand next to each other
  double log_prior = 0.0;         ///< beside what every term has: of what it follows
  bool contains(const Candidate& other) const;  ///< same term, more parameters
  /// A parameter of both: together they are no two causes.
  bool overlaps(const Candidate& other) const;
};

/// All that the nominal model leaves out, and the columns they need.
struct CandidateSet {
  std::vector<Candidate> candidates;
  std::vector<SignatureSpec> signatures;
  /// Terms (index in TermLibrary) that need a covariate which the test does not have, or one that
  /// has hardly moved.
  std::vector<std::size_t> without_covariate;
};

/// Whether a term that wants a temperature which has moved (TermInfo::wants_swing) has one in this
/// test: TemperatureLimits::swing. True of every other term.
bool has_swing_for(const TermInfo& term, const Timeline& timeline);

/// Every parameter that the nominal filter does not estimate, singly, per axis, per group of axes
/// and per term, on the grids of their nonlinear parameters, evaluated at theta. Prior sigmas are
/// the library's defaults. Nonlinear and noise parameters are no candidates of their own; nor are
/// terms that need a covariate which the recording does not have, or one that has hardly moved.
CandidateSet library_candidates(const FilterSpec& nominal, const Theta& theta,
                                const Timeline& timeline);

}  // namespace drift::inference
