#pragma once

#include <string>

#include "mc/store/study_state.hpp"

namespace drift::cli {

/// How far a study is, from all its results; says what of them is damaged. InputError (store) where
/// results are gone that were there, or damaged ones are missing: what is made of the rest would
/// say less than it seems to. `not_done`: "Nothing was exported".
mc::StudyState require_whole(const std::string& folder, mc::StudyReader& reader,
                             const mc::StopRules& rules, const std::string& not_done);

/// InputError (io) if some of so many results could not be listed or read a second time, for what
/// was `made` of them.
void require_read_again(const std::string& folder, const mc::StudyReader& reader,
                        const std::string& made, std::uint64_t results);

}  // namespace drift::cli
