#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/check.hpp"
#include "core/base/results/regular_file.hpp"
#include "mc/store/origin.hpp"
#include "mc/store/settle.hpp"
#include "mc/store/store.hpp"

namespace drift::mc {
namespace {

const std::string& settled(const std::string& path, Database::Use use, Locks locks) {
  if (locks == Locks::none && use == Database::Use::read) settle(path);
  return path;
}

}  // namespace

std::string worker_path(const std::string& folder, std::size_t worker) {
  return fmt::format("{}/worker-{:04}.sqlite", folder, worker);
}

void require_worker_file(const std::string& path) {
  for (const char* beside : {"", "-journal", "-wal"}) require_regular_file_of_ours(path + beside);
}

std::vector<std::string> worker_files(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("worker-") && name.ends_with(".sqlite"))
      files.push_back(fmt::format("{}/{}", folder, name));
  }
  // Numbers of more than four digits after those of four.
  std::sort(files.begin(), files.end(), [](const std::string& a, const std::string& b) {
    return std::pair(a.size(), a) < std::pair(b.size(), b);
  });
  return files;
}

WorkerFile::WorkerFile(const std::string& path, std::shared_ptr<const Manifest> manifest,
                       Database::Use use, Locks locks)
    : manifest_(std::move(manifest)), db_(settled(path, use, locks), use, locks) {}

void WorkerFile::open_anew() {
  settle(db_.path());
  db_.reopen();
}

std::vector<BlockEntry> WorkerFile::entries(std::int64_t after_id, bool* damaged) {
  bool bad = false;
  auto found = steadily([&] { return list(after_id, bad); });
  if (damaged != nullptr && bad) *damaged = true;
  return found;
}

std::optional<StoredBlock> WorkerFile::read(const BlockEntry& entry) {
  // What fits its checksum is right, whatever was written meanwhile.
  if (auto block = take(entry)) return block;
  return steadily([&] { return take(entry); });
}

std::vector<StoredBlock> WorkerFile::kept(const KeptRuns::Wanted& wanted, std::size_t& damaged) {
  return steadily([&] { return KeptRuns(db_, *manifest_).read(wanted, damaged); });
}

std::vector<Session> WorkerFile::sessions() {
  return steadily([this] { return all_sessions(); });
}

bool WorkerFile::sound() {
  return steadily([this] { return db_.sound(); });
}

std::vector<std::string> WorkerFile::misfits() {
  return steadily([this] { return all_misfits(); });
}

std::vector<BlockEntry> WorkerFile::list(std::int64_t after_id, bool& damaged) {
  std::vector<BlockEntry> list;
  damaged = false;
  const std::size_t block = manifest_->identity.block_size;
  try {
    Statement tables = db_.prepare("SELECT count(*) FROM sqlite_master");
    if (tables.step() && tables.integer(0) == 0)
      return list;  // another worker is about to begin it
    // Who writes or salvages looks into the table itself: an index may be what is damaged.
    Statement query = db_.prepare(
        fmt::format("SELECT id, point, first_run, runs, failed FROM blocks{} WHERE id > ?1 "
                    "ORDER BY id",
                    db_.use() == Database::Use::read ? "" : " NOT INDEXED"));
    query.bind(1, after_id);
    while (query.step()) {
      const auto point = query.integer(1), first = query.integer(2), runs = query.integer(3);
      // What no worker ever writes is damage.
      if (point < 0 || static_cast<std::size_t>(point) >= manifest_->points.size() || first < 0 ||
          runs <= 0 || static_cast<std::size_t>(runs) > block ||
          static_cast<std::uint64_t>(first) % block != 0) {
        damaged = true;
        continue;
      }
      list.push_back(
          {{static_cast<std::size_t>(point), static_cast<std::uint64_t>(first),
            static_cast<std::size_t>(runs)},
           query.integer(0),
           static_cast<std::size_t>(std::clamp<std::int64_t>(query.integer(4), 0, runs))});
    }
  } catch (const InputError& error) {
    if (error.code() != ExitCode::store) throw;
    damaged = true;
  }
  return list;
}

std::optional<StoredBlock> WorkerFile::take(const BlockEntry& entry) {
  const auto& columns = manifest_->points[entry.key.point].columns;
  try {
    Statement query = db_.prepare(
        "SELECT payload, checksum, integration_s, filter_s, total_s FROM blocks WHERE id = ?1 AND "
        "point = ?2 AND "
        "first_run = ?3 AND runs = ?4");
    query.bind(1, entry.id).bind(2, static_cast<std::int64_t>(entry.key.point));
    query.bind(3, static_cast<std::int64_t>(entry.key.first))
        .bind(4, static_cast<std::int64_t>(entry.key.count));
    if (!query.step()) return std::nullopt;
    const std::string payload = query.bytes(0);
    StoredBlock stored;
    stored.times = {query.real(2), query.real(3), query.real(4)};
    Statement failed = db_.prepare(
        "SELECT run, status, cause, t_s, seconds FROM failures WHERE block = ?1 ORDER BY run");
    failed.bind(1, entry.id);
    while (failed.step())
      stored.failures.push_back({static_cast<std::uint64_t>(failed.integer(0)),
                                 static_cast<RunStatus>(failed.integer(1)), failed.bytes(2),
                                 failed.real(3), failed.real(4)});
    if (checksum(manifest_->hash, entry.key, payload + encode(stored.failures)) != query.bytes(1))
      return std::nullopt;
    auto block = decode(entry.key, columns.size(), payload);
    if (!block) return std::nullopt;
    stored.block = std::move(*block);
    return stored;
  } catch (const InputError& error) {
    if (error.code() != ExitCode::store) throw;
    return std::nullopt;
  }
}

