#include "mc/store/manifest.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.hpp"
#include "core/base/build_info.hpp"
#include "core/base/check.hpp"
#include "core/base/file_text.hpp"
#include "core/base/json_number.hpp"
#include "core/base/results/regular_file.hpp"
#include "core/base/rng.hpp"
#include "core/base/sha256.hpp"
#include "core/base/words.hpp"
#include "mc/store/origin.hpp"
#include "mc/store/same_study.hpp"
#include "mc/store/store.hpp"

namespace drift::mc {
namespace {

using Json = nlohmann::ordered_json;

Json columns_json(const std::vector<Column>& columns) {
  Json list = Json::array();
  for (const Column& c : columns) list.push_back({c.name, std::string(c.unit.symbol.view())});
  return list;
}

constexpr std::string_view checksum_key = "\"checksum\": \"";
const std::string no_checksum(64, '0');  // what the checksum itself counts as

std::string to_text(const Manifest& m) {
  Json j;
  j["format"] = Manifest::file_format;
  j["checksum"] = no_checksum;
  j["study_hash"] = m.hash;
  j["runs_per_point"] = m.runs;
  j["runs_finished"] = m.finished;
  j["seed"] = m.identity.seed;
  j["block_size"] = m.identity.block_size;
  j["random_numbers"] = Stream::scheme;
  j["program"] = m.program;
  j["instruction_set"] = m.instruction_set;
  j["arithmetic"] = m.arithmetic;
  // Points of a sweep mostly share their columns: each set is written once.
  j["points"] = Json::array();
  Json sets = Json::array();
  std::map<std::string, std::size_t> known;
  for (const PointInfo& point : m.points) {
    Json columns = columns_json(point.columns);
    const auto [at, fresh] = known.emplace(columns.dump(), sets.size());
    if (fresh) sets.push_back(std::move(columns));
    j["points"].push_back({{"label", point.label}, {"columns", at->second}});
  }
  j["columns"] = std::move(sets);
  j["identity"] = m.identity.text;
  j["study"] = m.study;
  for (const auto& [key, value] : m.provenance) j["provenance"][key] = value;
  std::string text = j.dump(1) + "\n";
  const std::string checksum = sha256_hex(text);
  text.replace(text.find(checksum_key) + checksum_key.size(), checksum.size(), checksum);
  return text;
}

/// Every byte of the file, but for the checksum itself, is as it was written.
bool is_whole(std::string text) {
  const auto at = text.find(checksum_key) + checksum_key.size();
  if (at < checksum_key.size() || at + no_checksum.size() > text.size()) return false;
  const std::string checksum = text.substr(at, no_checksum.size());
  text.replace(at, no_checksum.size(), no_checksum);
  return sha256_hex(text) == checksum;
}

Manifest from_text(const std::string& text) {
  const Json j = Json::parse(text);
  Manifest m;
  const auto format = whole_of<std::uint64_t>(j.at("format"));
  if (format < 1 || format > Manifest::file_format)
    throw std::runtime_error(fmt::format("format {} is not known to this program", format));
  m.read_as = static_cast<int>(format);
  if (m.read_as >= 2 && !is_whole(text))
    throw std::runtime_error("the file does not fit its checksum");
  m.identity = {j.at("identity"), whole_of<std::uint64_t>(j.at("seed")),
                whole_of<std::size_t>(j.at("block_size"))};
  m.hash = j.at("study_hash");
  m.study = j.at("study");
  m.runs = whole_of<std::uint64_t>(j.value("runs_per_point", Json(0u)));
  m.finished = whole_of<std::uint64_t>(j.value("runs_finished", Json(0u)));
  m.program = j.at("program");
  m.instruction_set = j.at("instruction_set");
  m.arithmetic = j.at("arithmetic");
  std::vector<std::vector<Column>> sets;
  for (const Json& set : j.at("columns")) {
    auto& columns = sets.emplace_back();
    for (const Json& c : set) {
      const auto unit = parse_unit(c.at(1).get<std::string>());
      if (!unit) throw std::runtime_error("unknown unit " + c.at(1).get<std::string>());
      columns.push_back({c.at(0), *unit});
    }
  }
  for (const Json& p : j.at("points"))
    m.points.push_back({p.at("label"), sets.at(whole_of<std::size_t>(p.at("columns")))});
  for (const auto& [key, value] : j.at("provenance").items()) m.provenance.emplace_back(key, value);
  if (m.hash != m.identity.hash()) throw std::runtime_error("the study does not fit its hash");
  return m;
}

void write_file(const std::string& path, std::string_view text) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  const bool written =
      file != nullptr && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const int reason = errno;
  if (const bool closed = file != nullptr && std::fclose(file) == 0; !written || !closed)
    throw_cannot_write(path, std::strerror(written ? errno : reason));
}

/// Raises numbers of the manifest. Two workers that do so at the same time may undo each other's;
/// the worker files know as well, and the next call mends it.
void raise(const std::string& folder, std::uint64_t runs, std::uint64_t finished) {
  Manifest m = read_manifest(folder);
  if (m.runs >= runs && m.finished >= finished && m.read_as == Manifest::file_format) return;
  m.runs = std::max(m.runs, runs);
  m.finished = std::max(m.finished, finished);
  AtomicFile file(folder + "/manifest.json");
  write_file(file.temporary(), to_text(m));
  file.commit();
}

}  // namespace

