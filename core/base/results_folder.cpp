#include "core/base/results_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "core/base/atomic_file.hpp"
#include "core/base/check.hpp"

namespace drift {

void write_text_atomically(const std::string& path, std::string_view text) {
  AtomicFile target(path);
  const auto failed = [&] { throw_cannot_write(path, std::strerror(errno)); };
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(target.temporary().c_str(), "we"),
                                                       &std::fclose);
  if (!file || std::fwrite(text.data(), 1, text.size(), file.get()) != text.size()) failed();
  if (std::fclose(file.release()) != 0) failed();  // a full disk may show only here
  target.commit();
}

std::string results_of(const std::string& folder) {
  // A strapdown diagnosis has an identification beside it, so the order matters.
  constexpr std::pair<std::string_view, std::string_view> marks[] = {
      {"manifest.json", "run"},
      {"key.json", "blind"},
      {"diagnosis.json", "diagnose"},
      {"rank.json", "rank"},
      {"identification.json", "identify"}};
  for (const auto& [file, command] : marks)
    if (std::filesystem::exists(std::filesystem::path(folder) / file)) return std::string(command);
  return {};
}

void require_own_folder(const std::string& folder, std::string_view command) {
  if (folder.empty()) return;
  if (std::filesystem::exists(folder) && !std::filesystem::is_directory(folder))
    throw_cannot_write(folder, "it is a file, expected a folder");
  const std::string holder = results_of(folder);
  if (!holder.empty() && holder != command)
    throw InputError(
        ExitCode::store,
        fmt::format("{}: holds the results of `{}` (expected an empty folder, or one of `{}`). "
                    "Give another folder with -o",
                    folder, holder, command));
}

void require_writable_folder(const std::string& folder) {
  namespace fs = std::filesystem;
  if (folder.empty()) return;
  std::vector<fs::path> missing;  // innermost first
  std::error_code unknown;
  for (fs::path at = fs::absolute(folder); !at.empty() && !fs::exists(at, unknown);
       at = at.parent_path()) {
    missing.push_back(at);
    if (unknown || at == at.parent_path()) break;
  }
  std::error_code error;
  fs::create_directories(folder, error);
  std::string reason = error ? error.message() : "";
  if (reason.empty()) {
    std::string probe = (fs::path(folder) / ".driftscope.XXXXXX").string();
    const int file = ::mkostemp(probe.data(), O_CLOEXEC);
    if (file < 0) {
      reason = std::strerror(errno);
    } else {
      ::close(file);
      ::unlink(probe.c_str());
    }
  }
  for (const fs::path& made : missing) fs::remove(made, unknown);  // takes away empty folders only
  if (!reason.empty()) throw_cannot_write(folder, reason);
}

std::vector<std::string> write_files(const std::vector<TextFile>& files,
                                     const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw_cannot_write(folder, error.message());
  const std::filesystem::path root(folder);
  std::vector<std::string> names;
  for (const auto& [name, text] : files) {
    write_text_atomically((root / name).string(), text);
    names.push_back(name);
  }
  return names;
}

}  // namespace drift
