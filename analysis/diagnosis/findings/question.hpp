#pragma once

#include <string>
#include <vector>

#include "analysis/planning/separation.hpp"
#include "analysis/search/cause.hpp"
#include "core/physics/drift_model.hpp"

namespace drift::diagnosis {

/// A way the truth may be: what it adds to the nominal model, and by how much.
struct Alternative {
  enum class Kind { causes, equation, nominal };
  Kind kind = Kind::nominal;
  std::vector<search::Cause> causes;  ///< none: the nominal model, or its own equation
  Coupling equation = Coupling::eq5;  ///< of Kind::equation
  std::string asked;                  ///< as a user wrote it; empty: not asked for by name
};

/// How large the effects in question are taken.
enum class Sizes { as_found, one_prior_sigma, as_found_or_one_prior_sigma };

/// What is to be told from what.
struct Question {
  std::vector<Alternative> alternatives;
  std::vector<planning::Contest> pairs;
  Sizes sizes = Sizes::as_found;
  std::vector<std::string> names = {};  ///< what was asked for, as a user wrote it

  bool empty() const { return pairs.empty(); }
};

}  // namespace drift::diagnosis
