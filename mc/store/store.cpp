#include "mc/store/store.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/base/atomic_file.hpp"
#include "core/base/check.hpp"
#include "core/base/temporary_file.hpp"
#include "mc/store/origin.hpp"
#include "mc/store/worker_writer.hpp"

namespace drift::mc {
namespace {

/// Keeps a file that is about to be replaced. A file system without hard links gets a copy.
void give_second_name(const std::string& path, const std::string& second) {
  if (::link(path.c_str(), second.c_str()) == 0) return;
  if (errno != EPERM && errno != ENOTSUP && errno != ENOSYS)
    throw_cannot_write(second, std::strerror(errno));
  std::error_code failed;
  if (std::filesystem::copy_file(path, second, failed)) return;
  std::error_code none;
  std::filesystem::remove(second, none);
  throw_cannot_write(second, failed.message());
}

}  // namespace

WorkerStore::WorkerStore(const std::string& folder, std::size_t worker, const Manifest& manifest,
                         double patience)
    : path_(worker_path(folder, worker)),
      manifest_(std::make_shared<Manifest>(manifest)),
      lock_(path_, patience) {
  if (lock_.locks() == Locks::none)
    notes_.push_back(
        fmt::format("{}: this file system has no locks; every worker's file is opened without "
                    "them, and kept for one process by worker-*.holder.lock",
                    folder));
  require_worker_file(path_);  // what is no file is not set aside as a damaged one
  try {
    writer_ = std::make_unique<WorkerWriter>(path_, manifest_, lock_.locks());
    if (writer_->removed() > 0)
      notes_.push_back(fmt::format("{}: {} damaged blocks removed; they are computed anew", path_,
                                   writer_->removed()));
  } catch (const OtherOrigin&) {
    throw;
  } catch (const InputError& error) {
    if (error.code() != ExitCode::store) throw;
    set_aside();
  }
}

WorkerStore::~WorkerStore() = default;

/// Until the new file stands in the place of the damaged one, that has its name: whoever is killed
/// or finds the disk full on the way leaves it to the next session, which begins anew.
void WorkerStore::set_aside() {
  namespace fs = std::filesystem;
  remove_stale_temporaries(fs::path(path_).parent_path().string());  // of who was killed here
  AtomicFile whole(path_);
  const std::size_t saved =
      WorkerWriter(whole.temporary(), manifest_, lock_.locks(), Database::Use::draft)
          .salvage(path_, lock_.locks());
  const std::string stem = path_.substr(0, path_.size() - 7);
  std::string aside;
  for (int i = 1; fs::exists(aside = fmt::format("{}.damaged-{}", stem, i)); ++i) {
  }
  give_second_name(path_, aside);
  // A journal that could not be played back belongs to it: beside the new file it would be taken
  // for that file's.
  std::error_code none;
  fs::rename(path_ + "-journal", aside + "-journal", none);
  whole.commit();
  writer_ = std::make_unique<WorkerWriter>(path_, manifest_, lock_.locks());
  notes_.push_back(fmt::format(
      "{}: damaged, set aside as {}; {} whole blocks taken over from it, the others are "
      "computed anew",
      path_, aside, saved));
}

void WorkerStore::begin_session(std::uint64_t runs) {
  session_ = writer_->begin_session(runs);
}
void WorkerStore::end_session(int exit_code) {
  writer_->end_session(session_, exit_code);
}
void WorkerStore::commit(std::span<const StoredBlock> blocks) {
  writer_->insert(blocks);
}
void WorkerStore::keep(std::span<const StoredBlock> parts) {
  if (!parts.empty()) writer_->keep(parts);
}
void WorkerStore::forget_kept() {
  writer_->forget_kept();
}

}  // namespace drift::mc
