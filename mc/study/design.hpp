#pragma once

#include <cstdint>
#include <memory>

#include "core/physics/model_spec.hpp"
#include "core/sim/truth.hpp"
#include "mc/study/monte_carlo.hpp"

namespace drift::mc {

/// The image of k under a permutation of 0 .. n-1 that is a pure function of (seed, index).
///
/// A Feistel network of 8 rounds over the next even number of bits, walked along its cycle until it
/// is back inside (Black and Rogaway 2002): no table, so any run's stratum is there at once.
std::uint64_t permuted(std::uint64_t k, std::uint64_t n, std::uint64_t seed, std::uint32_t index);

/// Spreads the truth parameters of runs over their distributions. Initial attitudes and noise are
/// random in every design. A run's numbers are a pure function of (truth, kind, runs, seed, run).
///
/// latin_hypercube: in runs 0 .. runs-1, every parameter falls once into each of `runs` strata of
/// equal probability, in an order of its own; later runs are further hypercubes. sobol: one
/// dimension for each distributed parameter in library order, shifted digit by digit (Owen 2003).
/// Values come from uniform numbers by the inverse distribution function.
class Design {
 public:
  Design(const TruthSpec& truth, DesignKind kind, std::uint64_t runs, std::uint64_t seed);
  ~Design();
  Design(Design&&) noexcept;

  TruthDraw draw(std::uint64_t run, int chains);
  /// The same into memory that is there already.
  void draw(std::uint64_t run, int chains, TruthDraw& out);

 private:
  struct Sobol;
  double uniform(std::uint64_t run, std::size_t param) const;

  TruthSpec truth_;
  DesignKind kind_;
  std::uint64_t runs_, seed_;
  std::unique_ptr<Sobol> sobol_;  ///< of that design alone
};

}  // namespace drift::mc
