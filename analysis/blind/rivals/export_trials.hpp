#pragma once

#include <string>

namespace drift::blind {

/// Copies the trials of a folder into another for whoever wants to answer them: trials/NNNN with
/// study.toml (the nominal model) and recording.csv, and the published hash of the key; the key
/// itself in a folder of its own, `sealed`, to be opened after the answers. Returns how many
/// trials. InputError: self_check if the key is not as it was sealed; io, store as write_files().
std::size_t export_trials(const std::string& folder, const std::string& to);

}  // namespace drift::blind
