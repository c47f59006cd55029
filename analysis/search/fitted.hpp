#pragma once

#include <optional>

#include "analysis/inference/noise/lone_input.hpp"
#include "analysis/inference/noise/noise.hpp"
#include "analysis/inference/periodic_input.hpp"
#include "analysis/search/scores/field.hpp"

namespace drift::search {

/// Something unknown in one equation, beside everything that is in a model.
struct StrongestInputs {
  inference::LoneEffect lone;  ///< of free form
  inference::PeriodicInput periodic;
};

/// A model fitted to a test, and everything that can be said about what it leaves.
struct Fitted : Field {
  FilterSpec filter;
  BatchResult fit;
  inference::LinearProblem problem;
  inference::NoiseEstimate noise;
  std::optional<inference::Projector> projector;
  bool gross = false;         ///< so far off that its noise was read off differences of samples
  std::vector<Score> scores;  ///< of every candidate
  std::optional<StrongestInputs> unknown;  ///< under this noise, where it was asked for
  /// Beside causes `left_out`: of its field only scores and windows are known, not what two
  /// candidates, or a candidate and a window, have in common.
  inference::Cross cross = inference::Cross::known;

  double log_likelihood2() const { return projector->marginal().log_likelihood2(); }
  StrongestInputs strongest_inputs() const;
  /// The periodic one, if it was asked for, is there and explains more than one of free form; else
  /// null.
  const inference::PeriodicInput* leading_period() const;
  /// With the price of its noise.
  double log_evidence() const { return 0.5 * log_likelihood2() + noise.log_price; }
  /// What is to be added where equations are compared (misalignments.hpp).
  double log_gain_of_misalignments() const;
  /// Frees the signatures of the candidates and what is made of them, all but `scores` and `set`:
  /// nine tenths of the memory, and a search keeps dozens of fits.
  void forget_signatures();
  /// Candidates that can be observed, best evidence first.
  std::vector<std::size_t> by_evidence() const;
};

/// What noise may be found where it is estimated.
enum class NoiseKinds { white, driving_too };

/// Linearises about a fit, lists candidates and scores them; the noise is estimated. beside: a fit
/// of the same test without some causes, whose signatures do here as well where the two are close
/// (linear_problem); then what is common to two is left out.
Fitted examine(const FilterSpec& filter, const MeasuredTest& test, const BatchResult& fit,
               NoiseKinds kinds = NoiseKinds::driving_too, const Fitted* beside = nullptr);
/// The same under a noise that is known.
Fitted examine(const FilterSpec& filter, const MeasuredTest& test, const BatchResult& fit,
               const inference::NoiseEstimate& known, const Fitted* beside = nullptr);

/// Everything scored again under another noise.
Fitted with_noise(Fitted f, const Timeline& timeline, const inference::NoiseEstimate& noise);

/// What the filter says its noise is.
inference::NoiseModel declared_noise(const FilterSpec& filter);

}  // namespace drift::search
