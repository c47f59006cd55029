#pragma once

#include <cmath>
#include <string_view>
#include <vector>

#include "core/base/fnv.hpp"
#include "core/physics/model_spec.hpp"

namespace drift {

/// The numbers behind one run: a pure function of (truth, seed, run).
struct TruthDraw {
  Theta theta = Theta::Zero();  ///< SI; zero where inactive
  std::vector<Vec3> psi0_l;     ///< attitude error of each chain at its caging, local axes [rad]
};

/// Streams are named by parameter key, so that a new parameter leaves the draws of all others
/// alone.
constexpr std::uint32_t stream_index(std::string_view key) {
  const auto h = fnv1a<std::uint32_t>(key);  // folded to 24 bits
  return (h >> 24) ^ (h & 0xffffffu);
}

/// Draws every active parameter from its distribution.
inline Theta draw_parameters(const ModelSpec& spec, std::uint64_t seed, std::uint64_t run,
                             Purpose purpose) {
  Theta theta = Theta::Zero();
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i) {
    if (!spec.active[i]) continue;
    Stream stream(seed, run, purpose, stream_index(TermLibrary::specs[i].key));
    theta[i] = spec.priors[i].draw(stream);
  }
  return theta;
}

/// Initial attitude errors of run number `run`, one for each chain, local axes [rad].
inline void draw_attitudes(const ModelSpec& spec, int chains, std::uint64_t seed, std::uint64_t run,
                           std::vector<Vec3>& psi0_l) {
  Stream stream(seed, run, Purpose::initial_attitude);
  psi0_l.resize(static_cast<std::size_t>(chains));
  for (Vec3& psi : psi0_l)
    for (int a = 0; a < 3; ++a) psi[a] = spec.initial_attitude * stream.normal();
}

/// Parameters and initial attitudes of run number `run`.
inline TruthDraw draw_truth(const TruthSpec& truth, int chains, std::uint64_t seed,
                            std::uint64_t run) {
  TruthDraw draw{draw_parameters(truth, seed, run, Purpose::parameters), {}};
  draw_attitudes(truth, chains, seed, run, draw.psi0_l);
  return draw;
}

/// The lambda of a truth whose coupling is no member of the family by name: the integrating servo
/// closes like eq. (6) (physics.md 1.5); with a restraint of the floats, or compensated, it has
/// none.
inline void set_lambda(const TruthSpec& truth, Theta& theta) {
  if (truth.coupling == Coupling::lambda) return;
  const bool leaks = truth.coupling == Coupling::servo && truth.servo.float_restraint != 0.0;
  const auto lambda = facts(facts(truth.coupling).settles_to).lambda;
  theta[closure_param] = leaks || !lambda ? std::nan("") : *lambda;
}

}  // namespace drift
