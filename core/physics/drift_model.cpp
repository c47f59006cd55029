#include "core/physics/drift_model.hpp"

namespace drift {

static_assert(TermLibrary::unique_keys(), "two parameters have the same key");

Mat3 misalignment_matrix(const Mounting& mounting, const MisalignmentAngles& angles) {
  Inputs<double> in;
  in.mounting = &mounting;
  RateAssembly<double> out;
  terms::GyroMisalignment::rates(in, angles.data(), out);
  return out.E_gp;
}

DRIFT_SELDOM(double, );
DRIFT_SELDOM(Dual<15>, );

}  // namespace drift
