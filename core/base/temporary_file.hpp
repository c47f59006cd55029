#pragma once

#include <string>
#include <string_view>

namespace drift {

/// Makes an empty file of an unused name in a folder, for AtomicFile to fill; its name says which
/// process on which machine made it. Empty if that fails; errno says why.
std::string make_temporary(const std::string& folder);

/// Removes the temporary files that processes which were killed left in a folder. Those of living
/// processes stay, and for a day those of other machines, whose processes cannot be seen.
void remove_stale_temporaries(const std::string& folder);

/// Whether a file name is one that make_temporary() gives.
bool is_temporary(std::string_view name);

}  // namespace drift
