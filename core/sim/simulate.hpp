#pragma once

#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "core/ode/ode_options.hpp"
#include "core/ode/ode_result.hpp"
#include "core/sim/measurements.hpp"
#include "core/sim/memory_path.hpp"
#include "core/sim/own_term_steps.hpp"
#include "core/sim/trajectory.hpp"
#include "core/sim/truth.hpp"

namespace drift {

/// One simulated test.
struct Simulation {
  OdeResult ode;  ///< not ok: the run failed, the rest is not to be used; a sample that is to be
                  ///< measured and is no finite number fails it, too
  OdeStats cost;
  TruthDraw draw;
  Theta theta_end = Theta::Zero();  ///< as draw.theta, but D_F where its random walk and its jumps
                                    ///< have led
  Trajectory phi;                   ///< at every node [rad]
  Measurements measured;
};

/// The truth: integrates the platform under any coupling with CVODE and reads its instruments.
///
/// Algebraic couplings: 3 states, Adams. Servo: 15 states (loop and attitude), BDF with a Jacobian
/// by forward differentiation. A stretch of constant command is one segment, ended by a stop time;
/// the integrator is started again for the next and never steps across. With process noise every
/// interval is a segment, the noise constant in it. Where own terms drive the platform no step is
/// longer than they ask for (OwnTruthSteps).
///
/// One per thread, used for many runs; a run is a pure function of (truth, timeline, seed, run).
class Simulator {
 public:
  Simulator(const TruthSpec& truth, const Readout& readout);
  Simulator(const TruthSpec& truth, const Readout& readout, const OdeOptions& options);
  ~Simulator();
  Simulator(Simulator&&) noexcept;

  /// A whole run.
  Simulation run(const Timeline& timeline, std::uint64_t seed, std::uint64_t run);
  /// The same with given numbers instead of drawn ones.
  Simulation run(const Timeline& timeline, const TruthDraw& draw, std::uint64_t seed,
                 std::uint64_t run);

  /// A further rate of the platform [rad/s], platform axes, for every interval of the timelines
  /// that follow and constant in it: what no term of the library makes. Empty: none. shape (3,
  /// intervals).
  void disturb(Mat3X omega_p) { disturbance_ = std::move(omega_p); }

  /// The same into `out`, whose memory is used again.
  void run(const Timeline& timeline, const TruthDraw& draw, std::uint64_t seed, std::uint64_t run,
           Simulation& out);

  /// In pieces, for loops that are fed back from a filter: begin, then extend over the intervals in
  /// order. What `timeline` says of an interval may change until it is extended over.
  void begin(const Timeline& timeline, const TruthDraw& draw, std::uint64_t seed, std::uint64_t run,
             Simulation& out);
  void extend(const Timeline& timeline, std::size_t first, std::size_t end, Simulation& out);

  /// Integration tolerances that hold 0.004 arcsec and better (physics.md 6.2).
  static OdeOptions default_options(Coupling coupling);

 private:
  struct Engine;
  void integrate(const Timeline& timeline, std::size_t first, std::size_t end, Simulation& out);
  Theta drift_of(const Timeline& timeline, std::size_t i, const Theta& drawn);
  void measure(const Timeline& timeline, std::size_t i, Simulation& out);
  void judge_samples(const Timeline& timeline, std::size_t first, std::size_t end, Simulation& out);
  const Vec3* turned_between(const Timeline& timeline, std::size_t i, const Vec3* phi);
  std::size_t segment_end(const Timeline& timeline, std::size_t first, std::size_t end,
                          bool noisy) const;
  double wrong_by(std::size_t channel, const Theta& theta);

  TruthSpec truth_;
  Readout readout_;
  DriftModel model_;
  std::unique_ptr<Engine> engine_;
  OwnTruthSteps own_steps_;
  Mat3X disturbance_;
  std::array<std::optional<Stream>, 6> sensor_noise_, process_noise_, wrong_samples_;
  std::array<std::optional<Stream>, 3> drift_level_, between_ends_;
  std::vector<Vec3> phi_between_;  ///< of an interval, as its mean specific force feels it
  std::array<double, 3> level_{};  ///< of a bistable drift, +-1
  MemoryRecord memory_;
  Theta theta_;  ///< with the drift's random walk
};

/// Gives every interval the loop estimate of a truth with coupling "compensated" and `given`
/// estimate.
void set_loop(Timeline& timeline, const TruthSpec& truth);

}  // namespace drift
