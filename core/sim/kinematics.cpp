#include "core/sim/kinematics.hpp"

namespace drift {

Vec3 attitude_rate(const Drive& drive, const Mat3& R_lr, const Vec3& phi, double t,
                   const double* memory) {
  const Mat3 R_rp = rotation(phi);
  const Mat3 R_lp = R_lr * R_rp;
  Scene<double> scene(drive.omega_ic_l, drive.omega_cmd_p, drive.model->mounting, R_lp);
  if (drive.needs.any())
    scene.look_around(drive.needs, moment_at(*drive.timeline, *drive.interval, t), R_lp, memory);
  const Vec3 omega_ip_p =
      platform_rate(*drive.model, scene.in, drive.theta, drive.E_loop) + drive.omega_noise_p;
  return rotation_vector_rate(phi, R_rp, omega_ip_p, drive.omega_cmd_p);
}

Vec3 attitude_rate_l(const Drive& drive, const Mat3& R_lr, const Vec3& chi, double t,
                     const double* memory) {
  const Vec3 phi = R_lr.transpose() * chi;
  const Vec3 phi_rate = attitude_rate(drive, R_lr, phi, t, memory);
  return R_lr * (phi_rate + drive.omega_cmd_p.cross(phi)) - drive.omega_ie_l.cross(chi);
}

}  // namespace drift
