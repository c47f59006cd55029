#pragma once

#include "analysis/diagnosis/diagnose.hpp"

namespace drift::diagnosis {

/// The study with a field declared, North, West, Up [T]: what the recording of a test shows of a
/// field that nobody measured.
mc::Study with_field(mc::Study study, const Vec3& field_l);

/// Where the magnetic field had to be assumed and a cause follows it, or may have lost by an error
/// of the field: the field is asked for (identification::field_found()). If it is another than the
/// dipole's, the recording is diagnosed once more with it, for what the error of the field leaves
/// is named as an effect otherwise; what follows it pays for a field that was read off the
/// recording. In any case its error goes into the sigmas and intervals of what follows it.
/// Elsewhere d as it is.
/// options: of the second diagnosis. InputError as diagnose().
Diagnosis with_error_of_field(Diagnosis d, const mc::Study& study,
                              const std::vector<Recording>& recordings,
                              const DiagnoseOptions& options);

}  // namespace drift::diagnosis
