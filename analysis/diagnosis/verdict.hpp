#pragma once

#include <string_view>

namespace drift::diagnosis {

/// What a diagnosis ends with (interfaces.md 6).
enum class Verdict { consistent, named, ambiguous, unexplained };

constexpr std::string_view text(Verdict v) {
  switch (v) {
    case Verdict::consistent:
      return "consistent";
    case Verdict::named:
      return "named";
    case Verdict::ambiguous:
      return "ambiguous";
    case Verdict::unexplained:
      break;
  }
  return "unexplained";
}

}  // namespace drift::diagnosis
