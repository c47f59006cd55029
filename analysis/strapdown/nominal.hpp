#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/strapdown/held_out.hpp"
#include "core/physics/model_spec.hpp"

namespace drift::strapdown {

/// A part of a strapdown model that a nominal model may lack.
struct PartOfModel {
  std::string_view term;                 ///< key of interfaces.md 5
  std::string_view label;                ///< for tables
  std::string_view ending;               ///< of the name of the trial that adds it
  std::vector<std::string_view> groups;  ///< its parameters
  bool accelerometer = false;
};

/// All parts, in the order in which they are tried.
const std::vector<PartOfModel>& parts_of_model();

/// The model that a filter describes: the largest rung of every ladder of which it estimates a
/// parameter.
Model nominal_model(const FilterSpec& filter);

/// Whether a model holds a part.
bool holds(const Model& model, const PartOfModel& part);

}  // namespace drift::strapdown
