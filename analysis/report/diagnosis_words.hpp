#pragma once

#include <string>
#include <vector>

#include "analysis/discovery/diagnosis.hpp"

namespace drift {

/// "magnetic_drift.y", as interfaces.md 5 splits keys.
std::string label_of(const discovery::Cause& cause);
std::string label_of(const discovery::CandidateScore& candidate);

/// The verdict in one sentence: the diagnosis' own, or the one of discovery::sentence().
std::string verdict_sentence(const discovery::Diagnosis& diagnosis);

/// Where the misfit is, in one sentence; empty if nothing is located.
std::string where_sentence(const discovery::Where& where);

/// Whether the cause made held-out prediction better; empty without held-out data.
std::string held_out_sentence(const discovery::HeldOut& held_out);

}  // namespace drift
