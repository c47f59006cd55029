#pragma once

#include <string>
#include <vector>

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "mc/study/study.hpp"

namespace drift::diagnosis {

/// The nominal filter with the parameters of some causes in it. What a cause found by profiling
/// (time constants, onsets, phases) becomes a known constant, everything else is estimated with the
/// prior that `believed` has of it, the library's by default, widened to the size found where that
/// is beyond three of its sigmas. A cause with lambda makes the coupling "lambda".
FilterSpec patched_filter(const FilterSpec& nominal, const std::vector<search::Cause>& causes);
FilterSpec patched_filter(const FilterSpec& nominal, const std::vector<search::Cause>& causes,
                          const FilterSpec& believed);

/// A filter that holds causes (those of set 0) with the prior of each size as wide as what was
/// found where that is beyond three of its sigmas: the narrow one would hold the size back, and
/// whoever reads the filter would take the parameter, or the study, for wrong.
FilterSpec with_room_for_causes(FilterSpec patched, const std::vector<search::Cause>& causes);

/// A filter that starts where causes were found, if one of their parameters is far from linear
/// (lambda, an onset, a time constant): from elsewhere an EKF, which linearises once, settles on a
/// wrong value with a small sigma, and a batch fit may find another minimum. Priors stay. The
/// causes of set 0 count.
FilterSpec started_where_found(FilterSpec patched, const std::vector<search::Cause>& causes);

/// The study file (study.text) with its first filter changed to `patched`, everything else kept:
/// terms, coupling, starts, and the priors that differ from those of the file. Complete TOML,
/// readable by read_study(). Order and values are kept, comments are not.
std::string patched_study(const mc::Study& study, const FilterSpec& patched);

/// The study file with a magnetic field in [environment], North, West, Up [T].
std::string study_with_field(const mc::Study& study, const Vec3& field_l);

/// Whether a study of this kind can declare noise that a diagnosis found, and it is significant:
/// white noise of a platform's instruments in [readout], random walks in the filters (on a case
/// that of the drift, and none of the drift beside the term drift_random_walk, which has sizes of
/// its own). No key stands for correlated noise.
bool can_be_declared(const inference::NoiseFinding& found, RecordingKind kind,
                     const FilterSpec& nominal);

/// Whether the patched study of a diagnosis declares some: not where something unexplained may be
/// what looks like noise.
bool declares_noise(const Diagnosis& d);

/// What of the noise that a diagnosis found cannot be declared: "caging_drift 0.01 deg/h".
std::vector<std::string> not_declared(const Diagnosis& d);

/// The study file with what can_be_declared() of the noise that was found: walks in every
/// filter that has as much of them as the first, since they are of the unit, whatever equation it
/// is described by.
std::string study_with_noise(const mc::Study& study,
                             const std::vector<inference::NoiseFinding>& found);

}  // namespace drift::diagnosis
