#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/named.hpp"
#include "core/physics/drift_model.hpp"
#include "core/plan/test_plan.hpp"

namespace drift::blind {

/// What kind of thing a trial hides. The last three are asked for by number
/// (mc::BlindFurther), the others by their shares.
enum class Stratum {
  null,
  wrong_noise,
  single,
  pair,
  outside,
  local,
  other_equation,
  noisy_single,
  noisy_covariate
};
inline constexpr Named<Stratum> strata[] = {{"null", Stratum::null},
                                            {"wrong_noise", Stratum::wrong_noise},
                                            {"single", Stratum::single},
                                            {"pair", Stratum::pair},
                                            {"outside", Stratum::outside},
                                            {"local", Stratum::local},
                                            {"other_equation", Stratum::other_equation},
                                            {"noisy_single", Stratum::noisy_single},
                                            {"noisy_covariate", Stratum::noisy_covariate}};
constexpr std::string_view key_of(Stratum stratum) {
  return name_in(strata, stratum);
}
inline constexpr std::size_t num_strata = 6;  ///< that have shares
constexpr bool is_further(Stratum stratum) {
  return stratum >= Stratum::other_equation;
}

/// What is asked of one trial, before anything is drawn.
struct TrialPlan {
  std::size_t number = 0;
  Stratum stratum = Stratum::null;
  std::size_t index = 0;  ///< number among the trials of its stratum
  std::string plan;       ///< preset
  CommandLaw mode = CommandLaw::free;
  Coupling coupling = Coupling::eq5;  ///< of the truth
  double size = 0.0;                  ///< wanted, what a nominal fit cannot absorb [sigma]
};

/// A number of a hidden effect, in `unit`.
struct HiddenParameter {
  std::string key;
  double value = 0.0;
  std::string unit;
};

/// One thing that was hidden.
struct HiddenEffect {
  std::string term;   ///< key of the term; for what is outside the library, a name of its own
  std::string axis;   ///< empty if it has none
  std::string words;  ///< what it is
  std::vector<HiddenParameter> parameters;
  double size = 0.0;      ///< of this effect alone, what the nominal fit cannot absorb [sigma]
  double absorbed = 0.0;  ///< part of the raw signature that it can, 0..1
  int position = 0;       ///< 1-based, of a local effect; 0: everywhere
  double start_s = 0.0, end_s = 0.0;  ///< of a local effect
  std::string equation;  ///< of a local effect, as a diagnosis says it: "platform rate y"
  std::string
      nearest;  ///< of an effect outside the library: what in the library looks most like it
  double nearest_cosine = 0.0;
};

/// Whether an ordinary fit shows that something is missing: the nominal filter on the recording.
struct Certificate {
  double chi2_per_dof = 1.0;               ///< data and prior, per measured scalar
  double band_low = 0.0, band_high = 0.0;  ///< 95 %, right model and noise
  bool concealed = true;                   ///< inside the band
  double largest_bias = 0.0;  ///< |estimate - truth| in reported sigmas, over all parameters
  std::string biased;         ///< the parameter it belongs to

  /// Keeps the largest.
  void take_bias(double bias, std::string_view param) {
    if (bias <= largest_bias) return;
    largest_bias = bias;
    biased = std::string(param);
  }
};

/// What the key says of one trial.
struct KeyEntry {
  TrialPlan plan;
  std::string nominal;  ///< coupling of the nominal filter
  std::vector<HiddenEffect> effects;
  double total_size = 0.0;  ///< of all effects together [sigma]
  double cosine = 0.0;      ///< of the projected signatures of a pair
  Certificate certificate;
  double seconds = 0.0;  ///< spent on making it; not written to the key
};

}  // namespace drift::blind
