#include "mc/store/store_database.hpp"

#include <sqlite3.h>

#include <chrono>
#include <filesystem>
#include <limits>
#include <thread>

#include "core/base/check.hpp"
#include "core/base/words.hpp"
#include "mc/store/lock_holder.hpp"

namespace drift::mc {
namespace {

constexpr std::size_t longest_path = 500;  // [bytes] SQLite takes 512, with its journal's ending
constexpr int busy_ms = 20000;             // a reader holds the file for moments only
constexpr int stopped_ms = 1000;           // long enough for a process that is stopped for a moment

/// The path with the links in its folder resolved: those the user may give, a link in place of the
/// file itself is not followed.
std::string with_real_folder(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code none;
  const fs::path folder = fs::canonical(fs::absolute(fs::path(path), none).parent_path(), none);
  return none ? path : (folder / fs::path(path).filename()).string();
}

/// The name by which SQLite neither locks a file nor looks for what a writer is about to do to it.
std::string immutable_uri(const std::string& path) {
  std::string uri = "file:";
  for (const char c : path)
    uri += c == '%' || c == '?' || c == '#' ? fmt::format("%{:02x}", static_cast<int>(c))
                                            : std::string(1, c);
  return uri + "?immutable=1";
}

/// Waits for a lock, `times` counting from 0: true to try again. Who is stopped is not waited for.
int wait_for_lock(void* path, int times) {
  constexpr int step_ms = 20;
  if (times * step_ms >= busy_ms) return 0;
  if (times > 0 && times * step_ms % stopped_ms == 0)
    if (const auto holder = lock_holder(*static_cast<std::string*>(path));
        holder && holder->is_stopped)
      return 0;
  std::this_thread::sleep_for(std::chrono::milliseconds(step_ms));
  return 1;
}

[[noreturn]] void fail_locked(const std::string& path, const std::string& why) {
  const auto holder = lock_holder(path);
  if (holder && holder->is_stopped)
    throw InputError(
        ExitCode::io,
        fmt::format("{}: process {} keeps the file locked and is stopped in the middle of a "
                    "change (expected one that goes on). Continue it with `kill -CONT {}` or end "
                    "it, nothing that is stored is lost; then run the same command again",
                    path, holder->process, holder->process));
  throw InputError(
      ExitCode::io,
      fmt::format(
          "{}: {} keeps the file locked: {} (expected access within {} s). Close it and run "
          "the same command again",
          path, holder ? fmt::format("process {}", holder->process) : "another program", why,
          busy_ms / 1000));
}

/// Says so, if the file was taken away under the hands of who works on it.
void fail_gone(const std::string& path) {
  std::error_code none;
  if (std::filesystem::exists(path, none) || none) return;
  throw InputError(
      ExitCode::io,
      fmt::format("{}: was removed or renamed while it was in use (expected to stay where it is "
                  "until the command ends). What it held is not lost if it was renamed: put it "
                  "back; then run the same command again",
                  path));
}

/// Says so, if a change that was broken off has to be undone and the file may not be written to.
void fail_half_changed(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::exists(path + "-journal", none)) return;
  throw InputError(
      ExitCode::io,
      fmt::format("{}: the process that wrote it was ended in the middle of a change, which must "
                  "be undone first, and it cannot be written to from here (expected write "
                  "permission, once). Let somebody who has it run `driftscope status {}`",
                  path, shell_word(std::filesystem::path(path).parent_path().string())));
}

[[noreturn]] void fail(sqlite3* db, const std::string& path, int code) {
  const std::string why = db != nullptr ? sqlite3_errmsg(db) : sqlite3_errstr(code);
  switch (code & 0xff) {
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
    case SQLITE_FORMAT:
    case SQLITE_ERROR:   // a table that should be there is not
    case SQLITE_TOOBIG:  // a length that no row has
    case SQLITE_MISMATCH:
    case SQLITE_CONSTRAINT:
    case SQLITE_SCHEMA:
      throw InputError(
          ExitCode::store,
          fmt::format("{}: the file is damaged: {} (expected a worker file of driftscope). Run the "
                      "same command again: damaged blocks are computed anew",
                      path, why));
    case SQLITE_FULL:
    case SQLITE_IOERR:
      fail_gone(path);
      throw InputError(
          ExitCode::io,
          fmt::format(
              "{}: cannot be written or read: {} (expected free space on the disk). What is "
              "stored is safe; make room and run the same command again",
              path, why));
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      fail_locked(path, why);
    case SQLITE_READONLY:
      fail_gone(path);
      [[fallthrough]];
    case SQLITE_CANTOPEN:
      fail_half_changed(path);
      if (std::error_code none; std::filesystem::is_symlink(path, none))
        throw InputError(ExitCode::store,
                         fmt::format("{}: is a symbolic link, which is not followed (expected a "
                                     "file of its own). Put a copy in its place",
                                     path));
      if (with_real_folder(path).size() > longest_path)
        throw InputError(
            ExitCode::io,
            fmt::format("{}: the path is too long for SQLite (expected at most {} bytes from the "
                        "root on). Choose a folder nearer to the root",
                        path, longest_path));
      [[fallthrough]];
    default:
      throw InputError(
          ExitCode::io,
          fmt::format("{}: cannot be opened or written: {} (expected a writable file in "
                      "a writable folder). Nothing was changed; mend it and run the same "
                      "command again",
                      path, why));
    case SQLITE_NOMEM:
      throw std::bad_alloc();
  }
}

}  // namespace

