#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/sha256.hpp"
#include "mc/store/file_version.hpp"
#include "mc/store/store.hpp"

namespace drift::mc {

/// What is to be done about a damaged worker file, which only its own worker writes.
inline constexpr const char* whole_blocks_are_taken_over =
    "Leave it where it is and run the same command (the one of this worker): whole blocks are "
    "taken "
    "over from it";

/// The results in a folder, from any number of worker files, in order of points and runs whoever
/// computed them. Keeps one block in memory at a time.
class StudyReader {
 public:
  /// InputError (store) if the folder holds no study. Damaged files and blocks are left out;
  /// notes() names them.
  explicit StudyReader(const std::string& folder);
  /// The same by a manifest that the folder, which may be empty or not there, has lost or not got
  /// yet.
  StudyReader(const std::string& folder, std::shared_ptr<const Manifest> manifest);

  const Manifest& manifest() const { return *manifest_; }
  /// Runs per study point: the most that any session was asked for, by its worker file or the
  /// manifest, which outlives the worker files.
  std::uint64_t runs() const { return asked_; }
  std::vector<Session> sessions();
  /// Looks for blocks stored since, by this or any other worker. A file that was replaced or
  /// removed since counts as what its name has now.
  void refresh();

  /// Blocks in order (the largest where there are several of the same first run), not yet verified.
  std::vector<BlockKey> keys() const;
  /// What is listed at this place (the largest), not yet verified; or nothing.
  const BlockEntry* listed(std::size_t point, std::uint64_t first) const;
  /// The verified block at this place, or nothing. InputError (self_check) if two workers came to
  /// different results.
  std::optional<StoredBlock> read(std::size_t point, std::uint64_t first);
  /// Takes every block at this place, damaged ones as nothing.
  void each_copy(
      std::size_t point, std::uint64_t first,
      const std::function<void(const std::string& file, const std::optional<StoredBlock>&)>& visit);

  /// Runs of blocks that are not stored whole, kept by sessions that were stopped in them: no
  /// results. In order of points and runs; of equal parts one. `wanted`: blocks by their place, all
  /// unless given.
  using WantedPlace = std::function<bool(std::size_t point, std::uint64_t first)>;
  std::vector<StoredBlock> kept(const WantedPlace& wanted = {});

  using Visitor = std::function<void(const StoredBlock&)>;
  /// The results of all points in order: of every point the blocks up to the one with which the
  /// stop rule had enough, or all. Blocks beyond are surplus that parallel workers may have
  /// computed.
  void each_result(const StopRules& rules, const Visitor& visit);
  /// The same of one point; true if the stop rule had enough.
  bool each_result(const StopRules& rules, std::size_t point, const Visitor& visit);

  /// Damage met so far, a line each.
  const std::vector<std::string>& notes() const { return notes_; }
  /// How often read() found something listed at its place, and nothing whole.
  std::size_t unreadable() const { return unreadable_; }
  const std::vector<std::string>& files() const { return paths_; }
  /// The structure of every file is sound; those that are not, by path.
  std::vector<std::string> unsound();
  /// Tables of the files that say something else than manifest and blocks, a line each.
  std::vector<std::string> misfits();

 private:
  struct Source {
    std::unique_ptr<WorkerFile> file;
    FileIdentity identity = {};  ///< of what was opened
    std::int64_t last_id = 0;
    bool known = false;  ///< of the study, by its own table
  };
  void note(std::string text);
  void forget_files_that_are_gone();

  std::string folder_;
  std::shared_ptr<const Manifest> manifest_;
  std::vector<std::string> paths_;
  std::map<std::string, Source> sources_;
  std::map<std::pair<std::size_t, std::uint64_t>, std::vector<std::pair<std::string, BlockEntry>>>
      index_;
  std::uint64_t asked_ = 0;
  std::vector<std::string> notes_;
  std::size_t unreadable_ = 0;
  Locks locks_;
};

/// SHA-256 over key and payload of results as each_result() visits them, in hexadecimal: what is
/// equal for any threads, workers, ranks and interruptions.
class ResultsDigest {
 public:
  explicit ResultsDigest(const Manifest& manifest) : manifest_(manifest) {}
  void add(const StoredBlock& b);
  std::string finish();

 private:
  const Manifest& manifest_;
  Sha256 hash_;
};

/// That of all results.
std::string results_digest(StudyReader& reader, const StopRules& rules);

/// What a study has to do: blocks of every point that make up `runs` runs.
std::vector<BlockKey> all_blocks(const Manifest& manifest, std::uint64_t runs);

}  // namespace drift::mc
