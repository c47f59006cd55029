#pragma once

#include <functional>
#include <string>
#include <vector>

#include "analysis/blind/answer.hpp"
#include "analysis/blind/score.hpp"
#include "mc/study/study.hpp"

namespace drift::blind {

/// Diagnoses one trial from the paths of its nominal study and its recording: all that it is given.
using Solver =
    std::function<Answer(const std::string& study_path, const std::string& recording_path)>;

/// Called as trials are completed, from any thread: done, total.
using Progress = std::function<void(std::size_t, std::size_t)>;

/// Makes the trials of a study in a folder:
///
///   study.toml                 the blind study itself
///   trials/NNNN/study.toml     what the solver gets: no truth
///   trials/NNNN/recording.csv
///   key.json, key.sha256       what was hidden, and the hash that is published before anything is
///   diagnosed
///
/// A folder that holds the same study, sealed, is left as it is. Returns the hash of the key.
/// InputError (store) if the folder belongs to another study; (self_check) if its key was changed;
/// (config) if the study has no [blind], [truth], [[filter]] or preset.
std::string make_trials(const mc::Study& study, const std::string& folder, int threads,
                        const Progress& progress = {});

/// Diagnoses the trials that have no answer yet, in parallel. An exception of the solver is that
/// trial's answer, unless the disk or memory is to blame (that ends the call, to be resumed); a
/// trial during which the program crashed twice is given up. Ending the program from outside, by
/// whatever signal and however often, changes no answer. Writes
/// trials/NNNN/answer.json each, then answers.json and answers.sha256; returns the hash of the
/// latter.
std::string answer_trials(const std::string& folder, const Solver& solver, int threads,
                          const Progress& progress = {});

/// Opens the key and scores. InputError (self_check) if no hash of key or answers was published, or
/// one of them was changed since.
std::vector<TrialScore> score_folder(const std::string& folder);

}  // namespace drift::blind
