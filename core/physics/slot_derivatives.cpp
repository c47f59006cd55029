#include "core/physics/slot_derivatives.hpp"

namespace drift {

SeenByTerms<Dependence> scene_of_dependence(const Mounting& mounting) {
  // On the way to a position of a test, hours after its start: nothing is at zero.
  static const CaseTurn turn{Vec3(0.1, -0.2, 0.3), Mat3::Constant(0.1)};
  static const Surroundings<Dependence> around = [] {
    Surroundings<Dependence> s;
    s.now = {5000.0,
             1000.0,
             true,
             0.3,
             Vec3(5e-5, 0.0, 5e-5),
             covariates_of_a_scene(),
             covariates_of_a_scene(1e-4),
             &turn};
    s.R_lp = rotation<double>(Vec3(0.4, -0.3, 0.8)).cast<Dependence>();
    s.gimbal = Vec3(0.5, -0.4, 1.1).cast<Dependence>();
    return s;
  }();
  SeenByTerms<Dependence> seen;
  seen.still.mounting = &mounting;
  seen.still.f_p = Vec3(0.48, -0.36, 0.80).cast<Dependence>();
  seen.still.omega_ic_p = Vec3(3e-5, -5e-5, 4e-5).cast<Dependence>();
  seen.still.omega_cmd_p = Vec3(2e-3, -1e-3, 3e-3);
  seen.still.around = &around;
  return seen;
}

}  // namespace drift
