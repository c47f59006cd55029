#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/physics/drift_model.hpp"
#include "core/plan/test_plan.hpp"

namespace drift::mc {

/// How many of the trials of a blind study hide what; weights, not fractions.
struct BlindShares {
  double null = 20.0;         ///< nothing
  double wrong_noise = 15.0;  ///< nothing but noise that is not as declared
  double single = 40.0;       ///< one effect of the library
  double pair = 10.0;         ///< two at once
  double outside = 8.0;       ///< an effect that is not in the library
  double local = 7.0;         ///< a disturbance in one position, window and equation

  double sum() const { return null + wrong_noise + single + pair + outside + local; }
};

/// Harder trials, by number, beside those that the shares deal out: they come after them and change
/// none of their draws.
struct BlindFurther {
  std::uint64_t other_equation = 0;   ///< the nominal equation is the wrong one
  std::uint64_t noisy_single = 0;     ///< one effect of the library, noise not as declared
  std::uint64_t noisy_covariate = 0;  ///< one that follows a covariate, recorded with noise

  std::uint64_t sum() const { return other_equation + noisy_single + noisy_covariate; }
};

/// [blind] of a study file: which recordings with concealed effects are made
/// (analysis/docs/blind.md).
struct BlindSpec {
  std::uint64_t trials = 300;  ///< that the shares deal out
  std::vector<std::string> plans{"twelve", "twentyfour", "slew12"};
  std::vector<CommandLaw> modes{CommandLaw::free};
  std::vector<Coupling> couplings{Coupling::eq5, Coupling::eq6};  ///< of the truth
  std::vector<double> sizes;              ///< of single and local effects [sigma]; empty: drawn
  double smallest = 3.0, largest = 14.0;  ///< drawn uniformly between [sigma]
  double pair_size = 10.0;                ///< of each of two effects [sigma]
  double pair_cosine = 0.7;               ///< largest |cosine| of the two projected signatures
  double outside_size = 15.0;             ///< [sigma]
  double most_prior_sigmas = 3.0;  ///< an effect that would need more is not hidden on this plan
  BlindShares shares;
  BlindFurther further;

  std::uint64_t all_trials() const { return trials + further.sum(); }
};

}  // namespace drift::mc
