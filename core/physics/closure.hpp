#pragma once

#include "core/physics/coupling.hpp"
#include "core/physics/term_library.hpp"

namespace drift {

/// The parameter that says which drift equation holds, lambda, and the term that holds it. Unlike
/// all others it is no small effect: it turns one equation into another.
inline constexpr std::size_t closure_param = TermLibrary::index("lambda");
inline constexpr std::string_view closure_term =
    TermLibrary::known_terms[TermLibrary::term_index("frame_closure")].key;

/// The value a parameter has in a model that leaves it out: none of the effect, but lambda as the
/// equation has it.
constexpr double value_left_out(std::size_t param, Coupling coupling) {
  return param == closure_param ? facts(coupling).lambda.value_or(0.0) : 0.0;
}

/// Whether a term is of the base model; in the library those stand before the closure.
constexpr bool is_base(const TermInfo& term) {
  return term.first < closure_param;
}

}  // namespace drift
