#pragma once

#include <string>
#include <string_view>

namespace drift {

/// A single file that is written outside of a results folder carries the SHA-256 of itself, taken
/// with zeros in place of the digest: what its owner changed afterwards is known, and not replaced.
/// It stands behind this name near the beginning or at the very end of a file.
inline constexpr std::string_view seal_key = "driftscope_sha256";

/// The digest's place before the rest is known: 64 zeros.
std::string open_seal();

/// Puts the digest into a file that is complete but for it. InputError (io) naming `path`, what the
/// file will be called.
void close_seal(const std::string& file, const std::string& path);

/// Adds a line with the digest at the end of a file, behind what its format ends with.
void append_seal(const std::string& file, const std::string& path);

/// Whether the file is, byte for byte, as it was sealed.
bool seal_holds(const std::string& file);

/// What a file of ours is whose seal does not hold, in the words of a message.
inline constexpr const char* seal_broken =
    "changed since driftscope made it (or of a version that left no digest in it)";

}  // namespace drift
