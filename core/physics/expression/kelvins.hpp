#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/physics/expression/tree.hpp"

namespace drift {

/// A parameter in K as it stands in a study.
struct KelvinParameter {
  std::string name;
  double value = 0.0;  ///< [K]
};

/// Where an equation would take a temperature on the Kelvin scale for one in degC, in which it has
/// columns of temperatures: a parameter in K in a sum, or beside one in min and max, in which one
/// column more is added than is taken away ("oil - C"). Where as many are ("oil - box - C"), it is
/// a difference, which is the same in both. In degC a parameter may be either.
/// columns: inputs from this one on are columns of the recording. kelvins: of each parameter;
/// nothing where it is in another unit.
std::optional<EquationMistake> mistake_of_kelvins(
    const EquationTree& tree, std::size_t columns,
    const std::vector<std::optional<KelvinParameter>>& kelvins);

}  // namespace drift
