#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace drift {

/// The application_id of SQLite by which a file of results is driftscope's: "drft".
constexpr std::uint32_t results_database_id = 0x64726674;

/// Whether an entry of a folder could be a result of some command: an entry of this kind in a
/// folder that is not driftscope's stands in the way. Logs and notes do not.
bool looks_like_result(const std::filesystem::path& entry);

/// The command that left its files in a folder, judged by them alone; or empty. For folders whose
/// register was lost.
std::string command_by_files(const std::filesystem::path& folder);

/// Names of what a command writes when it ends, whatever the study.
std::vector<std::string> main_results(const std::string& command);

/// Files of a folder that look like results and that no checksum of their own tells to be the
/// command's.
std::vector<std::string> unguarded_results(const std::string& command,
                                           const std::filesystem::path& folder);

}  // namespace drift
