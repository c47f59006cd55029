#include "core/base/results/new_results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/base/check.hpp"
#include "core/base/results/stop_later.hpp"
#include "core/base/sha256.hpp"

namespace drift {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void in_the_way(const fs::path& path, std::string_view what) {
  throw InputError(ExitCode::store,
                   fmt::format("{}: is there already, {} (expected a free name, or what driftscope "
                               "wrote). Nothing was written; move it away, or give another folder "
                               "with -o",
                               path.string(), what));
}

/// A name is free, or holds what driftscope wrote, or nothing at all. `hash`: of what is to be
/// there.
void require_ours(const ResultsRegister& known, const fs::path& folder, const std::string& name,
                  const std::string& hash) {
  std::error_code none;
  fs::path path = folder;
  for (const fs::path& part : fs::path(name)) {
    path /= part;
    if (fs::is_symlink(path, none)) in_the_way(path, "a symbolic link, which is not followed");
  }
  require_file_name(path.string());
  if (!fs::exists(path, none) || fs::file_size(path, none) == 0) return;
  const std::string present = sha256_hex_of_file(path.string());
  if (present == hash || known.has(name, present)) return;
  // Read anew: another worker that ends at the same time notes what it writes, then writes it.
  if (!ResultsRegister(folder.string()).has(name, present))
    in_the_way(path, "and driftscope did not write it, or it was changed since");
}

}  // namespace

NewResults::NewResults(ResultsFolder folder)
    : folder_(std::move(folder)), begun_(folder_), known_(folder_.path) {}

std::string NewResults::path_of(const std::string& name) const {
  return (fs::path(folder_.path) / name).string();
}

AtomicFile& NewResults::change(const std::string& name, const std::string& hash) {
  require_ours(known_, folder_.path, name, hash);
  const fs::path parent = fs::path(path_of(name)).parent_path();
  std::error_code error;
  fs::create_directories(parent, error);
  if (error) throw_cannot_write(parent.string(), error.message());
  changes_.push_back({name, hash, std::make_unique<AtomicFile>(path_of(name))});
  return *changes_.back().file;
}

void NewResults::add(const std::string& name, std::string_view text) {
  AtomicFile& file = change(name, sha256_hex(text));
  file.write(text);
  file.sync();
}

void NewResults::add(const std::string& name,
                     const std::function<void(const std::string& temporary)>& write) {
  AtomicFile& file = change(name, "");
  write(file.temporary());
  changes_.back().hash = sha256_hex_of_file(file.temporary());
  file.sync();
}

void NewResults::remove(const std::string& name) {
  std::error_code none;
  if (fs::exists(fs::symlink_status(path_of(name), none))) change(name, "");
}

void NewResults::take_back(std::size_t failed, const std::string& reason) {
  std::vector<std::string> new_ones;
  for (std::size_t k = failed; k-- > 0;)
    if (!changes_[k].file->take_back()) new_ones.push_back(changes_[k].name);
  const std::string path = path_of(changes_[failed].name);
  if (new_ones.empty()) throw_cannot_write(path, reason);
  throw InputError(
      ExitCode::io,
      fmt::format("{}: cannot be written: {} (expected a writable folder with free space). {} {} "
                  "of this answer already, all else there of the one before; make room, and the "
                  "same command completes it",
                  path, reason, fmt::join(new_ones, ", "), new_ones.size() == 1 ? "is" : "are"));
}

std::vector<std::string> NewResults::commit() {
  HashedFiles hashed;
  for (const Change& c : changes_)
    if (!c.hash.empty()) hashed.emplace_back(c.name, c.hash);
  const StopLater whole;
  known_.add(folder_.command, hashed);
  for (std::size_t k = 0; k < changes_.size(); ++k) {
    AtomicFile& file = *changes_[k].file;
    if (const std::string why = changes_[k].hash.empty() ? file.take_away() : file.put();
        !why.empty())
      take_back(k, why);
  }
  std::set<fs::path> synced;
  for (const Change& c : changes_)
    if (synced.insert(fs::path(c.name).parent_path()).second) c.file->sync_folder();
  std::vector<std::string> names;
  for (const auto& [name, hash] : hashed) names.push_back(name);
  changes_.clear();
  return names;
}

}  // namespace drift
