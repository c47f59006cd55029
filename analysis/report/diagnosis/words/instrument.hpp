#pragma once

#include <string_view>

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "core/physics/term.hpp"

namespace drift::report {

/// What was tested: the words of an effect are its own. Gyros on a case have a scale factor where
/// those of a platform have torquers.
enum class Instrument { platform, on_case };

inline Instrument instrument_of(const diagnosis::Diagnosis& d) {
  return d.of_case ? Instrument::on_case : Instrument::platform;
}

/// What an effect is called, and its equation, of this instrument.
std::string_view title_of(const TermInfo& term, Instrument instrument);
std::string_view equation_of(const TermInfo& term, Instrument instrument);

}  // namespace drift::report
