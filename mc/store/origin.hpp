#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "mc/store/manifest.hpp"

namespace drift::mc {

/// A worker file whose results are not of the study, or not of the arithmetic, that is asked for.
/// Nothing in it is damaged, and nothing is removed.
class OtherOrigin : public InputError {
 public:
  OtherOrigin(const std::string& path, const std::vector<std::string>& differ);
};

/// What the table `study` of a worker file says: of which study its results are, by which program
/// and on what arithmetic they were computed. A seal over it tells results of another study from a
/// damaged table.
Facts origin_of(const Manifest& manifest);

/// The compiler of the program that made a manifest.
std::string compiler_of(const Manifest& manifest);

/// In what a sealed table differs from that of a study, a line each. Empty where it does not, and
/// of a table whose seal is broken or missing: that is damage, or of an earlier version.
std::vector<std::string> other_origin(const std::map<std::string, std::string>& is,
                                      const Manifest& wanted);

/// Whether a table is that of a study. The text of the study may be of another number of runs, and
/// what an earlier version did not write may be missing.
bool same_origin(const std::map<std::string, std::string>& is, const Manifest& wanted);

/// OtherOrigin if some worker file in a folder is not of the study.
void require_same_origin(const std::string& folder, const Manifest& wanted);

}  // namespace drift::mc
