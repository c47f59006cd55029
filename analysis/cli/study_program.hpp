#pragma once

#include <functional>
#include <string>

#include "mc/store/study_reader.hpp"
#include "mc/study/study.hpp"
#include "mc/study/sweep.hpp"
#include "mc/task/run_task.hpp"

namespace drift::cli {

/// What the commands that execute or read a study do not know themselves.
struct StudyProgram {
  /// The points of a study and when each has enough runs. InputError (config) if it has nothing to
  /// run.
  std::function<mc::StudyWork(const mc::Study&)> work;
  /// Prints the results of a complete study and writes what belongs into its folder.
  std::function<void(const mc::Study&, const mc::StudyWork&, mc::StudyReader&,
                     const std::string& folder)>
      present;
  /// The study points whose rows are StudyColumns, for statistics of them; may be empty.
  std::function<std::vector<mc::StudyPoint>(const mc::Study&)> points = {};
};

/// The one of this program.
StudyProgram study_program();

}  // namespace drift::cli
