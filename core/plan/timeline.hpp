#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/params/covariates.hpp"
#include "core/physics/drift_model.hpp"
#include "core/physics/earth.hpp"
#include "core/plan/test_plan.hpp"
#include "core/recording/recording.hpp"

namespace drift {

/// One sample interval: the command and the turntable rate are constant in it.
struct Interval {
  double t0 = 0.0, t1 = 0.0;  ///< [s]
  int position = 0;           ///< index into the plan, from 0
  int chain = 0;              ///< counts cagings: attitude is carried along within a chain
  bool slew = false;          ///< on the way to the position
  bool cage = false;          ///< the platform is caged at t0
  /// A recording begins at t0: the first of the timeline or one that follows, nobody knows how long
  /// after. It begins with a caging; clocks, memory and what walks begin anew with it.
  bool begins = false;
  /// The platform stands still on the Earth, whatever it is told: a strapdown unit at rest, whose
  /// "command" is what its gyros read. What the model makes of the reading beyond the Earth's rate
  /// is measured (as zero) in place of the gimbal angles.
  bool rest = false;
  Vec3 omega_cmd_p = Vec3::Zero();        ///< commanded inertial rate [rad/s]
  double heading0 = 0.0, heading1 = 0.0;  ///< of the case at t0 and t1 [rad]
  MisalignmentAngles loop =
      MisalignmentAngles::Zero();  ///< what the loop of coupling
                                   ///< "compensated" believes: eta x y z, xi x y z [rad]
  double t_begin = 0.0;            ///< when its recording began [s]
  double t_dwell = 0.0;            ///< when the dwell of the position begins [s]
  Covariates around0, around1;     ///< at t0 and t1, linear in between; zero where not known
  double samples = 1.0;   ///< of the plan, averaged by the accelerometers: less noise by its root
  double readings = 1.0;  ///< of the gimbals that its angles are worth, likewise
  std::optional<CaseTurn> turn;  ///< of a case whose accelerometers are read while it turns
  bool fine = false;             ///< its steps are as fine as a study's own term asks for
  std::size_t first_node = 0;    ///< nodes first_node .. first_node + 2 substeps
  int substeps = 1;              ///< steps of two nodes each (place_nodes())

  double length() const { return t1 - t0; }
  /// 1 sigma of the accelerometers' means, `of_a_sample` declared for one sample of the plan.
  double accelerometer_noise(double of_a_sample) const { return of_a_sample / std::sqrt(samples); }
  /// 1 sigma of its gimbal angles, `of_a_reading` declared for one.
  double gimbal_noise(double of_a_reading) const { return of_a_reading / std::sqrt(readings); }
  double heading_rate() const { return (heading1 - heading0) / length(); }
  std::size_t node_count() const { return 2 * static_cast<std::size_t>(substeps) + 1; }
  std::size_t middle_node() const { return first_node + static_cast<std::size_t>(substeps); }
  std::size_t last_node() const { return first_node + node_count() - 1; }
};

/// An instant at which the platform is looked at, with all that does not depend on the run: the
/// reference frame r (nominal platform, in closed form) and the surroundings.
struct Node {
  double t = 0.0;
  Mat3 R_lr;        ///< reference attitude, v_l = R_lr v_r
  Mat3 R_lr_half;   ///< the same half way to the next node
  Mat3 R_il;        ///< local to the inertial frame that is local at the caging of the chain
  Vec3 omega_ic_l;  ///< inertial rate of the case, local axes [rad/s]
};

/// One of several recordings in a timeline.
struct JoinedRecording {
  std::string name;  ///< file, or "recording 2"
  CovariateSet carried = 0;
  double offset = 0.0;  ///< time of the timeline less its own [s]
};

/// A test laid out in time: what a simulation and an estimator run along.
struct Timeline {
  Site site;
  std::vector<Interval> intervals;
  std::vector<Node> nodes;
  int chains = 0;
  int positions = 0;
  bool of_case = false;      ///< of a strapdown unit: its dwells are at rest (Interval::rest)
  bool reads_turns = false;  ///< accelerometers are read in turns, too (Interval::turn)
  CovariateSet carried = 0;  ///< covariates that the intervals have
  std::vector<JoinedRecording> recordings;  ///< in order, of several; empty of one
  Covariates mean;                          ///< what numbers deviate from; zero for all others
  bool loop_told = false;  ///< Interval::loop is what a loop removed: simulated so, or recorded
  std::vector<std::string> without_loop;  ///< recordings that do not tell what it removed

  bool carries(const CovariateSpec& c) const { return (carried & c.set()) != 0; }
  /// Whether it carries what a term, or a model, wants to see.
  bool carries(const Needs& needs) const {
    return (reads_turns || !needs.turning) && (needs.covariates & ~carried) == 0;
  }
  /// Numbers from 0 of the recordings that lack some of `wanted`, where others have all of it.
  std::vector<std::size_t> lacking(CovariateSet wanted) const;
  /// A vector that is the same all the time, local axes.
  void set_vector(const CovariateSpec& c, const Vec3& value_l) {
    for (Interval& i : intervals) i.around0.vector(c) = i.around1.vector(c) = value_l;
    carried |= c.set();
  }

  /// Weight of node k in the mean over an interval: composite Simpson's rule, or where substeps are
  /// even, two by two, Boole's, which is of the sixth order; they sum to 1.
  static double mean_weight(int substeps, std::size_t k);
};

/// Lays a plan out: caging or slews and turns of the case on the way to each position, then the
/// dwell. The case heads so that the middle gimbal stays below 60 deg, and is turned when it must.
/// InputError (config) if no heading can do that.
Timeline lay_out(const TestPlan& plan, const Site& site);

/// The same from a recording: its times, positions, commands and headings. What the recording does
/// not say comes from the plan. InputError (recording) if they do not fit each other. ContractError
/// if it has no time or position, or channels of unequal lengths (check_recording()).
Timeline lay_out(const Recording& recording, const TestPlan& plan, const Site& site);

/// Computes the nodes from the intervals. R_lp is the nominal attitude at the start of each chain;
/// longest_step: attitude change between the end points of Simpson's rule [rad], of which a turn of
/// the case counts a fifth; Boole's goes over twice as much. An interval that has more substeps
/// keeps them. The clocks follow from `begins`, which the first interval has in any case.
void place_nodes(Timeline& timeline, const std::vector<Mat3>& R_lp, double longest_step = 0.05);

}  // namespace drift
