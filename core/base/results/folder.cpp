#include "core/base/results/folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>

#include "core/base/atomic_file.hpp"
#include "core/base/check.hpp"
#include "core/base/results/marks.hpp"
#include "core/base/results/register.hpp"
#include "core/base/results/regular_file.hpp"
#include "core/base/sha256.hpp"
#include "core/base/temporary_file.hpp"
#include "core/base/utf8.hpp"

namespace drift {
namespace {

namespace fs = std::filesystem;

/// "a, b and 3 more"
std::string listed(std::vector<std::string> names) {
  constexpr std::size_t most = 5;
  std::ranges::sort(names);
  const std::size_t more = names.size() > most ? names.size() - most : 0;
  names.resize(names.size() - more);
  for (std::string& name : names) name = text_of_name(name);
  return fmt::format("{}{}", fmt::join(names, ", "),
                     more > 0 ? fmt::format(" and {} more", more) : "");
}

/// An input within the folder, by whatever name, link or spelling it was given.
void refuse_inputs(const fs::path& folder, const std::vector<std::string>& inputs) {
  std::error_code unknown;
  for (const auto& entry : fs::directory_iterator(folder, unknown))
    for (const std::string& input : inputs)
      if (fs::equivalent(entry.path(), input, unknown))
        throw InputError(
            ExitCode::usage,
            fmt::format("-o {}: {} in it is an input of this command (expected a folder for "
                        "results alone: inputs are never written to). Name another folder",
                        folder.string(), text_of_name(entry.path().filename().string())));
}

/// Names of files that look like results.
std::vector<std::string> results_within(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(folder, unreadable))
    if (looks_like_result(entry.path())) names.push_back(entry.path().filename().string());
  return names;
}

/// To add lines to a file of somebody else's would change it.
void refuse_foreign_register(const std::string& folder) {
  const std::string path = (fs::path(folder) / ResultsRegister::file_name).string();
  require_regular_file_of_ours(path);
  if (ResultsRegister(folder).is_foreign())
    throw InputError(
        ExitCode::store,
        fmt::format("{}: is not the list of files that driftscope keeps under this name (expected "
                    "none, or its own). Nothing was changed; give another folder with -o",
                    path));
}

/// The command whose results the folder holds; empty if it holds none, nor files of others.
std::string holder_of(const ResultsFolder& folder) {
  if (std::string holder = results_of(folder.path); !holder.empty()) return holder;
  std::vector<std::string> names = results_within(folder.path);
  if (names.empty()) return {};
  // Another process may have begun the folder between the two looks.
  if (std::string holder = results_of(folder.path); !holder.empty()) return holder;
  throw InputError(
      ExitCode::store,
      fmt::format("{}: holds {}, which driftscope did not write (expected an empty folder, or "
                  "one with results of `{}`). Nothing was changed; give another folder with -o",
                  folder.path, listed(std::move(names)), folder.command));
}

/// What a study keeps beside its results, and would wait for or trip over if it were no file.
bool belongs_to_a_study(const std::string& name) {
  return name == "manifest.json" || name == "study.toml" || name.starts_with("worker-");
}

/// Links among the results would lead what is written to other places, pipes would never answer.
void refuse_others_than_files(const std::string& folder) {
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(folder, unreadable)) {
    const bool folder_of_results = entry.is_directory(unreadable) && !entry.is_symlink(unreadable);
    if (belongs_to_a_study(entry.path().filename().string()) ||
        (looks_like_result(entry.path()) && !folder_of_results))
      require_regular_file_of_ours(entry.path().string());
  }
}

/// Of what driftscope wrote, what is not as it was.
void refuse_changed(const ResultsFolder& folder) {
  const std::vector<std::string> changed = changed_results(folder.path);
  if (!changed.empty())
    throw InputError(
        ExitCode::store,
        fmt::format("{}: {} changed since driftscope wrote {}, or what {} says of {} did (expected "
                    "as written, to be replaced). Nothing was changed; move away what you want to "
                    "keep, or give another folder with -o",
                    folder.path, listed(changed), changed.size() == 1 ? "it" : "them",
                    ResultsRegister::file_name, changed.size() == 1 ? "it" : "them"));
}

