#include "analysis/cli/study_program.hpp"

#include "core/base/check.hpp"

namespace drift::cli {

StudyProgram study_program() {
  const auto work = [](const Study& study) -> mc::StudyWork {
    throw InputError(ExitCode::config, fmt::format("{}: this build has no Monte Carlo task", study.path));
  };
  return {work, [](const Study&, const mc::StudyWork&, mc::StudyReader&, const std::string&) {}};
}

}  // namespace drift::cli
