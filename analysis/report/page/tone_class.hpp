#pragma once

#include <string_view>

#include "analysis/report/page/table.hpp"

namespace drift::report {

/// The class that gives a tone its colour (page_style), after a space; empty for a plain one.
inline std::string_view tone_class(Tone tone) {
  switch (tone) {
    case Tone::good:
      return " good";
    case Tone::doubtful:
      return " doubtful";
    case Tone::bad:
      return " bad";
    case Tone::plain:
      break;
  }
  return "";
}

}  // namespace drift::report
