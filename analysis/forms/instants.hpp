#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/plan/timeline.hpp"

namespace drift::forms {

/// Something that forms multiply, as an equation writes it, in the middle of every interval.
struct Quantity {
  std::string text;  ///< "f_x", "(omega_ic_y/7.292e-05)"
  int g = 0;         ///< power of g in its unit; everything else is written as a plain number
  VecX value;        ///< of the text, shape intervals
};

/// What the equation of a [[term]] may name, along the nominal path of a test.
struct Instants {
  VecX t, t_position;                ///< [s]
  std::vector<int> position;         ///< from 0
  std::array<VecX, 3> force;         ///< f_x, f_y, f_z [g]
  std::array<VecX, 3> gimbal;        ///< outer, middle, inner [rad]
  std::vector<Quantity> quantities;  ///< those that are not zero throughout

  Eigen::Index size() const { return t.size(); }
};

/// Specific force, rates and commands, and the covariates that the test carries. f_I, f_O and f_S
/// are f_x, f_y and f_z in another order.
Instants instants_of(const Timeline& timeline);

}  // namespace drift::forms
