#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drift {

/// Where a command keeps its results. In it only files are replaced that driftscope wrote there
/// itself and that nobody changed since (results_register.hpp); no symbolic link is followed.
struct ResultsFolder {
  std::string path;
  std::string command;  ///< "run", "blind", "diagnose", "rank" or "identify"
};

/// The command whose results a folder holds; or empty.
std::string results_of(const std::string& folder);

/// Looks whether results can go into a folder, before anything is computed. An empty path is no
/// folder; one that does not exist yet is nobody's. InputError:
///   usage  if one of the command's inputs lies in it, whatever it is called there;
///   store  if it holds the results of another command, files of others that look like results, or
///          results that were changed since driftscope wrote them;
///   io     if no file can be written into it, or it cannot be made.
/// Removes what killed processes left unfinished, and leaves no trace else.
void require_results_folder(const ResultsFolder& folder,
                            const std::vector<std::string>& inputs = {});

/// Files that the command writes and that are there, but not in the list of what driftscope wrote
/// into the folder: somebody else's, or its own of which the list was lost or damaged.
std::vector<std::string> unlisted_results(const ResultsFolder& folder);

/// Makes the folder and marks it as the command's. InputError (io).
void begin_results(const ResultsFolder& folder);

/// Name and content of a text file.
using TextFile = std::pair<std::string, std::string>;

/// Writes text files into the folder, made if need be, all of them or none (new_results.hpp).
/// Returns their names. InputError, with nothing written: store if one of the names is somebody
/// else's file; io if it is no file, or if one cannot be written.
std::vector<std::string> write_files(const ResultsFolder& folder,
                                     const std::vector<TextFile>& files);

/// The same for a file that `write` fills at the path it is given.
void write_result(const ResultsFolder& folder, const std::string& name,
                  const std::function<void(const std::string& temporary)>& write);

/// Removes a file of an earlier call, if there is one. InputError (store) if it is not ours.
void remove_result(const ResultsFolder& folder, const std::string& name);

/// Writes a text file complete or not at all. InputError (io) with path and reason, a full disk
/// included; the target is then as it was.
void write_text_atomically(const std::string& path, std::string_view text);

}  // namespace drift
