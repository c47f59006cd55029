#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/blind/answer.hpp"
#include "analysis/blind/score.hpp"
#include "analysis/blind/session/trial_folder.hpp"
#include "mc/engine/work_session.hpp"

namespace drift::blind {

/// Diagnoses one trial from the paths of its nominal study and its recording: all that it is given.
using Solver =
    std::function<Answer(const std::string& study_path, const std::string& recording_path)>;

/// Diagnoses the trials of a worker's part that have no answer yet, in parallel. An exception of
/// the solver is that trial's answer, unless the disk or memory is to blame (that ends the call, to
/// be resumed); a trial during which the program crashed twice is given up. Ending the program from
/// outside, by whatever signal and however often, changes no answer.
///
/// Writes trials/NNNN/answer.json each. When all are there, whoever wrote them, writes answers.json
/// and answers.sha256 and returns the hash: it depends on the study alone. Returns nothing while
/// answers are missing.
std::optional<std::string> answer_trials(const std::string& folder, const Solver& solver,
                                         const mc::WorkSession& session = {},
                                         const Progress& progress = {});

/// The numbers of the trials of a worker's part that have no answer yet.
std::vector<std::size_t> unanswered(const std::string& folder, const mc::WorkerShare& share);

/// Opens the key and scores. InputError (self_check) if no hash of key or answers was published, or
/// one of them was changed since.
std::vector<TrialScore> score_folder(const std::string& folder);

}  // namespace drift::blind
