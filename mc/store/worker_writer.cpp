#include "mc/store/worker_writer.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/base/check.hpp"
#include "core/base/results/marks.hpp"
#include "mc/store/origin.hpp"

namespace drift::mc {
namespace {

constexpr const char* tables_sql = R"(
CREATE TABLE IF NOT EXISTS study (key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS sessions (id INTEGER PRIMARY KEY, runs INTEGER, started_utc TEXT, ended_utc TEXT,
  exit_code INTEGER, facts TEXT);
CREATE TABLE IF NOT EXISTS columns (point INTEGER, number INTEGER, name TEXT, unit TEXT,
  PRIMARY KEY (point, number)) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS failures (block INTEGER, point INTEGER, run INTEGER, status INTEGER, cause TEXT,
  t_s REAL, seconds REAL, PRIMARY KEY (block, run)) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS moments (block INTEGER, number INTEGER, n INTEGER, mean REAL, m2 REAL,
  PRIMARY KEY (block, number)) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS blocks (id INTEGER PRIMARY KEY, point INTEGER, first_run INTEGER, runs INTEGER,
  failed INTEGER, integration_s REAL, filter_s REAL, total_s REAL, committed_utc TEXT, checksum BLOB, payload BLOB);
CREATE INDEX IF NOT EXISTS listing ON blocks (id, point, first_run, runs, failed);
)";

}  // namespace

WorkerWriter::WorkerWriter(const std::string& path, std::shared_ptr<const Manifest> manifest,
                           Locks locks, Database::Use use)
    : WorkerFile(path, std::move(manifest), use, locks) {
  if (!sound() || is_foreign()) throw InputError(ExitCode::store, path + ": damaged");
  WorkerFile::require_same_origin();
  Transaction all(db_);
  db_.execute(tables_sql);
  mark();
  describe();
  remove_damaged();
  remove_damaged_sessions();
  kept_.mend();
  all.commit();
}

std::int64_t WorkerWriter::begin_session(std::uint64_t runs) {
  nlohmann::ordered_json facts;
  for (const auto& [key, value] : provenance()) facts[key] = value;
  facts["runs"] = std::to_string(runs);  // once more: a damaged number is known by that
  Statement insert =
      db_.prepare("INSERT INTO sessions (runs, started_utc, facts) VALUES (?1, ?2, ?3)");
  insert.bind(1, static_cast<std::int64_t>(runs))
      .bind_text(2, utc_now())
      .bind_text(3, facts.dump())
      .run();
  return last_id();
}

void WorkerWriter::end_session(std::int64_t session, int exit_code) {
  Statement update =
      db_.prepare("UPDATE sessions SET ended_utc = ?2, exit_code = ?3 WHERE id = ?1");
  update.bind(1, session).bind_text(2, utc_now()).bind(3, std::int64_t{exit_code}).run();
}

void WorkerWriter::insert(std::span<const StoredBlock> blocks) {
  Transaction all(db_);
  for (const StoredBlock& b : blocks) {
    insert(b);
    kept_.forget(key_of(b.block));
  }
  all.commit();
}

void WorkerWriter::keep(std::span<const StoredBlock> parts) {
  Transaction all(db_);
  kept_.keep(parts);
  all.commit();
}

std::size_t WorkerWriter::salvage(const std::string& damaged, Locks locks) {
  Transaction all(db_);
  std::size_t saved = 0, lost = 0;
  try {
    WorkerFile old(damaged, manifest_, Database::Use::salvage, locks);
    for (const BlockEntry& e : old.entries(0))
      if (const auto block = old.read(e)) {
        insert(*block);
        ++saved;
      }
    kept_.keep(old.kept([](const BlockKey&) { return true; }, lost));
  } catch (const InputError& error) {
    if (error.code() != ExitCode::store) throw;
  }
  all.commit();
  return saved;
}

void WorkerWriter::forget_kept() {
  Transaction all(db_);
  kept_.forget_all();
  all.commit();
}

/// Somebody else's database is not written into.
bool WorkerWriter::is_foreign() {
  Statement query = db_.prepare(
      "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name NOT LIKE 'sqlite%' AND "
      "name NOT IN ('study', 'sessions', 'columns', 'failures', 'moments', 'blocks', 'partial', "
      "'partial_failures')");
  return query.step() && query.integer(0) > 0;
}

std::int64_t WorkerWriter::last_id() {
  Statement query = db_.prepare("SELECT last_insert_rowid()");
  query.step();
  return query.integer(0);
}

/// By which the file is known for ours where all that stood beside it is lost.
void WorkerWriter::mark() {
  Statement id = db_.prepare("PRAGMA application_id");
  if (id.step() && id.integer(0) == results_database_id) return;
  db_.execute(fmt::format("PRAGMA application_id={}", results_database_id).c_str());
}

void WorkerWriter::describe() {
  if (is_described()) return;
  db_.execute("DELETE FROM study; DELETE FROM columns");
  Statement fact = db_.prepare("INSERT INTO study VALUES (?1, ?2)");
  for (const auto& [key, value] : origin_of(*manifest_))
    fact.bind_text(1, key).bind_text(2, value).run();
  Statement column = db_.prepare("INSERT INTO columns VALUES (?1, ?2, ?3, ?4)");
  for (std::size_t p = 0; p < manifest_->points.size(); ++p) {
    const auto& columns = manifest_->points[p].columns;
    for (std::size_t c = 0; c < columns.size(); ++c)
      column.bind(1, static_cast<std::int64_t>(p))
          .bind(2, static_cast<std::int64_t>(c))
          .bind_text(3, columns[c].name)
          .bind_text(4, columns[c].unit.symbol.view())
          .run();
  }
}

void WorkerWriter::remove_damaged() {
  bool damaged = false;
  std::vector<std::int64_t> bad;
  for (const BlockEntry& e : entries(0, &damaged)) {
    const auto stored = read(e);
    if (!stored) {
      bad.push_back(e.id);
      continue;
    }
    if (!moments_fit(e.id, stored->block)) renew_moments(e.id, stored->block);
    if (e.failed != stored->failures.size()) renew_failed(e.id, stored->failures.size());
  }
  if (damaged) throw InputError(ExitCode::store, path() + ": damaged");  // set aside by the caller
  for (const std::int64_t id : bad)
    for (const char* sql :
         {"DELETE FROM blocks WHERE id = ?1", "DELETE FROM failures WHERE block = ?1",
          "DELETE FROM moments WHERE block = ?1"})
      db_.prepare(sql).bind(1, id).run();
  removed_ = bad.size();
  // Rows of blocks that are gone would stand in the way of later ones.
  for (const char* sql : {"DELETE FROM failures WHERE block NOT IN (SELECT id FROM blocks)",
                          "DELETE FROM moments WHERE block NOT IN (SELECT id FROM blocks)"})
    db_.prepare(sql).run();
}

/// Those whose number of runs is beyond reason, or not what their facts repeat.
void WorkerWriter::remove_damaged_sessions() {
  db_.execute(
      "DELETE FROM sessions WHERE runs > 1000000000 OR CAST(coalesce(json_extract(CASE WHEN "
      "json_valid(facts) THEN facts ELSE '{}' END, '$.runs'), runs) AS INTEGER) <> runs");
}

void WorkerWriter::insert(const StoredBlock& b) {
  const BlockKey key = key_of(b.block);
  const std::size_t columns = manifest_->points.at(key.point).columns.size();
  const std::string payload = encode(b.block, columns);
  Statement block = db_.prepare(
      "INSERT INTO blocks (point, first_run, runs, failed, integration_s, filter_s, total_s, "
      "committed_utc, checksum, "
      "payload) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10)");
  block.bind(1, static_cast<std::int64_t>(key.point)).bind(2, static_cast<std::int64_t>(key.first));
  block.bind(3, static_cast<std::int64_t>(key.count))
      .bind(4, static_cast<std::int64_t>(b.failures.size()));
  block.bind(5, b.times.integration_s)
      .bind(6, b.times.filter_s)
      .bind(7, b.times.total_s)
      .bind_text(8, utc_now());
  block.bind_blob(9, checksum(manifest_->hash, key, payload + encode(b.failures)))
      .bind_blob(10, payload)
      .run();
  const std::int64_t id = last_id();
  Statement failure = db_.prepare("INSERT INTO failures VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)");
  for (const Failure& f : b.failures) {
    failure.bind(1, id)
        .bind(2, static_cast<std::int64_t>(key.point))
        .bind(3, static_cast<std::int64_t>(f.run));
    failure.bind(4, static_cast<std::int64_t>(f.status))
        .bind_text(5, f.cause)
        .bind(6, f.t)
        .bind(7, f.seconds)
        .run();
  }
  insert_moments(id, b.block, columns);
}

void WorkerWriter::renew_moments(std::int64_t id, const Block& block) {
  db_.prepare("DELETE FROM moments WHERE block = ?1").bind(1, id).run();
  insert_moments(id, block, manifest_->points.at(block.point).columns.size());
}

void WorkerWriter::renew_failed(std::int64_t id, std::size_t failed) {
  Statement update = db_.prepare("UPDATE blocks SET failed = ?2 WHERE id = ?1");
  update.bind(1, id).bind(2, static_cast<std::int64_t>(failed)).run();
}

void WorkerWriter::insert_moments(std::int64_t id, const Block& block, std::size_t columns) {
  Statement insert = db_.prepare("INSERT INTO moments VALUES (?1, ?2, ?3, ?4, ?5)");
  for (std::size_t c = 0; c < columns; ++c) {
    const Moments m = moments(block, c, columns);
    insert.bind(1, id)
        .bind(2, static_cast<std::int64_t>(c))
        .bind(3, static_cast<std::int64_t>(m.n));
    insert.bind(4, m.mean).bind(5, m.m2).run();
  }
}

}  // namespace drift::mc
