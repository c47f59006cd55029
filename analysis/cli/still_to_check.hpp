#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mc/study/study.hpp"

namespace drift::cli {

/// The latitude that `new` writes where a recording says none.
inline constexpr std::string_view guessed_latitude = "45 deg";

/// Something that `new` guessed and nobody has said to be right: a clause "...: check" of a
/// comment.
struct StillToCheck {
  int line = 0;
  std::string value;  ///< what stands before the comment, empty if that is long or nothing
  std::string what;   ///< "of the laboratory"
};

/// What a study file says is to be checked, but for values that the command line gives.
std::vector<StillToCheck> still_to_check(const mc::Study& study);

/// A line for each, and how to be rid of it; empty if there is none.
std::string still_to_check_text(const mc::Study& study);

}  // namespace drift::cli