void FinalizeStatement::operator()(sqlite3_stmt* s) const {
  sqlite3_finalize(s);
}
void Database::Close::operator()(sqlite3* db) const {
  sqlite3_close_v2(db);
}

Statement::Statement(sqlite3* db, std::string path, std::string_view sql, IdleStatements& idle)
    : db_(db), path_(std::move(path)), sql_(sql), idle_(idle) {
  if (const auto kept = idle_.find(sql); kept != idle_.end()) {
    statement_ = std::move(kept->second);
    idle_.erase(kept);
    return;
  }
  sqlite3_stmt* made = nullptr;
  const int code =
      sqlite3_prepare_v2(db_, sql.data(), static_cast<int>(sql.size()), &made, nullptr);
  statement_.reset(made);
  if (code != SQLITE_OK) fail(db_, path_, code);
}

Statement::~Statement() {
  sqlite3_reset(statement_.get());  // an error of it was told by step()
  sqlite3_clear_bindings(statement_.get());
  idle_.try_emplace(std::move(sql_), std::move(statement_));
}

Statement& Statement::bind(int position, std::int64_t value) {
  if (const int code = sqlite3_bind_int64(statement_.get(), position, value); code != SQLITE_OK)
    fail(db_, path_, code);
  return *this;
}

Statement& Statement::bind(int position, double value) {
  if (const int code = sqlite3_bind_double(statement_.get(), position, value); code != SQLITE_OK)
    fail(db_, path_, code);
  return *this;
}

Statement& Statement::bind_text(int position, std::string_view value) {
  const int code = sqlite3_bind_text64(statement_.get(), position, value.data(), value.size(),
                                       SQLITE_TRANSIENT, SQLITE_UTF8);
  if (code != SQLITE_OK) fail(db_, path_, code);
  return *this;
}

Statement& Statement::bind_blob(int position, std::string_view value) {
  const int code =
      sqlite3_bind_blob64(statement_.get(), position, value.data(), value.size(), SQLITE_TRANSIENT);
  if (code != SQLITE_OK) fail(db_, path_, code);
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) {
    const int extended = sqlite3_extended_errcode(db_);
    sqlite3_reset(statement_.get());
    fail(db_, path_, extended != SQLITE_OK ? extended : code);
  }
  sqlite3_reset(statement_.get());
  return false;
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

double Statement::real(int column) const {
  if (sqlite3_column_type(statement_.get(), column) == SQLITE_NULL)
    return std::numeric_limits<double>::quiet_NaN();
  return sqlite3_column_double(statement_.get(), column);
}

std::string Statement::bytes(int column) const {
  const auto* data = static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return data == nullptr ? std::string() : std::string(data, static_cast<std::size_t>(size));
}

Database::Database(std::string path, Use use, Locks locks)
    : path_(std::move(path)), use_(use), locks_(locks) {
  reopen();
}

bool Database::is_outdated() const {
  return opened_ && version_of(path_) != *opened_;
}

void Database::reopen() {
  idle_.clear();
  db_.reset();
  sqlite3* made = nullptr;
  const bool writes = use_ == Use::write || use_ == Use::draft;
  const bool unlocked_reader = locks_ == Locks::none && use_ == Use::read;
  if (unlocked_reader) opened_ = version_of(path_);
  // A reader may write too: only so can it undo what a killed writer left half done.
  const int flags =
      SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_NOFOLLOW |
      (unlocked_reader ? SQLITE_OPEN_READONLY | SQLITE_OPEN_URI : SQLITE_OPEN_READWRITE) |
      (writes ? SQLITE_OPEN_CREATE : 0);
  const std::string real = with_real_folder(path_);
  const int code =
      sqlite3_open_v2(unlocked_reader ? immutable_uri(real).c_str() : real.c_str(), &made, flags,
                      locks_ == Locks::none && !unlocked_reader ? "unix-none" : nullptr);
  db_.reset(made);
  if (code != SQLITE_OK) fail(made, path_, code);
  sqlite3_extended_result_codes(made, 1);
  sqlite3_busy_handler(made, wait_for_lock, &path_);
  // A write-ahead log needs memory shared with readers, which network file systems do not have.
  // EXTRA: a journal that comes back after a power failure would undo the last change.
  if (use_ == Use::write) execute("PRAGMA journal_mode=DELETE; PRAGMA synchronous=EXTRA");
  if (use_ == Use::draft) execute("PRAGMA journal_mode=MEMORY; PRAGMA synchronous=OFF");
  // With this switch SQLite goes on where the file is shorter than its header says.
  if (use_ == Use::salvage) execute("PRAGMA writable_schema=1");
  if (!writes) execute("PRAGMA query_only=1");
}

void Database::execute(const char* sql) {
  if (const int code = sqlite3_exec(db_.get(), sql, nullptr, nullptr, nullptr); code != SQLITE_OK)
    fail(db_.get(), path_, code);
}

bool Database::sound() {
  try {
    Statement check = prepare("PRAGMA integrity_check(1)");
    return check.step() && check.bytes(0) == "ok";
  } catch (const InputError& error) {
    if (error.code() != ExitCode::store) throw;
    return false;
  }
}

Transaction::~Transaction() {
  if (!open_) return;
  try {
    db_.execute("ROLLBACK");
  } catch (const std::exception&) {
    // A full disk has rolled it back already; the error that led here is on its way.
  }
}

void Transaction::commit() {
  db_.execute("COMMIT");
  open_ = false;
}

}  // namespace drift::mc
