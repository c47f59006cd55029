#include "mc/engine/mpi_launch.hpp"

#ifdef DRIFT_WITH_MPI
#define OMPI_SKIP_MPICXX 1
#include <mpi.h>
#endif

#include <array>
#include <cstdlib>
#include <exception>
#include <mutex>

#include "core/base/check.hpp"

namespace drift::mc {
namespace {

bool started_by_a_launcher() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

}  // namespace

struct Ranks::Job {
  std::mutex guard;
  std::array<std::uint64_t, counters> own{};  ///< without MPI
  int rank = 0, size = 1;
#ifdef DRIFT_WITH_MPI
  bool started = false;
  int exceptions = std::uncaught_exceptions();
  std::uint64_t* shared = nullptr;
  MPI_Win window = MPI_WIN_NULL;

  Job() {
    if (!started_by_a_launcher()) return;
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
    if (provided < MPI_THREAD_SERIALIZED)
      throw InputError(
          ExitCode::usage,
          "mpirun: this MPI does not allow calls from threads (expected MPI_THREAD_SERIALIZED). "
          "Use --worker i/n instead");
    started = true;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    const MPI_Aint bytes = rank == 0 ? static_cast<MPI_Aint>(counters * sizeof(std::uint64_t)) : 0;
    MPI_Win_allocate(bytes, sizeof(std::uint64_t), MPI_INFO_NULL, MPI_COMM_WORLD, &shared, &window);
    if (rank == 0) {
      MPI_Win_lock(MPI_LOCK_EXCLUSIVE, 0, 0, window);
      for (std::size_t i = 0; i < counters; ++i) shared[i] = 0;
      MPI_Win_unlock(0, window);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    MPI_Win_lock_all(MPI_MODE_NOCHECK, window);
  }

  ~Job() {
    if (!started || std::uncaught_exceptions() > exceptions) return;
    MPI_Win_unlock_all(window);
    MPI_Win_free(&window);
    MPI_Finalize();
  }
#else
  Job() {
    if (started_by_a_launcher())
      throw InputError(
          ExitCode::usage,
          "mpirun: this program was built without MPI (expected MPI at configure time). Install "
          "libopenmpi-dev and build anew, or use --worker i/n");
  }
#endif
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;
};

Ranks::Ranks() : job_(std::make_unique<Job>()) {}
Ranks::~Ranks() = default;
std::size_t Ranks::rank() const {
  return static_cast<std::size_t>(job_->rank);
}
std::size_t Ranks::size() const {
  return static_cast<std::size_t>(job_->size);
}

std::uint64_t Ranks::add(Counter counter, std::uint64_t n) {
  const std::scoped_lock lock(job_->guard);
  const auto i = static_cast<std::size_t>(counter);
#ifdef DRIFT_WITH_MPI
  if (job_->started) {
    std::uint64_t before = 0;
    MPI_Fetch_and_op(&n, &before, MPI_UINT64_T, 0, static_cast<MPI_Aint>(i), MPI_SUM, job_->window);
    MPI_Win_flush(0, job_->window);
    return before;
  }
#endif
  const std::uint64_t before = job_->own[i];
  job_->own[i] += n;
  return before;
}

void Ranks::broadcast([[maybe_unused]] std::vector<std::uint64_t>& values) {
#ifdef DRIFT_WITH_MPI
  if (!job_->started) return;
  std::uint64_t n = values.size();
  MPI_Bcast(&n, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  values.resize(n);
  constexpr std::uint64_t most = 1u << 20;  // MPI counts in int
  for (std::uint64_t at = 0; at < n; at += most)
    MPI_Bcast(values.data() + at, static_cast<int>(std::min(most, n - at)), MPI_UINT64_T, 0,
              MPI_COMM_WORLD);
#endif
}

int Ranks::largest(int value) {
#ifdef DRIFT_WITH_MPI
  if (job_->started) MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
#endif
  return value;
}

}  // namespace drift::mc
