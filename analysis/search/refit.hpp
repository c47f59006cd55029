#pragma once

#include "analysis/search/examination.hpp"

namespace drift::search {

/// A model with causes put in, fitted again through the full dynamics.
struct Refit {
  std::vector<Choice> choices;  ///< into the nominal examination's candidates
  FilterSpec filter;
  Examination after;     ///< scored again, noise estimated again
  Remainder remainder;   ///< largest strengths that are left
  double excess = 0.0;   ///< by how much (log of a chance) what is left exceeds what is allowed; <=
                         ///< 0: nothing is left
  bool nameable = true;  ///< false: lambda that is not clearly another equation's
  bool adequate() const { return excess <= 0.0 && nameable; }
  /// What is left may be chance: one in twenty of those that the threshold lets through.
  bool tolerable() const { return excess <= 3.0; }
  double log_bayes = 0.0;   ///< log evidence against the nominal model, both with their own noise
  bool sign_agrees = true;  ///< amplitudes came out with the sign the score predicted
};

/// The nominal filter with the parameters of some candidates active: amplitudes with the library's
/// priors, nonlinear parameters free around the grid's value (discrete ones fixed there).
/// frame_closure turns coupling eq5 and eq6 into the family that holds both.
FilterSpec with_causes(const FilterSpec& nominal, const inference::CandidateSet& set,
                       const std::vector<Choice>& choices);

/// Fits it from the amplitudes that the score expects and, where that may be far (frame_closure),
/// from the other ends too; the best is kept. Then everything is scored again. Noise that drives
/// the platform is allowed for if the nominal model needed it: what one cause leaves is not noise
/// because it is slow.
Refit refit(const Examination& nominal, const inference::Test& test,
            const std::vector<Choice>& choices, const Nulls& nulls);

/// Amplitudes, in prior sigmas, that the linear score expects of some columns: C_dd^-1 g_d.
VecX expected_amplitudes(const inference::Projected& p, const std::vector<int>& columns);

}  // namespace drift::search
