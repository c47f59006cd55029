#pragma once

#include <string_view>

namespace drift::report {

/// How the sentences of a verdict begin (sentence.cpp); the terminal shows them in colour.
inline constexpr std::string_view agrees = "The recording agrees with the nominal model",
                                  something_missing = "Something is missing from the nominal model",
                                  something_may_be_missing =
                                      "Something may be missing from the nominal model";

}  // namespace drift::report
