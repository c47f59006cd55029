#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::cli {

/// site.gravity with its unit, where a study does not give it. Gravity is nobody's to guess: it
/// differs by 7000 ppm from place to place.
std::optional<std::string> assumed_gravity(const mc::Study& study);

/// Reads the recordings of a command line and tells what looks odd in them. Of large text files the
/// part that is read is reported in the style of --progress. InputError (recording).
std::vector<Recording> read_recordings(const mc::Study& study,
                                       const std::vector<std::string>& paths,
                                       const std::string& progress = "none");

/// The quality cards of recordings of a study.
std::string cards_text(const mc::Study& study, const std::vector<Recording>& recordings);

}  // namespace drift::cli
