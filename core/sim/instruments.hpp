#pragma once

#include "core/sim/kinematics.hpp"

namespace drift {

/// Reads the instruments of a platform, without noise: one model, one set of numbers.
struct Instruments {
  const Timeline* timeline = nullptr;
  const DriftModel* model = nullptr;
  const double* theta = nullptr;  ///< every parameter of TermLibrary, SI

  /// Mean output of the accelerometers over an interval [g]. phi: at its nodes; memory(k): states
  /// of the terms at node k, null if the model has none.
  template <class Memory>
  Vec3 accelerometers(const Interval& interval, const Vec3* phi, const Memory& memory) const {
    return mean(interval, phi, memory, [&](const Inputs<double>& in) -> Vec3 {
      return accelerometer_output(*model, in, theta);
    });
  }

  /// Gimbal angles at the end of an interval [rad].
  template <class Memory>
  Vec3 gimbals(const Interval& interval, const Vec3* phi, const Memory& memory) const {
    const Needs needs = TermLibrary::needs(model->terms);
    const std::size_t last = interval.node_count() - 1;
    const Node& node = timeline->nodes[interval.last_node()];
    const Mat3 R_lp = node.R_lr * rotation(phi[last]);
    Scene<double> scene(node.omega_ic_l, interval.omega_cmd_p, model->mounting, R_lp);
    if (needs.any())
      scene.look_around(needs, moment_at(*timeline, interval, node.t), R_lp, memory(last));
    if (needs.own_rate)
      scene.around.omega_drift_p =
          drift_rate(*model, scene.in, theta, misalignment_matrix(model->mounting, interval.loop));
    return gimbal_output<double>(*model, scene.in, R_lp, interval.heading1, theta);
  }

  /// What is measured at rest in place of the gimbal angles (Interval::rest): the mean rate against
  /// the Earth that the model reads out of the gyros [rad/s].
  template <class Memory>
  Vec3 rest_rate(const Interval& interval, const Vec3* phi, const Memory& memory) const {
    const Mat3 E_loop = misalignment_matrix(model->mounting, interval.loop);
    return mean(interval, phi, memory, [&](const Inputs<double>& in) -> Vec3 {
      return platform_rate(*model, in, theta, E_loop) - in.omega_ic_p;
    });
  }

 private:
  /// Mean over an interval, by Simpson's or Boole's rule, of what is read in its nodes.
  template <class Memory, class Read>
  Vec3 mean(const Interval& interval, const Vec3* phi, const Memory& memory, Read&& read) const {
    const Needs needs = TermLibrary::needs(model->terms);
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < interval.node_count(); ++k) {
      const Node& node = timeline->nodes[interval.first_node + k];
      const Mat3 R_lp = node.R_lr * rotation(phi[k]);
      Scene<double> scene(node.omega_ic_l, interval.omega_cmd_p, model->mounting, R_lp);
      if (needs.any())
        scene.look_around(needs, moment_at(*timeline, interval, node.t), R_lp, memory(k));
      sum += Timeline::mean_weight(interval.substeps, k) * read(scene.in);
    }
    return sum;
  }
};

}  // namespace drift
