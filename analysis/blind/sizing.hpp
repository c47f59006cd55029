#pragma once

#include <optional>

#include "analysis/blind/absorption.hpp"
#include "analysis/blind/world.hpp"

namespace drift::blind {

/// A world and what its nominal fit can absorb: where the strength of a source is found.
class SizingBench {
 public:
  SizingBench(World world, const FilterSpec& nominal, std::uint64_t seed, std::uint64_t run);

  /// A source at the strength that gives it a wanted size.
  struct Sized {
    Source source;
    double strength = 0.0;
    Absorption::Size size;
    VecX signal;  ///< in declared sigmas
    /// The key's words about it.
    HiddenEffect effect() const;
  };
  /// Strength by secant steps on the full dynamics until the size is within 1 %. Empty if the
  /// source would have to be implausibly strong, or does nothing here.
  std::optional<Sized> fit_strength(const Source& source, double size) const;

  /// What a source adds to the measurements at a strength, in declared sigmas.
  VecX signal(const Source& source, double strength) const;

  const World& world() const { return world_; }
  const Absorption& absorption() const { return absorption_; }

 private:
  World world_;
  std::uint64_t seed_, run_;
  Simulation clean_;
  Absorption absorption_;
};

}  // namespace drift::blind