/// What the command is going to write, and its list of what it wrote does not have.
void refuse_in_the_way(const ResultsFolder& folder) {
  std::vector<std::string> names = unlisted_results(folder);
  if (names.empty()) return;
  const bool one = names.size() == 1;
  throw InputError(
      ExitCode::store,
      fmt::format("{}: {} {} there, and not in the list of what driftscope wrote ({}; expected a "
                  "free name for what `{}` writes, or a file that it wrote). Nothing was changed; "
                  "move {} away, or give another folder with -o",
                  folder.path, listed(std::move(names)), one ? "is" : "are",
                  ResultsRegister::file_name, folder.command, one ? "it" : "them"));
}

/// Tries to write where the folder is, or where it would be made, and leaves no trace.
void require_writable(const std::string& folder) {
  std::error_code unknown;
  fs::path at = fs::absolute(folder, unknown);
  while (!fs::exists(fs::symlink_status(at, unknown)) && at != at.parent_path())
    at = at.parent_path();
  const std::string probe = make_temporary(at.string());
  if (probe.empty()) throw_cannot_write(folder, std::strerror(errno));
  remove_temporary(probe);
}

}  // namespace

std::vector<std::string> unlisted_results(const ResultsFolder& folder) {
  const ResultsRegister known(folder.path);
  const std::vector<std::string> ours = known.names();
  std::vector<std::string> may_be = main_results(folder.command), unlisted;
  if (ours.empty())  // the list is lost, or nothing was noted yet
    std::ranges::move(unguarded_results(folder.command, folder.path), std::back_inserter(may_be));
  std::ranges::sort(may_be);
  may_be.erase(std::unique(may_be.begin(), may_be.end()), may_be.end());
  for (const std::string& name : may_be) {
    const fs::path path = fs::path(folder.path) / name;
    std::error_code none;
    const bool empty = fs::is_regular_file(path, none) && fs::file_size(path, none) == 0;
    if (fs::exists(fs::symlink_status(path, none)) && !empty && !std::ranges::count(ours, name))
      unlisted.push_back(name);
  }
  return unlisted;
}

std::string results_of(const std::string& folder) {
  // The files know best: the word in the register is under no checksum.
  const std::string by_files = command_by_files(folder);
  return by_files.empty() ? ResultsRegister(folder).command() : by_files;
}

void require_results_folder(const ResultsFolder& folder, const std::vector<std::string>& inputs) {
  if (folder.path.empty()) return;
  std::error_code error;
  const fs::file_status status = fs::status(folder.path, error);
  if (status.type() == fs::file_type::none) throw_cannot_write(folder.path, error.message());
  if (fs::exists(status) && !fs::is_directory(status))
    throw_cannot_write(folder.path, "it is a file, expected a folder");
  if (fs::exists(status)) {
    refuse_inputs(folder.path, inputs);
    refuse_foreign_register(folder.path);
    const std::string holder = holder_of(folder);
    if (!holder.empty() && holder != folder.command)
      throw InputError(
          ExitCode::store,
          fmt::format("{}: holds the results of `{}` (expected an empty folder, or one of `{}`). "
                      "Give another folder with -o",
                      folder.path, holder, folder.command));
    if (!holder.empty()) {
      refuse_others_than_files(folder.path);
      refuse_changed(folder);
      refuse_in_the_way(folder);
    }
  }
  require_writable(folder.path);
  for (const char* within : {"", "trials", "making", "candidates"})
    remove_stale_temporaries((fs::path(folder.path) / within).string());
  for (const auto& trial : fs::directory_iterator(fs::path(folder.path) / "trials", error))
    remove_stale_temporaries(trial.path().string());
}

}  // namespace drift