std::vector<Session> WorkerFile::all_sessions() {
  std::vector<Session> list;
  try {
    Statement query = db_.prepare(
        "SELECT runs, started_utc, ended_utc, exit_code, facts FROM sessions ORDER BY id");
    while (query.step()) {
      Session s{static_cast<std::uint64_t>(query.integer(0)),
                query.bytes(1),
                query.bytes(2),
                static_cast<int>(query.integer(3)),
                {}};
      const auto facts = nlohmann::ordered_json::parse(query.bytes(4), nullptr, false);
      if (facts.is_object())
        for (const auto& [key, value] : facts.items())
          if (value.is_string()) s.facts.emplace_back(key, value);
      constexpr std::uint64_t most = 1000000000;  // of --runs
      s.sound =
          s.runs <= most && (!facts.contains("runs") || facts["runs"] == std::to_string(s.runs));
      list.push_back(std::move(s));
    }
  } catch (const InputError& error) {
    if (error.code() != ExitCode::store) throw;  // sessions are told, not relied upon
  }
  return list;
}

std::map<std::string, std::string> WorkerFile::origin() {
  std::map<std::string, std::string> facts;
  try {
    Statement tables = db_.prepare("SELECT count(*) FROM sqlite_master WHERE name = 'study'");
    if (!tables.step() || tables.integer(0) == 0) return facts;
    Statement study = db_.prepare("SELECT key, value FROM study");
    while (study.step()) facts[study.bytes(0)] = study.bytes(1);
  } catch (const InputError& error) {
    if (error.code() != ExitCode::store) throw;
    facts.clear();
  }
  return facts;
}

bool WorkerFile::require_same_origin() {
  const auto is = steadily([this] { return origin(); });
  const std::vector<std::string> differ = other_origin(is, *manifest_);
  if (!differ.empty()) throw OtherOrigin(path(), differ);
  return !is.empty();
}

bool WorkerFile::is_described() {
  if (!same_origin(origin(), *manifest_)) return false;
  Statement query = db_.prepare("SELECT point, number, name, unit FROM columns ORDER BY 1, 2");
  for (std::size_t p = 0; p < manifest_->points.size(); ++p)
    for (std::size_t c = 0; c < manifest_->points[p].columns.size(); ++c) {
      const Column& column = manifest_->points[p].columns[c];
      if (!query.step() || query.integer(0) != static_cast<std::int64_t>(p) ||
          query.integer(1) != static_cast<std::int64_t>(c) || query.bytes(2) != column.name ||
          query.bytes(3) != column.unit.symbol.view())
        return false;
    }
  return !query.step();
}

bool WorkerFile::moments_fit(std::int64_t id, const Block& block) {
  const std::size_t columns = manifest_->points.at(block.point).columns.size();
  Statement query =
      db_.prepare("SELECT number, n, mean, m2 FROM moments WHERE block = ?1 ORDER BY number");
  query.bind(1, id);
  const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  for (std::size_t c = 0; c < columns; ++c) {
    const Moments m = moments(block, c, columns);
    if (!query.step() || query.integer(0) != static_cast<std::int64_t>(c) ||
        query.integer(1) != static_cast<std::int64_t>(m.n) || !same(query.real(2), m.mean) ||
        !same(query.real(3), m.m2))
      return false;
  }
  return !query.step();
}

std::vector<std::string> WorkerFile::all_misfits() {
  std::vector<std::string> lines;
  try {
    bool damaged = false;
    const auto all = list(0, damaged);
    if (all.empty()) return lines;
    if (!is_described())
      lines.push_back(path() + ": the tables study and columns are not those of the manifest");
    std::size_t others = 0, miscounted = 0;
    for (const BlockEntry& e : all)
      if (const auto stored = take(e)) {
        others += !moments_fit(e.id, stored->block);
        miscounted += e.failed != stored->failures.size();
      }
    if (miscounted > 0)
      lines.push_back(
          fmt::format("{}: the number of failed runs of {} blocks is not that of their "
                      "list",
                      path(), miscounted));
    if (others > 0)
      lines.push_back(
          fmt::format("{}: the moments of {} blocks are not those of their rows", path(), others));
    for (const Session& s : all_sessions())
      if (!s.sound) lines.push_back(path() + ": the number of runs of a session is damaged");
  } catch (const InputError& error) {
    if (error.code() != ExitCode::store) throw;
    lines.push_back(path() + ": damaged, cannot be read");
  }
  return lines;
}

}  // namespace drift::mc
