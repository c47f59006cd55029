#pragma once

#include <string>
#include <vector>

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "analysis/report/page/json.hpp"

namespace drift::report {

/// What follows the magnetic field, of the causes and of parameters far from their priors: labels.
std::vector<std::string> following_field(const diagnosis::Diagnosis& d);

/// What is said of a field that nobody measured, behind the verdict, with a blank before it; ""
/// where nothing follows it.
std::string field_text(const diagnosis::Diagnosis& d);
/// The same as a doubt of its own: what to do.
std::string field_doubt(const diagnosis::Diagnosis& d);
/// The field that a diagnosis took in place of a measured one [gauss], North, West, Up; or null.
Json field_json(const diagnosis::Diagnosis& d);

}  // namespace drift::report
