#pragma once

#include <vector>

#include "core/estimate/layout.hpp"
#include "core/plan/readout.hpp"
#include "core/plan/timeline.hpp"

namespace drift::bench {

/// A few rows without a detour over the heap: a step is one piece of memory, read in one go.
using InPlace = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor, 3, 40>;

/// What one step of a filter needs: to the middle, accelerometers, to the end, gimbals.
struct Step {
  bool cage = false;
  Mat3 Phi_half, Phi_rest;
  InPlace G_half, G_rest, H_par;
  Mat3 H_acc, H_gimbal;
  Vec3 nu_acc, nu_gimbal;
};

struct Problem {
  Readout readout;
  FilterSpec filter;
  Timeline timeline;
  Layout layout;
  std::vector<Step> steps;

  Eigen::Index states() const { return 3 + static_cast<Eigen::Index>(layout.size()); }
  Eigen::Index rate_states() const { return static_cast<Eigen::Index>(layout.num_rate); }
};

/// The matrices of every step of six positions in free drift, along the platform's motion with
/// parameters drawn from the prior, all base terms. sample: [s].
Problem make_problem(double sample);

}  // namespace drift::bench
