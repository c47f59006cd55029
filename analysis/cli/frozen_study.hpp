#pragma once

#include <string>

#include "analysis/cli/study_program.hpp"
#include "mc/store/manifest.hpp"
#include "mc/store/study_reader.hpp"
#include "mc/study/study.hpp"

namespace drift::cli {

/// The study of a results folder, with the number of runs that was asked for last, and its work.
struct FrozenStudy {
  mc::Study study;
  mc::StudyWork work;
};

/// InputError (store) if study.toml is not the one that the folder was made with, or manifest.json
/// does not describe its columns.
FrozenStudy frozen_study(const std::string& folder, const mc::StudyReader& reader,
                         const StudyProgram& program);

/// Whether study.toml of a folder is that of the study, or not there. InputError (io) if it cannot
/// be read.
bool study_file_is_whole(const std::string& folder, const mc::Manifest& manifest);

/// Puts back a study.toml that is damaged or changed in a folder that was just claimed with this
/// manifest; the name under which what was there is kept, empty if all is well.
std::string mend_study(const std::string& folder, const mc::Manifest& manifest);

}  // namespace drift::cli
