#pragma once

#include <string>
#include <string_view>

namespace drift {

/// Makes an empty file of an unused name in a folder, for AtomicFile to fill; its name says which
/// process on which machine made it. Empty if that fails; errno says why. remove_temporary() ends
/// its life, also after it was renamed.
std::string make_temporary(const std::string& folder);
void remove_temporary(const std::string& path);

/// Removes those that this process has made and not removed yet, of at most 256 alive at a time:
/// for the handler of a signal that ends it.
void remove_own_temporaries() noexcept;

/// Removes the temporary files that processes which were killed left in a folder. Those of living
/// processes stay, and for a day those of other machines, whose processes cannot be seen.
void remove_stale_temporaries(const std::string& folder);

/// Whether a file name is one that make_temporary() gives.
bool is_temporary(std::string_view name);

}  // namespace drift
