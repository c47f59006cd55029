#pragma once

#include <array>
#include <memory>

#include "core/base/dual.hpp"
#include "core/ode/cvode.hpp"
#include "core/physics/servo.hpp"
#include "core/sim/trajectory.hpp"

namespace drift {

/// The platform's equations of motion in CVODE, one segment after the other. The attitude is the
/// rotation vector against the closed-form reference (physics.md 6.1), in local axes, in which it
/// does not turn with the command; coupling "servo" adds the 12 states of the loop, and has it in
/// axes of the reference. One per thread; not copied or moved while in use.
class PlatformOde {
 public:
  PlatformOde(const DriftModel& model, const ServoOptions& servo, const OdeOptions& options);

  /// Integrates intervals first..end-1, which have one command, turntable rate and loop estimate,
  /// and writes phi at their nodes. memory: of the whole timeline, if a term has any. psi0_l:
  /// attitude error at the caging that starts the segment [rad]; null: the platform goes on from
  /// where the last segment ended.
  OdeResult segment(const Timeline& timeline, std::size_t first, std::size_t end,
                    const Theta& theta, const Vec3& omega_noise_p, const Vec3* psi0_l,
                    Trajectory& phi, const MemoryRecord* memory = nullptr);
  /// The longest step of the segments that follow [s]; 0: as long as the tolerances allow.
  void limit_steps(double longest) { ode_.limit_steps(longest); }
  OdeStats stats() const { return ode_.stats(); }

  static constexpr int servo_states = ServoState::size + 3;  ///< loop, then phi

 private:
  /// Bound by address into CVODE, so it stays where it is.
  struct Problem {
    DriftModel model;
    ServoOptions servo;
    Drive drive;
    Site site;
    Mat3 R_lr0 = Mat3::Identity();  ///< reference attitude at the start of the segment
    double t0 = 0.0, heading0 = 0.0, heading_rate = 0.0;
    const MemoryRecord* memory = nullptr;
    std::size_t first = 0, end = 0;  ///< intervals of the segment
    /// All parameters as constants of the differentiation.
    std::array<Dual<servo_states>, TermLibrary::num_params> theta_dual{};

    Mat3 reference(double t) const;
    const Interval& interval_at(double t) const;
    template <class S>
    struct SceneAt;
    Vec3 base_motion_l(double t) const;  ///< [rad/s]
    bool reduced(double t, const double* y, double* y_dot) const;
    template <class S>
    void loop(double t, const S* y, S* y_dot) const;
  };
  struct Rhs {
    const Problem* problem;
    bool operator()(double t, const double* y, double* y_dot) const;
  };
  struct Jacobian {
    const Problem* problem;
    bool operator()(double t, const double* y, double* J) const;
  };

  std::unique_ptr<Problem> problem_;
  std::unique_ptr<Rhs> rhs_;
  std::unique_ptr<Jacobian> jacobian_;
  Cvode ode_;
  std::array<double, servo_states> y_{};
};

}  // namespace drift
