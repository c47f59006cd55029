#pragma once

#include <string>

namespace drift::blind {

/// Writes `text` to folder/name and its SHA-256 to folder/stem.sha256 ("<hash>  <name>", as
/// sha256sum writes it). Returns the hash. InputError: io if that fails; self_check if what is
/// there was changed after it was sealed.
std::string write_sealed(const std::string& folder, const std::string& name,
                         const std::string& text);

/// The hash that was published for folder/name; empty if none was.
std::string published_hash(const std::string& folder, const std::string& name);

/// Reads folder/name. InputError (self_check) if nothing was published for it, or another hash:
/// what is in the file was changed after it was sealed.
std::string open_sealed(const std::string& folder, const std::string& name);

}  // namespace drift::blind
