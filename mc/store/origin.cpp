#include "mc/store/origin.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/sha256.hpp"
#include "mc/store/store.hpp"
#include "mc/store/text_difference.hpp"

namespace drift::mc {
namespace {

using Table = std::map<std::string, std::string>;

/// Over all but the text of the study, which says nothing that its hash does not.
std::string seal_of(const Table& table) {
  std::string text;
  for (const auto& [key, value] : table)
    if (key != "study" && key != "seal") text.append(key).append("=").append(value).append("\n");
  return sha256_hex(text);
}

std::string at(const Table& table, const char* key) {
  const auto found = table.find(key);
  return found == table.end() ? "" : found->second;
}

Table table_of(const Manifest& manifest) {
  Table table{{"format", std::to_string(Manifest::format)},
              {"study_hash", manifest.hash},
              {"study", manifest.study},
              {"seed", std::to_string(manifest.identity.seed)},
              {"block_size", std::to_string(manifest.identity.block_size)},
              {"program", manifest.program},
              {"compiler", compiler_of(manifest)},
              {"instruction_set", manifest.instruction_set},
              {"arithmetic", manifest.arithmetic}};
  table["seal"] = seal_of(table);
  return table;
}

}  // namespace

OtherOrigin::OtherOrigin(const std::string& path, const std::vector<std::string>& differ)
    : InputError(ExitCode::store,
                 fmt::format("{}: holds results of another study, program or arithmetic (expected "
                             "those of the study that the folder is of). Move the file away, or "
                             "run the study that it is of, where its results were computed; what "
                             "differs, - in the file, + expected:\n  {}",
                             path, fmt::join(differ, "\n  "))) {}

Facts origin_of(const Manifest& manifest) {
  Facts facts;
  for (const auto& [key, value] : table_of(manifest)) facts.emplace_back(key, value);
  return facts;
}

std::string compiler_of(const Manifest& manifest) {
  for (const auto& [key, value] : manifest.provenance)
    if (key == "compiler") return value;
  return "unknown";
}

std::vector<std::string> other_origin(const Table& is, const Manifest& wanted) {
  if (at(is, "seal") != seal_of(is)) return {};
  const Table expected = table_of(wanted);
  std::vector<std::string> lines;
  for (const auto& [key, value] : expected) {
    if (key == "study" || key == "seal" || at(is, key.c_str()) == value) continue;
    lines.push_back(fmt::format("- {} {}", key, at(is, key.c_str())));
    lines.push_back(fmt::format("+ {} {}", key, value));
  }
  if (at(is, "study_hash") != wanted.hash)
    for (std::string& line : difference(at(is, "study"), wanted.study))
      lines.push_back(std::move(line));
  return lines;
}

bool same_origin(const Table& is, const Manifest& wanted) {
  for (const auto& [key, value] : table_of(wanted)) {
    const bool new_key = key == "seal" || key == "compiler" || key == "instruction_set";
    if (new_key && !is.contains(key)) continue;
    if (key != "study" && at(is, key.c_str()) != value) return false;
  }
  return true;
}

void require_same_origin(const std::string& folder, const Manifest& wanted) {
  const auto manifest = std::make_shared<const Manifest>(wanted);
  for (const std::string& path : worker_files(folder)) {
    require_worker_file(path);
    try {
      WorkerFile(path, manifest, Database::Use::read, probe_locks(path)).require_same_origin();
    } catch (const OtherOrigin&) {
      throw;
    } catch (const InputError& error) {
      if (error.code() != ExitCode::store) throw;  // damaged: nothing is known of it
    }
  }
}

}  // namespace drift::mc
