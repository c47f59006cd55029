#pragma once

#include <string>
#include <vector>

#include "core/config/section.hpp"
#include "core/params/param_spec.hpp"

namespace drift {

/// The parameters of one own term: what its equation calls them, and what the library knows.
struct OwnParameters {
  std::vector<std::string> names;
  std::vector<ParamSpec> specs;  ///< named term_name
};

/// Reads `parameters` of a [[term]], { A = { unit = "deg/h", prior = 0.01 }, ... }: with a prior an
/// amplitude, with a value a known setting, with both a setting that is estimated; `grid` lists the
/// values over which a setting is profiled. Numbers are in the parameter's unit.
OwnParameters read_own_parameters(config::Section& term, const std::string& term_key);

/// Whether a word may be the name of a term or of a parameter: letters, figures and _, not a figure
/// first.
bool is_name(std::string_view word);

}  // namespace drift
