#pragma once

#include "mc/store/manifest.hpp"
#include "mc/study/study.hpp"

namespace drift::mc {

/// What the bits of a study's runs depend on: its text in one order of keys, without the number of
/// runs and of failures that are allowed. InputError (config) if `text` of the study is none.
StudyIdentity identity_of(const Study& study);

}  // namespace drift::mc
