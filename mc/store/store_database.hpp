#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "mc/store/file_version.hpp"
#include "mc/store/worker_lock.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace drift::mc {

struct FinalizeStatement {
  void operator()(sqlite3_stmt* s) const;
};

/// Statements of a database that nobody executes at the moment, by their text: preparing one costs
/// more than reading a block by it.
using IdleStatements =
    std::map<std::string, std::unique_ptr<sqlite3_stmt, FinalizeStatement>, std::less<>>;

/// One SQL statement, made once, executed many times; idle at the end of its life.
class Statement {
 public:
  Statement(sqlite3* db, std::string path, std::string_view sql, IdleStatements& idle);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(int position, std::int64_t value);
  Statement& bind(int position, double value);  ///< NaN becomes NULL
  Statement& bind_text(int position, std::string_view value);
  Statement& bind_blob(int position, std::string_view value);
  /// True while there are rows; afterwards the statement can be bound and executed again.
  bool step();
  void run() {
    while (step()) {
    }
  }

  std::int64_t integer(int column) const;
  double real(int column) const;        ///< NULL becomes NaN
  std::string bytes(int column) const;  ///< of a text or a blob

 private:
  sqlite3* db_;
  std::string path_, sql_;
  IdleStatements& idle_;
  std::unique_ptr<sqlite3_stmt, FinalizeStatement> statement_;
};

/// A SQLite file. Errors are InputError: io if the disk or the folder is to blame (resumable),
/// store if the file itself is damaged.
class Database {
 public:
  enum class Use { write, draft, read, salvage };
  /// `write` makes the file if need be; `draft` too, one that is thrown away unless it is completed
  /// and then brought to the disk by its maker: no journal stands beside it. `read` finishes, where
  /// it may, what a killed writer had begun; `salvage` reads of a damaged file what it can.
  ///
  /// Without locks a writer, who is alone by its WorkerLock, opens its file as it is; a reader
  /// takes what it finds, undoes nothing, and must look by is_outdated() whether that has changed.
  Database(std::string path, Use use, Locks locks = Locks::kernel);
  Database(const Database&) = delete;  // SQLite keeps its address, to wait for locks
  Database& operator=(const Database&) = delete;

  /// True where a file that is read without locks is no longer what was opened.
  bool is_outdated() const;
  /// Opens the file anew. No statement may be at work.
  void reopen();

  void execute(const char* sql);
  Statement prepare(std::string_view sql) { return {db_.get(), path_, sql, idle_}; }
  const std::string& path() const { return path_; }
  Use use() const { return use_; }
  /// The structure of the file is sound, and its indices are those of the tables.
  bool sound();

 private:
  struct Close {
    void operator()(sqlite3* db) const;
  };
  std::string path_;
  Use use_;
  Locks locks_;
  std::optional<FileVersion> opened_;  ///< where a reader has no locks
  std::unique_ptr<sqlite3, Close> db_;
  IdleStatements idle_;
};

/// A change of the file that happens as a whole or not at all; undone unless committed.
class Transaction {
 public:
  explicit Transaction(Database& db) : db_(db) { db_.execute("BEGIN IMMEDIATE"); }
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& db_;
  bool open_ = true;
};

}  // namespace drift::mc
