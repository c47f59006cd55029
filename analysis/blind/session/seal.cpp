#include "analysis/blind/session/seal.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "core/base/check.hpp"
#include "core/base/file_text.hpp"
#include "core/base/results/folder.hpp"
#include "core/base/sha256.hpp"

namespace drift::blind {
namespace {

namespace fs = std::filesystem;

fs::path hash_path(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).replace_extension(".sha256");
}

}  // namespace

std::string write_sealed(const std::string& folder, const std::string& name,
                         const std::string& text) {
  const std::string hash = sha256_hex(text);
  if (!published_hash(folder, name).empty()) {
    // What is sealed stays as it is: other workers may be reading it.
    // One that is gone is the same again if it has the same hash.
    const bool gone = !std::filesystem::exists(fs::path(folder) / name);
    if (gone && hash == published_hash(folder, name))
      write_text_atomically((fs::path(folder) / name).string(), text);
    if (open_sealed(folder, name) == text) return hash;
    // Without a hash the text counts as not written yet, wherever the program ends.
    std::error_code none;
    fs::remove(hash_path(folder, name), none);
  }
  write_text_atomically((fs::path(folder) / name).string(), text);
  write_text_atomically(hash_path(folder, name).string(), fmt::format("{}  {}\n", hash, name));
  return hash;
}

std::string published_hash(const std::string& folder, const std::string& name) {
  const std::string line = file_text(hash_path(folder, name)).value_or("");
  return line.substr(0, line.find_first_of(" \n"));
}

std::string open_sealed(const std::string& folder, const std::string& name) {
  const std::string path = (fs::path(folder) / name).string();
  const std::string published = published_hash(folder, name);
  if (published.empty())
    throw InputError(
        ExitCode::self_check,
        fmt::format(
            "{}: no hash was published for it (expected {}). Run the study again in an empty "
            "folder",
            path, hash_path(folder, name).string()));
  const auto read = file_text(path);
  if (!read)
    throw InputError(
        ExitCode::self_check,
        fmt::format("{}: is gone, or cannot be read (expected what was sealed, SHA-256 {}). Put it "
                    "back{}",
                    path, published,
                    name == "answers.json"
                        ? ", or run the same command again: it is made anew of the answers"
                        : ", or run the study again in an empty folder"));
  const std::string text = *read, hash = sha256_hex(text);
  if (hash != published)
    throw InputError(
        ExitCode::self_check,
        fmt::format(
            "{}: was changed after it was sealed: SHA-256 is {} (published: {}). Nothing is "
            "scored; run the study again in an empty folder",
            path, hash, published));
  return text;
}

}  // namespace drift::blind
