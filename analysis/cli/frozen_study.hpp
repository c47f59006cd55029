#pragma once

#include <string>

#include "mc/store/manifest.hpp"
#include "mc/store/study_reader.hpp"
#include "mc/study/study.hpp"

namespace drift::cli {

/// What the bits of a study's runs depend on: its text in one order of keys, without the number of
/// runs and of failures that are allowed.
mc::StudyIdentity identity_of(const mc::Study& study);

/// The study of a results folder, with the number of runs that was asked for last. InputError
/// (store) if study.toml is not the one that the folder was made with.
mc::Study frozen_study(const std::string& folder, const mc::StudyReader& reader);

}  // namespace drift::cli
