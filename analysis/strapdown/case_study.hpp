#pragma once

#include <string>
#include <vector>

#include "analysis/preparation/noise_card.hpp"
#include "core/estimate/strapdown/gyrocompass.hpp"
#include "core/physics/model_spec.hpp"
#include "core/recording/saturation.hpp"
#include "mc/study/study.hpp"

namespace drift::strapdown {

/// A recording of sensors on a case, made ready as a test of a platform (case_test.hpp).
struct CaseStudy {
  std::string source;
  std::vector<std::string> remarks;  ///< what of the recording is left out, or looks wrong
  std::string saturated;             ///< of gyros at the end of their range; or ""
  double static_min = 0.0;           ///< shortest dwell that counts [s]
  std::vector<std::string> all_remarks() const;  ///< what is said of saturation first
  DwellSearch search;
  Gyrocompass compass;
  CaseTest test;
  preparation::NoiseCard noise;  ///< of the sensors in the dwells
  /// Where the fit of a unit begins whose gyros do not see the Earth: accelerometers as gravity in
  /// the dwells has them, fixed drift as the gyros read it there.
  Theta start = Theta::Zero();

  MeasuredTest measured() const { return {test.timeline, test.readout, test.measured}; }
};

/// Of the gyros' fixed drift, as the study's first filter has it: the widest axis [rad/s].
double drift_prior(const mc::Study& study);

/// The noise of the sensors in the dwells.
preparation::NoiseCard noise_of(const Recording& recording, const DwellSearch& search);

/// Takes out what a logger writes where it has read nothing, and what a stuck sensor reads, or a
/// gyro at the end of its range; the last comes back.
std::vector<Saturation> leave_out_not_measured(Recording& recording,
                                               std::vector<std::string>& remarks);

/// Finds the dwells, levels and gyrocompasses, lays out. The prior of the gyros' fixed drift is
/// that of the study's first filter. A unit whose gyros do not see the Earth is laid out one way at
/// a time, levelled by accelerometers that are calibrated on gravity where there are dwells enough.
/// What was not measured, or by a sensor that is stuck or at the end of its range, is left out and
/// remarked.
/// InputError: recording if the recording is not as files are read (check_recording()), the
/// channels are not there or the unit never rests; config as mc::require_own_terms().
CaseStudy case_study(const mc::Study& study, const Recording& recording);

/// A filter of the study as it is a platform's: what the gyros read is its command. Eqs. (5) and
/// (6) change places. (5) says that misalignment has its part in what the gyros read of the motion,
/// as eq. (6) says of what a platform makes of a command; (6) that it has none. Attitude at the
/// start as the gyrocompass leaves it: what it is sure of it has from the same data, so ten times
/// that. Of gyros that do not see the Earth the priors are a consumer's (consumer_grade.hpp).
FilterSpec case_filter(const FilterSpec& filter, const CaseStudy& of);

/// Where the fit of such a filter starts: at its prior means, and at what is known of what it
/// estimates.
Theta start_of(const FilterSpec& case_filter, const CaseStudy& of);

}  // namespace drift::strapdown
