#pragma once

#include <mutex>
#include <set>
#include <string>

#include "analysis/planning/improve.hpp"
#include "mc/engine/work_session.hpp"
#include "mc/store/store.hpp"
#include "mc/store/study_reader.hpp"
#include "mc/store/study_state.hpp"

namespace drift::planning {

/// What an improvement of a plan that several processes share depends on, in the store of `run`:
/// every step is a study point, every candidate a run of it, in a block of its own.
mc::Manifest steps_manifest(mc::StudyIdentity study, const std::string& text, std::size_t steps,
                            const std::string& criterion);

/// The folder within that of the results: its manifest and worker files.
std::string steps_folder(const std::string& results);

/// How far they are: its points are the steps, `finished` is set once all is judged and the results
/// are written. InputError (store) if the folder has none.
mc::StudyState steps_state(const std::string& results);

/// Judges the candidates of `rank --improve` together with other processes. A worker judges its own
/// part of a step, then what the others have not judged yet: the next step needs all of them, and
/// nobody waits. What is judged twice is the same, and compared.
class SharedSteps {
 public:
  /// `folder`: one that claim_folder() accepted. InputError (store) if another process is this
  /// worker.
  SharedSteps(const std::string& folder, const mc::Manifest& manifest,
              const mc::WorkSession& session);

  /// All of a step, or nothing if the time was over before. InputError: io if the disk is full,
  /// self_check if two workers came to different results.
  std::optional<Merits> judge(std::size_t step, std::size_t candidates, const Judge& judge);
  /// Notes how the session ended; `ok`: with everything judged and the results written.
  void end(ExitCode code);
  /// Candidates that this process judged.
  std::size_t judged() const { return judged_; }

 private:
  /// Takes in what is stored of a step, by whomever.
  void look(std::size_t step);
  void work_at(const std::vector<std::size_t>& jobs, std::size_t step, const Judge& judge);
  bool is_known(std::size_t k);

  std::string folder_;
  mc::WorkSession session_;
  mc::WorkerStore store_;
  mc::StudyReader reader_;
  bool begun_ = false;
  std::mutex guard_;
  Merits merits_;
  std::set<std::size_t> known_;  ///< of the step at work
  std::size_t candidates_ = 0, judged_ = 0;
};

}  // namespace drift::planning
