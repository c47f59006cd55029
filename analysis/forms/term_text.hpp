#pragma once

#include <string>
#include <vector>

#include "analysis/forms/form.hpp"

namespace drift::forms {

/// The equation of a form: "(A*cos(2*pi*t/P) + B*sin(2*pi*t/P))*step(abs(f_z) - C)".
std::string equation_of(const Form& form, const Instants& at);

/// The form as a [[term]]. largest: of the amplitudes found, SI; their prior has it within a sigma.
/// Settings are written with the digits they are known to; those that a fit may move have their
/// sigma as prior.
std::string term_text(const Form& form, const Instants& at, const std::string& key, double largest);

/// The unit of the amplitudes of a form.
Unit amplitude_unit(const Form& form, const Instants& at);

}  // namespace drift::forms
