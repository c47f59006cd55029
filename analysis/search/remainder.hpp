#pragma once

#include <limits>

#include "analysis/search/field.hpp"

namespace drift::search {

/// What is left when some causes are in the model, their amplitudes free.
struct Remainder {
  double library = 0.0;       ///< largest strength among the other candidates
  double scan = 0.0;          ///< largest strength among the windows
  std::size_t strongest = 0;  ///< the candidate that has `library`
};

/// Conditional scores T_(c|d) (discovery.md 2.5). The neighbouring variant on the grid goes in with
/// a cause, so that a time constant between two of them is allowed for. Members of a chosen
/// candidate's own family do not count as others. stop: give up (and return what was
/// found) as soon as a candidate's strength exceeds it.
Remainder remainder(const Field& field, const std::vector<Choice>& choices,
                    double stop = std::numeric_limits<double>::infinity());

}  // namespace drift::search
