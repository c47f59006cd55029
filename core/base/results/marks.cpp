#include "core/base/results/marks.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/base/file_text.hpp"

namespace drift {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code none;
  return fs::is_regular_file(fs::symlink_status(path, none));
}

/// A JSON object with two of our fields.
bool has_fields(const fs::path& path, const char* one, const char* other) {
  if (!is_file(path)) return false;
  const auto json = nlohmann::json::parse(file_text(path).value_or(""), nullptr, false);
  return json.is_object() && json.contains(one) && json.contains(other);
}

/// A database with our mark in its header, where SQLite says that it stands.
bool is_database_of_ours(const fs::path& path) {
  constexpr std::string_view magic{"SQLite format 3\0", 16};
  constexpr std::size_t id_at = 68;
  std::array<char, id_at + 4> header{};
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file.is_open() || file.read(header.data(), header.size()).bad())
    throw_cannot_read(path.string(), std::strerror(errno != 0 ? errno : EIO));
  if (!file) return false;
  std::uint32_t id = 0;
  for (std::size_t i = id_at; i < header.size(); ++i)
    id = id << 8 | static_cast<unsigned char>(header[i]);
  return std::string_view(header.data(), magic.size()) == magic && id == results_database_id;
}

bool has_worker_file(const fs::path& folder) {
  std::error_code none;
  return std::ranges::any_of(fs::directory_iterator(folder, none), [](const auto& entry) {
    const std::string name = entry.path().filename().string();
    return name.starts_with("worker-") && name.ends_with(".sqlite") && is_file(entry.path()) &&
           is_database_of_ours(entry.path());
  });
}

/// What changes under the guard of its own checksums, by other writers.
bool is_guarded(const std::string& command, const fs::path& name) {
  if (command == "run") return name != "report.html" && name != "summary.json";
  return name == "key.json" || name == "answers.json" || name.extension() == ".sha256";
}

std::vector<std::string> names_within(const std::string& command, const fs::path& folder,
                                      const fs::path& within) {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder / within, none))
    if (is_file(entry.path()) && looks_like_result(entry.path()) &&
        !is_guarded(command, entry.path().filename()))
      names.push_back((within / entry.path().filename()).string());
  return names;
}

}  // namespace

bool looks_like_result(const fs::path& entry) {
  // SQLite takes a journal that lies beside a database for its own, and away.
  constexpr std::array endings{".html",  ".svg",  ".json",   ".toml",           ".csv",
                               ".nc",    ".lock", ".sqlite", ".sqlite-journal", ".sqlite-wal",
                               ".sha256"};
  constexpr std::array folders{"trials", "making", "candidates"};
  return std::ranges::find(folders, entry.filename()) != folders.end() ||
         std::ranges::find(endings, entry.extension()) != endings.end();
}

std::string command_by_files(const fs::path& folder) {
  // A strapdown diagnosis has an identification beside it, so the order matters.
  if (has_fields(folder / "manifest.json", "study_hash", "identity") || has_worker_file(folder))
    return "run";
  if (has_fields(folder / "key.json", "salt", "trials")) return "blind";
  if (has_fields(folder / "diagnosis.json", "schema", "verdict")) return "diagnose";
  if (has_fields(folder / "rank.json", "schema", "linearised_at")) return "rank";
  if (has_fields(folder / "identification.json", "schema", "simulated") ||
      has_fields(folder / "identification.json", "schema", "kind"))
    return "identify";
  return {};
}

std::vector<std::string> main_results(const std::string& command) {
  if (command == "run") return {"report.html", "summary.json"};
  if (command == "identify") return {"report.html", "identification.json"};
  if (command == "diagnose") return {"report.html", "diagnosis.json"};
  return {"report.html", command + ".json"};
}

std::vector<std::string> unguarded_results(const std::string& command, const fs::path& folder) {
  std::vector<std::string> names = names_within(command, folder, "");
  std::error_code none;
  if (command == "blind")
    for (const auto& trial : fs::directory_iterator(folder / "trials", none))
      std::ranges::move(names_within(command, folder, fs::path("trials") / trial.path().filename()),
                        std::back_inserter(names));
  return names;
}

}  // namespace drift
