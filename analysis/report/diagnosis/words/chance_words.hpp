#pragma once

#include <string>

#include "analysis/diagnosis/findings/diagnosis.hpp"

namespace drift::report {

/// "shows as much with a chance of 0.2".
std::string shows_as_much(double p_value);

/// Why what noise alone seldom shows is taken for noise: nothing is more probable.
std::string chance_text(const diagnosis::Diagnosis& d);

/// The other way round: why what noise alone shows may be an effect, and how probable is what;
/// empty where the verdict is another one.
std::string likelier_missing_text(const diagnosis::Diagnosis& d);

}  // namespace drift::report
