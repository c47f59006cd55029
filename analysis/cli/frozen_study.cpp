#include "analysis/cli/frozen_study.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/base/check.hpp"
#include "core/base/file_text.hpp"
#include "core/physics/own/own_terms.hpp"
#include "mc/store/same_study.hpp"
#include "mc/store/study_identity.hpp"

namespace drift::cli {
namespace {

/// A study file, or what is wrong with it.
struct Reading {
  std::optional<mc::Study> study;
  std::string wrong;
};

/// A worker that is stopped as it begins leaves the manifest alone, which has the study's text too.
Reading read_frozen(const std::string& folder, const mc::Manifest& manifest,
                    const mc::Overrides& asked) {
  const std::string path = folder + "/study.toml";
  std::error_code unknown;
  if (::faccessat(AT_FDCWD, path.c_str(), R_OK, AT_EACCESS) != 0 && errno != ENOENT)
    throw_cannot_read(path, std::strerror(errno));  // which says nothing of what it holds
  try {
    mc::Study study = std::filesystem::exists(path, unknown) || unknown
                          ? mc::read_study(path, asked, mc::IdleAxes::taken)
                          : mc::read_study_text(manifest.study, path, asked, mc::IdleAxes::taken);
    mc::StudyIdentity identity = mc::identity_of(study);
    identity.block_size = manifest.identity.block_size;
    if (identity.hash() == manifest.hash) return {std::move(study), {}};
    return {std::nullopt, "changed since"};
  } catch (const InputError& error) {
    return {std::nullopt, error.messages().front()};
  }
}

}  // namespace

FrozenStudy frozen_study(const std::string& folder, const mc::StudyReader& reader,
                         const StudyProgram& program) {
  const std::uint64_t runs = std::max<std::uint64_t>(reader.runs(), 1);
  const Reading found = read_frozen(folder, reader.manifest(),
                                    mc::Overrides{{"monte_carlo.runs", std::to_string(runs)}});
  if (!found.study)
    throw InputError(
        ExitCode::store,
        fmt::format("{}/study.toml: {} (expected the study that the folder was made with). Run the "
                    "same command again: it is written anew from manifest.json, and this one is "
                    "kept beside it",
                    folder, found.wrong));
  FrozenStudy frozen{*found.study, program.work(*found.study)};
  mc::require_columns(folder, reader.manifest(), frozen.work.points);
  return frozen;
}

bool study_file_is_whole(const std::string& folder, const mc::Manifest& manifest) {
  const KeptOwnTerms kept;  // those of the study that is executed, whatever the file says
  return read_frozen(folder, manifest, {}).study.has_value();
}

std::string mend_study(const std::string& folder, const mc::Manifest& manifest) {
  if (study_file_is_whole(folder, manifest)) return {};
  return mc::restore_study(folder, manifest.study);
}

}  // namespace drift::cli