std::string StudyIdentity::hash() const {
  return sha256_hex(fmt::format("driftscope store {}\n{}\nseed {}\nblock {}\n{}", Manifest::format,
                                Stream::scheme, seed, block_size, text));
}

Manifest make_manifest(StudyIdentity identity, std::string study,
                       std::span<const TaskPoint> points) {
  Manifest m;
  m.hash = identity.hash();
  m.identity = std::move(identity);
  m.study = std::move(study);
  m.program = "driftscope " + build_info().version;
  m.instruction_set = build_info().instruction_set;
  m.arithmetic = arithmetic_fingerprint();
  m.points = infos_of(points);
  m.provenance = provenance();
  return m;
}

void claim_folder(const std::string& folder, const Manifest& manifest) {
  namespace fs = std::filesystem;
  const std::string path = folder + "/manifest.json", study = folder + "/study.toml";
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw_cannot_write(folder, failed.message());
  if (!fs::exists(path)) {
    require_same_origin(folder, manifest);
    AtomicFile file(path);
    write_file(file.temporary(), to_text(manifest));
    if (!file.commit_new()) return claim_folder(folder, manifest);  // another worker was faster
  }
  require_same_study(folder, manifest);
  raise(folder, manifest.runs, 0);
  if (!fs::exists(study)) {
    AtomicFile file(study);
    write_file(file.temporary(), read_manifest(folder).study);
    file.commit();
  }
}

bool require_claimable(const std::string& folder, const Manifest& manifest) {
  const bool begun = std::filesystem::exists(folder + "/manifest.json");
  if (begun)
    require_same_study(folder, manifest);
  else
    require_same_origin(folder, manifest);
  return begun;
}

void note_finished(const std::string& folder, std::uint64_t runs) {
  raise(folder, runs, runs);
}

Manifest read_manifest(const std::string& folder) {
  const std::string path = folder + "/manifest.json";
  require_regular_file_of_ours(path);
  errno = 0;
  const auto text = file_text(path);
  if (!text && errno != ENOENT && errno != ENOTDIR)
    throw InputError(ExitCode::io,
                     fmt::format("{}: cannot be read: {} (expected the manifest of a study). Check "
                                 "the path and its permissions",
                                 path, std::strerror(errno)));
  if (!text && !std::filesystem::exists(folder))
    throw InputError(ExitCode::store,
                     fmt::format("{}: there is no such folder (expected one that holds results of "
                                 "`driftscope run`). Give the folder that was named with -o",
                                 folder));
  if (!text && !worker_files(folder).empty())
    throw InputError(
        ExitCode::store,
        fmt::format("{}: there are worker files and no manifest.json (expected one beside them). "
                    "Run the study that they are of with -o {}: it is made anew, and what is "
                    "stored is kept",
                    folder, shell_word(folder)));
  if (!text)
    throw InputError(
        ExitCode::store,
        fmt::format("{}: holds no results of `driftscope run` (expected manifest.json in "
                    "it). Give the folder that was named with -o",
                    folder));
  try {
    return from_text(*text);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(
        ExitCode::store,
        fmt::format("{}: damaged or of another version: {} (expected a manifest of format 1 to "
                    "{}). Move it away and run the same command again: it is made anew, and the "
                    "results in the worker files are kept",
                    path, error.what(), Manifest::file_format));
  }
}

std::string restore_study(const std::string& folder, const std::string& text) {
  namespace fs = std::filesystem;
  const std::string path = folder + "/study.toml";
  std::string aside;
  std::error_code none;
  for (int i = 1; fs::exists(aside = fmt::format("{}.damaged-{}", path, i), none); ++i) {
  }
  if (::rename(path.c_str(), aside.c_str()) != 0 && errno != ENOENT)
    throw_cannot_write(aside, std::strerror(errno));
  AtomicFile file(path);
  write_file(file.temporary(), text);
  file.commit();
  return aside;
}

}  // namespace drift::mc
