#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/diagnosis/findings/remark.hpp"

namespace drift::diagnosis {

/// A term of the library that was no candidate.
struct NotExamined {
  enum class Why {
    no_covariate,  ///< neither the recording nor the study has what it follows
    no_swing,      ///< the temperature is known, and has hardly moved
    no_turns,      ///< the accelerometers of a case are not read while it turns
    beyond_reach,  ///< VisibleLimits::information: only if some forty times as large as usual
  };
  std::string term;
  Why why = Why::no_covariate;
  /// Named causes that it may stand behind: they act on the same instruments by the clock alone, as
  /// it would if what it follows had moved like that.
  std::vector<NamedEffect> twins;
  std::string instead = {};  ///< what was read of what it may follow, and why that is not used
  CovariateSet missing = 0;  ///< of what it follows
  /// Numbers from 0 of the recordings that lack it, where others have it; empty where none has.
  std::vector<std::size_t> lacking = {};
};

}  // namespace drift::diagnosis
