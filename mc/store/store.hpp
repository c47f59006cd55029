#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mc/store/kept_runs.hpp"
#include "mc/store/manifest.hpp"
#include "mc/store/store_database.hpp"
#include "mc/store/stored_block.hpp"

namespace drift::mc {

/// "folder/worker-0003.sqlite"
std::string worker_path(const std::string& folder, std::size_t worker);
/// InputError if one of its files is no file (store) or cannot be read (io).
void require_worker_file(const std::string& path);
/// All worker files of a folder, in order of their numbers.
std::vector<std::string> worker_files(const std::string& folder);

/// One call of `run` by one worker.
struct Session {
  std::uint64_t runs = 0;              ///< runs per study point that were asked for
  std::string started_utc, ended_utc;  ///< end empty: killed, or still at work
  int exit_code = -1;
  Facts facts;
  bool sound = true;  ///< what it says of `runs` is what was written
};

/// Where a block stands in a worker file.
struct BlockEntry {
  BlockKey key;
  std::int64_t id = 0;
  std::size_t failed = 0;  ///< runs; only told, not under the checksum
};

/// The file of one worker. SQLite tables (all may be looked into with `sqlite3`):
///   study     key, value: what manifest.json says
///   sessions  runs, started_utc, ended_utc, exit_code, facts (JSON)
///   columns   point, number, name, unit
///   blocks    point, first_run, runs, failed, CPU seconds, checksum, payload (block_codec.hpp)
///   failures  block, point, run, status, cause, t_s, seconds
///   moments   block, number, n, mean, m2: of the runs that are ok, finite values only, SI
/// and, while blocks are unfinished after a stop, those of kept_runs.hpp, which are no results.
/// Index `listing` repeats of `blocks` all but times, checksum and payload: who lists a file reads
/// it in place of 6 % of the file. A file without it is listed by the table, and gets it from its
/// next writer. All but `blocks` and `failures` repeat what stands elsewhere; misfits() compares
/// them. Every read verifies the checksum; damage shows as a block that is not there.
class WorkerFile {
 public:
  /// For reading. InputError (store) if the file is damaged beyond opening.
  WorkerFile(const std::string& path, std::shared_ptr<const Manifest> manifest,
             Database::Use use = Database::Use::read, Locks locks = Locks::kernel);

  /// Blocks after the one of number `id`, as the table lists them, not yet verified. Stops where
  /// the file is damaged and says so.
  std::vector<BlockEntry> entries(std::int64_t after_id, bool* damaged = nullptr);
  /// A block, or nothing if it is damaged.
  std::optional<StoredBlock> read(const BlockEntry& entry);
  /// Runs of unfinished blocks (kept_runs.hpp); `damaged`: how many parts of them are left out.
  std::vector<StoredBlock> kept(const KeptRuns::Wanted& wanted, std::size_t& damaged);
  std::vector<Session> sessions();
  /// Tables that say something else than the manifest and the blocks, a line each: of what others
  /// read in the file, nothing is believed unseen.
  std::vector<std::string> misfits();
  bool sound();
  /// OtherOrigin if the results are not of the study; whether the file says of which they are: one
  /// that another worker is about to begin does not yet.
  bool require_same_origin();
  const std::string& path() const { return db_.path(); }

 protected:
  /// Whether the tables `study` and `columns` are those of the manifest.
  bool is_described();
  /// The table `study`; empty where there is none that can be read.
  std::map<std::string, std::string> origin();
  /// Whether the moments of a block are those of its rows.
  bool moments_fit(std::int64_t id, const Block& block);
  std::vector<BlockEntry> list(std::int64_t after_id, bool& damaged);
  std::optional<StoredBlock> take(const BlockEntry& entry);
  std::vector<Session> all_sessions();
  std::vector<std::string> all_misfits();

  /// What `read` gives, of a file that did not change meanwhile. A file that is read without locks
  /// may: then it is opened anew, a few times.
  template <class Read>
  auto steadily(Read read) {
    auto result = read();
    for (int i = 0; i < 5 && db_.is_outdated(); ++i) {
      open_anew();
      result = read();
    }
    return result;
  }
  void open_anew();

  std::shared_ptr<const Manifest> manifest_;
  Database db_;
};

class WorkerWriter;

/// The file of this worker, open for writing by one process at a time.
class WorkerStore {
 public:
  /// Opens or makes the file. A damaged one is set aside as "worker-0003.damaged-1" and what is
  /// whole in it is taken over; `notes` says so. InputError: io if it cannot be written, store if
  /// another process is still at work on it after `patience` [s].
  WorkerStore(const std::string& folder, std::size_t worker, const Manifest& manifest,
              double patience = worker_patience);
  ~WorkerStore();
  WorkerStore(const WorkerStore&) = delete;
  WorkerStore& operator=(const WorkerStore&) = delete;

  void begin_session(std::uint64_t runs);
  void end_session(int exit_code);
  /// Brings blocks to the disk in one transaction: each is there as a whole or not at all.
  /// What was kept of their runs goes with it.
  void commit(std::span<const StoredBlock> blocks);
  /// Keeps runs of blocks that are not finished, for a session that goes on with them.
  void keep(std::span<const StoredBlock> parts);
  /// Nothing is left to go on with.
  void forget_kept();
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  void set_aside();

  std::string path_;
  std::shared_ptr<const Manifest> manifest_;
  WorkerLock lock_;
  std::unique_ptr<WorkerWriter> writer_;
  std::int64_t session_ = 0;
  std::vector<std::string> notes_;
};

}  // namespace drift::mc
