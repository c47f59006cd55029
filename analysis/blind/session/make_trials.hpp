#pragma once

#include <optional>
#include <string>

#include "analysis/blind/session/trial_folder.hpp"
#include "mc/engine/work_session.hpp"

namespace drift::blind {

/// Makes the trials of a study in a folder that open_trials() accepts, and seals the key. A worker
/// makes its own part first and then what the others have not made yet: nobody waits, and every
/// worker that goes on to diagnose has seen the key sealed.
///
/// Trials of the same study, sealed, are left as they are. Returns the hash of the key; nothing if
/// the time was over before. InputError (self_check) if the key was changed after it was sealed.
std::optional<std::string> make_trials(const TrialSource& source, const std::string& folder,
                                       const mc::WorkSession& session = {},
                                       const Progress& progress = {});

/// Makes anew what is gone of trials whose key is sealed: they come out the same. Those that are
/// answered are needed no more, except by whoever answers them anew (answered_too). InputError
/// (self_check) if one does not come out as the key says.
void restore_trials(const TrialSource& source, const std::string& folder, bool answered_too);

}  // namespace drift::blind
