#include "mc/store/kept_runs.hpp"

#include "core/base/check.hpp"

namespace drift::mc {
namespace {

constexpr const char* kept_tables_sql = R"(
CREATE TABLE IF NOT EXISTS partial (point INTEGER, first_run INTEGER, runs INTEGER, integration_s REAL,
  filter_s REAL, total_s REAL, checksum BLOB, payload BLOB, PRIMARY KEY (point, first_run));
CREATE TABLE IF NOT EXISTS partial_failures (point INTEGER, run INTEGER, status INTEGER, cause TEXT,
  t_s REAL, seconds REAL, PRIMARY KEY (point, run)) WITHOUT ROWID;
)";
constexpr const char* kept_parts_sql =
    "SELECT point, first_run, runs, integration_s, filter_s, total_s, checksum, payload FROM "
    "partial ORDER BY point, first_run";
constexpr const char* kept_failures_sql =
    "SELECT run, status, cause, t_s, seconds FROM partial_failures WHERE point = ?1 AND run >= ?2 "
    "AND run < ?3 ORDER BY run";

void bind_runs(Statement& statement, const BlockKey& runs) {
  statement.bind(1, static_cast<std::int64_t>(runs.point))
      .bind(2, static_cast<std::int64_t>(runs.first))
      .bind(3, static_cast<std::int64_t>(runs.first + runs.count));
}

}  // namespace

bool KeptRuns::any() {
  Statement query =
      db_.prepare("SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = 'partial'");
  return query.step() && query.integer(0) > 0;
}

std::string KeptRuns::seal(const BlockKey& part, const std::string& payload,
                           const std::vector<Failure>& failures) const {
  return checksum(manifest_.hash, part, "partial\n" + payload + encode(failures));
}

std::vector<Failure> KeptRuns::failures(const BlockKey& part) {
  std::vector<Failure> list;
  Statement query = db_.prepare(kept_failures_sql);
  bind_runs(query, part);
  while (query.step())
    list.push_back({static_cast<std::uint64_t>(query.integer(0)),
                    static_cast<RunStatus>(query.integer(1)), query.bytes(2), query.real(3),
                    query.real(4)});
  return list;
}

std::vector<StoredBlock> KeptRuns::read(const Wanted& wanted, std::size_t& damaged) {
  std::vector<StoredBlock> parts;
  damaged = 0;
  const auto size = static_cast<std::int64_t>(manifest_.identity.block_size);
  bool there = false;  // what damages all of the file is told by who lists its blocks
  try {
    if (!(there = any())) return parts;
    Statement query = db_.prepare(kept_parts_sql);
    while (query.step()) {
      const auto point = query.integer(0), first = query.integer(1), runs = query.integer(2);
      // What no worker ever writes is damage.
      if (point < 0 || static_cast<std::size_t>(point) >= manifest_.points.size() || first < 0 ||
          runs <= 0 || runs > size || first % size + runs > size) {
        ++damaged;
        continue;
      }
      const BlockKey key{static_cast<std::size_t>(point), static_cast<std::uint64_t>(first),
                         static_cast<std::size_t>(runs)};
      if (!wanted(key)) continue;
      StoredBlock part;
      part.times = {query.real(3), query.real(4), query.real(5)};
      part.failures = failures(key);
      const std::string payload = query.bytes(7);
      auto block = decode(key, manifest_.points[key.point].columns.size(), payload);
      if (!block || seal(key, payload, part.failures) != query.bytes(6)) {
        ++damaged;
        continue;
      }
      part.block = std::move(*block);
      parts.push_back(std::move(part));
    }
  } catch (const InputError& error) {
    if (error.code() != ExitCode::store) throw;
    damaged += there;
  }
  return parts;
}

void KeptRuns::keep(std::span<const StoredBlock> parts) {
  if (parts.empty()) return;
  db_.execute(kept_tables_sql);
  Statement insert =
      db_.prepare("INSERT OR REPLACE INTO partial VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)");
  Statement failure =
      db_.prepare("INSERT OR REPLACE INTO partial_failures VALUES (?1, ?2, ?3, ?4, ?5, ?6)");
  for (const StoredBlock& part : parts) {
    const BlockKey key = key_of(part.block);
    remove(key);
    const std::string payload = encode(part.block, manifest_.points.at(key.point).columns.size());
    insert.bind(1, static_cast<std::int64_t>(key.point))
        .bind(2, static_cast<std::int64_t>(key.first))
        .bind(3, static_cast<std::int64_t>(key.count))
        .bind(4, part.times.integration_s)
        .bind(5, part.times.filter_s)
        .bind(6, part.times.total_s)
        .bind_blob(7, seal(key, payload, part.failures))
        .bind_blob(8, payload)
        .run();
    for (const Failure& f : part.failures)
      failure.bind(1, static_cast<std::int64_t>(key.point))
          .bind(2, static_cast<std::int64_t>(f.run))
          .bind(3, static_cast<std::int64_t>(f.status))
          .bind_text(4, f.cause)
          .bind(5, f.t)
          .bind(6, f.seconds)
          .run();
  }
}

void KeptRuns::remove(const BlockKey& runs) {
  for (const char* sql :
       {"DELETE FROM partial WHERE point = ?1 AND first_run >= ?2 AND first_run < ?3",
        "DELETE FROM partial_failures WHERE point = ?1 AND run >= ?2 AND run < ?3"}) {
    Statement statement = db_.prepare(sql);
    bind_runs(statement, runs);
    statement.run();
  }
}

void KeptRuns::forget(const BlockKey& block) {
  if (!any()) return;
  remove(block);
  bool empty = true;
  {
    Statement left = db_.prepare("SELECT 1 FROM partial LIMIT 1");
    empty = !left.step();
  }
  if (empty) forget_all();
}

void KeptRuns::forget_all() {
  db_.execute("DROP TABLE IF EXISTS partial; DROP TABLE IF EXISTS partial_failures");
}

void KeptRuns::mend() {
  try {
    if (!any()) return forget_all();
    db_.execute(kept_tables_sql);
    db_.prepare(kept_parts_sql).step();
    failures({0, 0, 1});
    remove({0, 0, 0});
  } catch (const InputError& error) {
    if (error.code() != ExitCode::store) throw;
    forget_all();
  }
}

}  // namespace drift::mc
