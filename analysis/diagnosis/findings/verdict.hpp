#pragma once

#include "core/base/named.hpp"

namespace drift::diagnosis {

/// What a diagnosis ends with (analysis/docs/diagnose.md).
enum class Verdict { consistent, named, ambiguous, unexplained };
inline constexpr Named<Verdict> verdicts[] = {{"consistent", Verdict::consistent},
                                              {"named", Verdict::named},
                                              {"ambiguous", Verdict::ambiguous},
                                              {"unexplained", Verdict::unexplained}};
constexpr std::string_view text(Verdict v) {
  return name_in(verdicts, v);
}

}  // namespace drift::diagnosis
