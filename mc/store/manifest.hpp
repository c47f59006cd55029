#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mc/store/provenance.hpp"
#include "mc/task/run_task.hpp"

namespace drift::mc {

/// What the bits of every run depend on, besides the program. The number of runs is no part of it,
/// so that a study can be extended: more runs continue the same streams.
struct StudyIdentity {
  std::string text;  ///< the canonical study file, the number of runs taken out
  std::uint64_t seed = 1;
  std::size_t block_size = 64;

  /// SHA-256 over text, seed, block size, scheme of random numbers and format of the store.
  std::string hash() const;
};

/// A study point as readers of its results see it.
struct PointInfo {
  std::string label;
  std::vector<Column> columns;
};

/// manifest.json: what study a results folder holds. Made once; afterwards only `runs` and
/// `finished` change, so that results that were lost with their worker files are missed. A SHA-256
/// over the whole file guards every byte of it.
struct Manifest {
  static constexpr int format = 1;       ///< of the store as a whole; part of every study's hash
  static constexpr int file_format = 2;  ///< of manifest.json: 1 had no checksum, and is read too

  StudyIdentity identity;
  std::string hash;             ///< of the identity
  std::string study;            ///< study.toml as given, with overrides
  std::string program;          ///< "driftscope 0.1.0"
  std::string instruction_set;  ///< compiled for
  std::string arithmetic;       ///< arithmetic_fingerprint()
  std::vector<PointInfo> points;
  Facts provenance;        ///< of the session that made the folder
  std::uint64_t runs = 0;  ///< per study point, the most asked for; 0: not known (older folders)
  std::uint64_t finished = 0;  ///< per study point, the most that was complete; 0: none yet
  int read_as = file_format;   ///< the format it was read in
};

/// The manifest that a study begun by this program here and now has.
Manifest make_manifest(StudyIdentity identity, std::string study,
                       std::span<const TaskPoint> points);

/// Makes the folder, its study.toml and manifest.json, or checks that those in it are of the same
/// study, program version, columns and arithmetic. InputError (store) shows what differs; (io) if
/// the folder cannot be written to. More runs than before are noted in the manifest. Any number of
/// workers may call it at the same time.
void claim_folder(const std::string& folder, const Manifest& manifest);

/// Refuses what claim_folder() would, and writes nothing; a folder that is not there is nobody's.
/// Whether it holds a study, which is then the same.
bool require_claimable(const std::string& folder, const Manifest& manifest);

/// Notes in the manifest that `runs` runs of every study point are complete.
void note_finished(const std::string& folder, std::uint64_t runs);

/// InputError: store if the folder holds no study or its manifest is damaged; io if it cannot be
/// read.
Manifest read_manifest(const std::string& folder);

/// Writes study.toml of a folder anew. What is in its place is kept, as study.toml.damaged-1 or the
/// next free number: that name is returned. InputError (io).
std::string restore_study(const std::string& folder, const std::string& text);

}  // namespace drift::mc
