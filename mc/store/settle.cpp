#include "mc/store/settle.hpp"

#include <chrono>
#include <thread>

#include "core/base/check.hpp"
#include "mc/store/store_database.hpp"

namespace drift::mc {
namespace {

/// True if there was nobody at work on the file, and it is whole again.
bool undo_half(const std::string& worker_file) {
  if (is_held(worker_file)) return false;
  try {
    const WorkerLock lock(worker_file, 0.0);
    Database(worker_file, Database::Use::salvage, lock.locks())
        .execute("SELECT 1 FROM sqlite_master");
    return true;
  } catch (
      const InputError&) {  // a folder that may not be written to, or another process came first
    return false;
  }
}

}  // namespace

void settle(const std::string& worker_file) {
  for (int i = 0; i < 40 && version_of(worker_file).changing; ++i)
    if (!undo_half(worker_file)) std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

}  // namespace drift::mc
