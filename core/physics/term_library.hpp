#pragma once

#include "core/physics/own/own_place.hpp"
#include "core/physics/term_list.hpp"
#include "core/physics/terms/accelerometer.hpp"
#include "core/physics/terms/accelerometer_asymmetry.hpp"
#include "core/physics/terms/accelerometer_cross.hpp"
#include "core/physics/terms/accelerometer_dead_zone.hpp"
#include "core/physics/terms/accelerometer_delay.hpp"
#include "core/physics/terms/accelerometer_ramp.hpp"
#include "core/physics/terms/accelerometer_temperature.hpp"
#include "core/physics/terms/accelerometer_temperature_curve.hpp"
#include "core/physics/terms/accelerometer_temperature_rate.hpp"
#include "core/physics/terms/azimuth_error.hpp"
#include "core/physics/terms/base_motion_leak.hpp"
#include "core/physics/terms/bistable_drift.hpp"
#include "core/physics/terms/cubic_g_drift.hpp"
#include "core/physics/terms/drift_ramp.hpp"
#include "core/physics/terms/drift_random_walk.hpp"
#include "core/physics/terms/encoder_harmonics.hpp"
#include "core/physics/terms/fixed_drift.hpp"
#include "core/physics/terms/float_restraint.hpp"
#include "core/physics/terms/frame_closure.hpp"
#include "core/physics/terms/g2_drift.hpp"
#include "core/physics/terms/g_drift.hpp"
#include "core/physics/terms/gimbal_angle_drift.hpp"
#include "core/physics/terms/gimbal_nonorthogonality.hpp"
#include "core/physics/terms/gimbal_zero.hpp"
#include "core/physics/terms/gyro_misalignment.hpp"
#include "core/physics/terms/hang_off.hpp"
#include "core/physics/terms/inner_lever_arm.hpp"
#include "core/physics/terms/latitude_error.hpp"
#include "core/physics/terms/magnetic_drift.hpp"
#include "core/physics/terms/mass_unbalance_step.hpp"
#include "core/physics/terms/misalignment_creep.hpp"
#include "core/physics/terms/outliers.hpp"
#include "core/physics/terms/output_axis_acceleration.hpp"
#include "core/physics/terms/pier_azimuth.hpp"
#include "core/physics/terms/pier_tilt.hpp"
#include "core/physics/terms/reposition_transient.hpp"
#include "core/physics/terms/sag.hpp"
#include "core/physics/terms/servo_lag.hpp"
#include "core/physics/terms/stiction.hpp"
#include "core/physics/terms/temperature_drift.hpp"
#include "core/physics/terms/temperature_drift_curve.hpp"
#include "core/physics/terms/temperature_g_drift.hpp"
#include "core/physics/terms/temperature_rate_drift.hpp"
#include "core/physics/terms/timing_skew.hpp"
#include "core/physics/terms/torquer_asymmetry.hpp"
#include "core/physics/terms/torquer_crosstalk.hpp"
#include "core/physics/terms/torquer_heating.hpp"
#include "core/physics/terms/torquer_nonlinearity.hpp"
#include "core/physics/terms/torquer_scale.hpp"
#include "core/physics/terms/torquer_temperature.hpp"
#include "core/physics/terms/warmup_drift.hpp"

namespace drift {

/// Every effect the program knows, numbered as in physics.md section 4 after the base terms. A new
/// one is its file, its include and its line here. The first seven are tested for one by one in the
/// innermost loop (TermList); they stay first. The places for a study's own terms are last.
using TermLibrary = TermList<
    terms::FixedDrift, terms::GDrift, terms::G2Drift, terms::GyroMisalignment, terms::TorquerScale,
    terms::Accelerometer, terms::FrameClosure,  //
    terms::DriftRamp, terms::WarmupDrift, terms::RepositionTransient, terms::TemperatureDrift,
    terms::TemperatureGDrift, terms::MassUnbalanceStep, terms::BistableDrift,
    terms::DriftRandomWalk, terms::CubicGDrift, terms::Sag, terms::GimbalAngleDrift,
    terms::MagneticDrift, terms::TorquerAsymmetry, terms::TorquerNonlinearity,
    terms::TorquerHeating, terms::TorquerCrosstalk, terms::HangOff, terms::Stiction,
    terms::ServoLag, terms::FloatRestraint, terms::OutputAxisAcceleration, terms::BaseMotionLeak,
    terms::MisalignmentCreep, terms::LatitudeError, terms::AzimuthError, terms::PierTilt,
    terms::PierAzimuth, terms::EncoderHarmonics, terms::GimbalNonorthogonality, terms::TimingSkew,
    terms::AccelerometerTemperature, terms::AccelerometerAsymmetry, terms::AccelerometerCross,
    terms::AccelerometerDeadZone, terms::AccelerometerRamp, terms::Outliers,  //
    terms::InnerLeverArm, terms::AccelerometerDelay,                          //
    terms::TemperatureDriftCurve, terms::TemperatureRateDrift, terms::TorquerTemperature,
    terms::AccelerometerTemperatureCurve, terms::AccelerometerTemperatureRate,  //
    terms::GimbalZero,                                                          //
    OwnPlace<0>, OwnPlace<1>, OwnPlace<2>, OwnPlace<3>, OwnPlace<4>, OwnPlace<5>>;
static_assert(TermLibrary::num_known + most_own_terms == TermLibrary::num_terms);

using TermMask = TermLibrary::Mask;
using ParamMask = TermLibrary::ParamMask;

/// All parameters of the library, SI; those of inactive terms are ignored.
using Theta = Eigen::Matrix<double, TermLibrary::num_params, 1>;

}  // namespace drift
