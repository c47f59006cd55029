#include "mc/store/manifest.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.hpp"
#include "core/base/build_info.hpp"
#include "core/base/check.hpp"
#include "core/base/rng.hpp"
#include "core/base/sha256.hpp"
#include "mc/store/text_difference.hpp"

namespace drift::mc {
namespace {

using Json = nlohmann::ordered_json;

Json columns_json(const std::vector<Column>& columns) {
  Json list = Json::array();
  for (const Column& c : columns) list.push_back({c.name, std::string(c.unit.symbol.view())});
  return list;
}

std::string to_text(const Manifest& m) {
  Json j;
  j["format"] = Manifest::format;
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
  return j.dump(1) + "\n";
}

Manifest from_text(const std::string& text) {
  const Json j = Json::parse(text);
  if (const int format = j.at("format"); format != Manifest::format)
    throw std::runtime_error(fmt::format("format {} is not known to this program", format));
  Manifest m;
  m.identity = {j.at("identity"), j.at("seed"), j.at("block_size")};
  m.hash = j.at("study_hash");
  m.study = j.at("study");
  m.runs = j.value("runs_per_point", std::uint64_t{0});
  m.finished = j.value("runs_finished", std::uint64_t{0});
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
    m.points.push_back({p.at("label"), sets.at(p.at("columns").get<std::size_t>())});
  for (const auto& [key, value] : j.at("provenance").items()) m.provenance.emplace_back(key, value);
  if (m.hash != m.identity.hash()) throw std::runtime_error("the study does not fit its hash");
  return m;
}

std::vector<std::string> differences(const Manifest& is, const Manifest& wanted) {
  std::vector<std::string> out = difference(is.identity.text, wanted.identity.text);
  const auto note = [&](const char* what, const auto& a, const auto& b) {
    if (a != b) out.push_back(fmt::format("{}: {} in the folder, {} asked for", what, a, b));
  };
  note("seed", is.identity.seed, wanted.identity.seed);
  note("block size", is.identity.block_size, wanted.identity.block_size);
  note("program", is.program, wanted.program);
  note("instruction set", is.instruction_set, wanted.instruction_set);
  note("arithmetic of the C library on this processor", is.arithmetic, wanted.arithmetic);
  note("number of study points", is.points.size(), wanted.points.size());
  for (std::size_t p = 0; p < std::min(is.points.size(), wanted.points.size()); ++p)
    if (is.points[p].label != wanted.points[p].label ||
        columns_json(is.points[p].columns) != columns_json(wanted.points[p].columns))
      out.push_back(fmt::format("study point {} has other columns or another label", p));
  return out;
}

void check_same(const std::string& folder, const Manifest& wanted) {
  const std::vector<std::string> differ = differences(read_manifest(folder), wanted);
  if (differ.empty()) return;
  throw InputError(
      ExitCode::store,
      fmt::format("{}: the folder holds another study (expected the one that is asked for). Choose "
                  "another folder with -o; what differs, - in the folder, + asked for:\n  {}",
                  folder, fmt::join(differ, "\n  ")));
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
  if (m.runs >= runs && m.finished >= finished) return;
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
  for (const TaskPoint& point : points) m.points.push_back({point.label, point.task->columns()});
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
    AtomicFile file(path);
    write_file(file.temporary(), to_text(manifest));
    if (!file.commit_new()) return claim_folder(folder, manifest);  // another worker was faster
  }
  check_same(folder, manifest);
  raise(folder, manifest.runs, 0);
  if (!fs::exists(study)) {
    AtomicFile file(study);
    write_file(file.temporary(), read_manifest(folder).study);
    file.commit();
  }
}

void note_finished(const std::string& folder, std::uint64_t runs) {
  raise(folder, runs, runs);
}

Manifest read_manifest(const std::string& folder) {
  const std::string path = folder + "/manifest.json";
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw InputError(
        ExitCode::store,
        fmt::format("{}: holds no results of `driftscope run` (expected manifest.json in "
                    "it). Give the folder that was named with -o",
                    folder));
  try {
    return from_text(std::string(std::istreambuf_iterator<char>(file), {}));
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(
        ExitCode::store,
        fmt::format("{}: damaged or of another version: {} (expected a manifest of format "
                    "{}). Restore the file from a copy, or begin in another folder",
                    path, error.what(), Manifest::format));
  }
}

}  // namespace drift::mc
