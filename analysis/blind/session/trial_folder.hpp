#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "analysis/blind/answer.hpp"
#include "analysis/blind/source.hpp"
#include "core/base/results/folder.hpp"
#include "mc/study/study.hpp"

namespace drift::blind {

/// Called as trials are completed, from any thread: done, total.
using Progress = std::function<void(std::size_t, std::size_t)>;

/// The folder of a blind study:
///
///   study.toml                 the blind study itself
///   trials/manifest.json       the same, with what it is computed with, as that of `run`
///   trials/worker-0000.lock    keeps two processes from being the same worker
///   trials/NNNN/study.toml     what the solver gets: no truth
///   trials/NNNN/recording.csv
///   trials/NNNN/answer.json    what it said, and in time.json how long it took
///   making/NNNN.json           of the key, until it is sealed
///   key.json, key.sha256       what was hidden, and the hash that is published before anything is
///                              diagnosed
///   answers.json, answers.sha256
ResultsFolder results_in(const std::filesystem::path& folder);
/// Within the folder of the study, "trials/0003".
std::string trial_name(std::size_t number);

/// Whether the solver finds what it needs of a trial.
bool is_there(const std::filesystem::path& folder, std::size_t number);
bool is_answered(const std::filesystem::path& folder, std::size_t number);
/// What was said to it; nothing if nothing was. InputError (self_check) if that cannot be read.
std::optional<Answer> kept_answer(const std::filesystem::path& folder, std::size_t number);

/// Looks whether the folder can hold this study, and makes it if need be. Any number of workers may
/// do so at the same time. InputError (store) if it belongs to another study, or to a program whose
/// results may differ; (config) if the study cannot be made trials of.
void open_trials(const TrialSource& source, const std::string& folder);

/// The path of a worker's lock (mc/store/worker_lock.hpp), by the name of a file beside it.
std::string worker_of_trials(const std::string& folder, std::size_t worker);

/// How many trials its study asks for. InputError (store) if the folder holds no blind study.
std::size_t trials_asked(const std::string& folder);

/// How far a blind study is.
struct TrialsState {
  std::size_t trials = 0, made = 0, answered = 0, failed = 0;
  bool key_sealed = false;
  bool scored = false;  ///< and its results are written

  bool complete() const { return scored && answered == trials; }
};

/// InputError (store) if the folder holds no blind study.
TrialsState trials_state(const std::string& folder);

}  // namespace drift::blind
