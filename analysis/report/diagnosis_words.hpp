#pragma once

#include <string>
#include <vector>

#include "analysis/discovery/diagnosis.hpp"

namespace drift {

/// "magnetic_drift.y", as interfaces.md 5 splits keys.
std::string label_of(const discovery::Cause& cause);
std::string label_of(const discovery::CandidateScore& candidate);

/// The verdict in one sentence: the diagnosis' own, or one made of verdict and causes.
std::string verdict_sentence(const discovery::Diagnosis& diagnosis);

/// Where the misfit is, in one sentence; empty if nothing is located.
std::string where_sentence(const discovery::Where& where);

/// Whether the cause made held-out prediction better; empty without held-out data.
std::string held_out_sentence(const discovery::HeldOut& held_out);

/// A probability that is no more exact than it is known: "0.012", "1e-20", "below 1e-300".
std::string p_text(double p_value);

}  // namespace drift
