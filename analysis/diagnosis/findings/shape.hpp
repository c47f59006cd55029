#pragma once

#include <string>

namespace drift::diagnosis {

/// What a recovered signal looks like; the words are the report's.
struct Shape {
  enum class Kind {
    unknown,                ///< not looked at
    nothing,                ///< nothing above the noise
    none_simple,            ///< something, of none of the shapes below
    ramp,                   ///< grows evenly with time, in each recording from its start
    decay_from_start,       ///< dies away from there; `seconds`: time constant
    decay_in_position,      ///< the same within every position
    onset,                  ///< sets in at `seconds` and stays
    period,                 ///< swings with a period of `seconds`, by the clock of each recording
    specific_force,         ///< goes with that along `axis`
    specific_force_square,  ///< goes with the product of those along `axis` and `other_axis`
    one_position,           ///< is present in `position` alone
    one_recording,          ///< is present in `recording` alone
    covariate,              ///< goes with `covariate`
    of_cause,               ///< what a named cause makes of it
    of_alternative,         ///< what the most probable of several causes makes of it
    of_form,                ///< what a proposed form makes of it
    follows,                ///< of a recording on a case: goes with `covariate`, signed
    follows_nothing,        ///< of a recording on a case: neither with specific force nor time
  };
  Kind kind = Kind::unknown;
  double seconds = 0.0;
  int axis = 0, other_axis = 0;
  int position = 0;  ///< 1-based
  std::string covariate = {};
  int recording = 0;  ///< 1-based
};

}  // namespace drift::diagnosis
