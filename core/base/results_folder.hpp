#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drift {

/// Writes a text file complete or not at all. InputError (io) with path and reason, a full disk
/// included; the target is then as it was.
void write_text_atomically(const std::string& path, std::string_view text);

/// The command whose results a folder holds: "run", "blind", "diagnose", "rank", "identify"; or
/// empty.
std::string results_of(const std::string& folder);

/// InputError (store) if a folder holds the results of another command: they would be overwritten,
/// or their study changed. An empty folder name, or a folder that does not exist yet, is nobody's.
void require_own_folder(const std::string& folder, std::string_view command);

/// InputError (io) if no file can be written into a folder, or if it cannot be made: said before
/// hours of computing and not after them. Leaves no trace. An empty folder name is no folder.
void require_writable_folder(const std::string& folder);

/// Name and content of a text file.
using TextFile = std::pair<std::string, std::string>;

/// Writes text files into a folder, made if need be, each complete or not at all. Returns their
/// names. InputError (io) if one cannot be written.
std::vector<std::string> write_files(const std::vector<TextFile>& files, const std::string& folder);

}  // namespace drift
