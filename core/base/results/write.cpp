#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/base/atomic_file.hpp"
#include "core/base/check.hpp"
#include "core/base/results/folder.hpp"
#include "core/base/results/register.hpp"
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

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw_cannot_write(folder.string(), error.message());
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

/// The register of a folder that is made and marked if need be.
ResultsRegister begun(const ResultsFolder& folder) {
  make_folder(folder.path);
  ResultsRegister known(folder.path);
  // Of a folder whose register is lost nothing is taken for the command's own that does not say so
  // under a checksum of its own: a file called report.html may be anybody's.
  if (!known.exists()) known.add(folder.command, {});
  return known;
}

}  // namespace

void begin_results(const ResultsFolder& folder) {
  begun(folder);
}

std::vector<std::string> write_files(const ResultsFolder& folder,
                                     const std::vector<TextFile>& files) {
  ResultsRegister known = begun(folder);
  const fs::path root(folder.path);
  HashedFiles hashed;
  for (const auto& [name, text] : files) hashed.emplace_back(name, sha256_hex(text));
  for (const auto& [name, hash] : hashed) require_ours(known, root, name, hash);
  known.add(folder.command, hashed);
  std::vector<std::string> names;
  for (const auto& [name, text] : files) {
    make_folder((root / name).parent_path());
    write_text_atomically((root / name).string(), text);
    names.push_back(name);
  }
  return names;
}

void write_result(const ResultsFolder& folder, const std::string& name,
                  const std::function<void(const std::string& temporary)>& write) {
  ResultsRegister known = begun(folder);
  const fs::path path = fs::path(folder.path) / name;
  require_ours(known, folder.path, name, "");
  make_folder(path.parent_path());
  AtomicFile file(path.string());
  write(file.temporary());
  known.add(folder.command, {{name, sha256_hex_of_file(file.temporary())}});
  file.commit();
}

void remove_result(const ResultsFolder& folder, const std::string& name) {
  std::error_code none;
  const fs::path path = fs::path(folder.path) / name;
  if (!fs::exists(fs::symlink_status(path, none))) return;
  require_ours(begun(folder), folder.path, name, "");
  fs::remove(path, none);
  if (none) throw_cannot_write(path.string(), none.message());
}

void write_text_atomically(const std::string& path, std::string_view text) {
  AtomicFile target(path);
  const auto failed = [&] { throw_cannot_write(path, std::strerror(errno)); };
  const int fd = ::open(target.temporary().c_str(), O_WRONLY | O_CLOEXEC);
  if (fd < 0) failed();
  while (!text.empty()) {
    const ssize_t done = ::write(fd, text.data(), text.size());
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) {
      const int reason = errno;
      ::close(fd);
      errno = reason;
      failed();
    }
    text.remove_prefix(static_cast<std::size_t>(done));
  }
  if (::close(fd) != 0) failed();  // a full disk may show only here
  target.commit();
}

}  // namespace drift
