#pragma once

#include "core/physics/terms/accelerometer.hpp"
#include "core/physics/terms/fixed_drift.hpp"
#include "core/physics/terms/frame_closure.hpp"
#include "core/physics/terms/g2_drift.hpp"
#include "core/physics/terms/g_drift.hpp"
#include "core/physics/terms/gyro_misalignment.hpp"
#include "core/physics/terms/torquer_scale.hpp"

namespace drift {

/// Every effect the program knows. A new one is its file, its include and its line here.
using TermLibrary = TermList<terms::FixedDrift, terms::GDrift, terms::G2Drift,
                             terms::GyroMisalignment, terms::TorquerScale, terms::Accelerometer,
                             terms::FrameClosure>;

using TermMask = TermLibrary::Mask;
using ParamMask = TermLibrary::ParamMask;

/// All parameters of the library, SI; those of inactive terms are ignored.
using Theta = Eigen::Matrix<double, TermLibrary::num_params, 1>;

}  // namespace drift
