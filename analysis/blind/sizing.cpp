#include "analysis/blind/sizing.hpp"

#include <cmath>

namespace drift::blind {

SizingBench::SizingBench(World world, const FilterSpec& nominal, std::uint64_t seed,
                         std::uint64_t run)
    : world_(std::move(world)),
      seed_(seed),
      run_(run),
      clean_(simulate_clean(world_, seed, run)),
      absorption_(nominal, world_.timeline, world_.readout, clean_.measured, world_.draw.theta,
                  world_.draw.psi0_l) {}

HiddenEffect SizingBench::Sized::effect() const {
  HiddenEffect e = source.effect;
  e.parameters = source.parameters(strength);
  e.size = size.left;
  e.absorbed = size.absorbed;
  return e;
}

VecX SizingBench::signal(const Source& source, double strength) const {
  World with = world_;
  source.put(with, strength);
  return absorption_.signal(simulate_clean(with, seed_, run_).measured, clean_.measured);
}

std::optional<SizingBench::Sized> SizingBench::fit_strength(const Source& source,
                                                            double size) const {
  constexpr int most_steps = 6;
  constexpr double close_enough = 0.01;
  Sized s{source, source.first, {}, {}};
  for (int k = 0; k < most_steps; ++k) {
    s.signal = signal(source, s.strength);
    s.size = absorption_.size_of(s.signal);
    const double ratio = size / s.size.left;
    if (!std::isfinite(ratio)) return std::nullopt;
    if (std::abs(ratio - 1.0) < close_enough) return s;
    // An effect that is far too weak at its largest will not be found at the next step either.
    if (s.strength * ratio > source.most * (k == 0 ? 2.0 : 1.0)) return std::nullopt;
    s.strength = std::min(s.strength * ratio, source.most);
  }
  return std::nullopt;
}

}  // namespace drift::blind
