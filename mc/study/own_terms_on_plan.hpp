#pragma once

#include <string>
#include <vector>

#include "mc/study/study.hpp"

namespace drift::mc {

/// An own term that is no finite number somewhere on the plan (own_term_gaps()), or changes too
/// fast for its rows (unresolved_own_terms()).
struct BrokenTerm {
  std::string key;   ///< of its equation in the study: "term.0.equation"
  std::string what;  ///< "what is wrong (what is expected). What to do"
};

/// Those of some models, in the surroundings that are known.
std::vector<BrokenTerm> broken_own_terms(const Study& study,
                                         const std::vector<const ModelSpec*>& models,
                                         const Environment& known);
/// Those of [truth] and every filter, in what [environment] declares.
std::vector<BrokenTerm> broken_own_terms(const Study& study);

/// InputError (config), with the line of each equation, if there is any.
void require_none(const Study& study, const std::vector<BrokenTerm>& broken);

/// Makes the steps of a test as fine as the own terms ask for, with what [truth] and every filter
/// say of them. InputError (config) if one changes too fast even so.
void resolve_own_terms(Timeline& timeline, const Study& study);
/// The same of a recording, with what every filter says of them.
void resolve_own_terms_of_filters(Timeline& timeline, const Study& study);

}  // namespace drift::mc
