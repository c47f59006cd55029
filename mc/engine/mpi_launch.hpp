#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace drift::mc {

/// The processes that mpirun started for one study; a single one without mpirun. They share some
/// counters and nothing else: results go to each one's own file. Calls are serialised inside.
class Ranks {
 public:
  /// Joins the others if the process was started by mpirun or srun. InputError (usage) if the
  /// program was built without MPI.
  Ranks();
  /// Leaves them. After an exception it does not wait for them: mpirun then ends the others.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  std::size_t rank() const;
  std::size_t size() const;
  bool leader() const { return rank() == 0; }

  enum class Counter { block, done, failed, stop, executed, executed_failed, kept, taken_over };
  static constexpr std::size_t counters = 8;
  /// Adds to a counter that all share; what it was before.
  std::uint64_t add(Counter counter, std::uint64_t n);

  // All ranks must make these calls, in the same order.
  void broadcast(std::vector<std::uint64_t>& values);  ///< those of the leader
  int largest(int value);

 private:
  struct Job;
  std::unique_ptr<Job> job_;
};

}  // namespace drift::mc
