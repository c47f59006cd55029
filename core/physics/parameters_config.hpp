#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/config/section.hpp"
#include "core/physics/model_spec.hpp"

namespace drift {

/// The parameters a key stands for: one ("D_I_z"), a group ("D_I"), a term ("g_drift"), or one axis
/// of a term ("g_drift.x"). Empty if it is none of them.
ParamMask params_named(std::string_view key);

/// Keys of all terms, of all groups and of all parameters, for messages.
std::vector<std::string_view> term_keys();
std::vector<std::string_view> parameter_keys();  ///< parameters, then groups

/// Terms of the base model: what `terms` is when it is absent.
ParamMask base_parameters();

/// Keys of the terms of a model, "fixed_drift, g_drift".
std::string term_keys(const TermMask& terms);

/// The shortest list of `terms` that gives a mask: whole terms, then axes, groups, parameters.
std::vector<std::string> terms_text(const ParamMask& mask);

/// Reads `terms` of [truth] or [[filter]].
ParamMask read_terms(config::Section& section, Coupling coupling);

/// Reads the table `parameters` into spec.priors (SI); what is not named keeps its default prior.
/// A named parameter that is not active is a mistake.
void read_parameters(config::Section& section, ModelSpec& spec);

/// Value of one parameter in SI, within what its prior makes plausible; reports what is wrong.
std::optional<double> read_parameter(config::Section& table, std::string_view key,
                                     std::size_t index);

}  // namespace drift
