#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mc/provenance.hpp"
#include "mc/run_task.hpp"

namespace drift::mc {

/// What the bits of every run depend on, besides the program. The number of runs is no part of it, so
/// that a study can be extended: more runs continue the same streams.
struct StudyIdentity {
  std::string text;           ///< the canonical study file, the number of runs taken out
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

/// manifest.json: what study a results folder holds. Written once, never changed.
struct Manifest {
  static constexpr int format = 1;

  StudyIdentity identity;
  std::string hash;             ///< of the identity
  std::string study;            ///< study.toml as given, with overrides
  std::string program;          ///< "driftscope 0.1.0"
  std::string instruction_set;  ///< compiled for
  std::string arithmetic;       ///< arithmetic_fingerprint()
  std::vector<PointInfo> points;
  Facts provenance;             ///< of the session that made the folder
};

/// The manifest that a study begun by this program here and now has.
Manifest make_manifest(StudyIdentity identity, std::string study, std::span<const TaskPoint> points);

/// Makes the folder, its study.toml and manifest.json, or checks that those in it are of the same
/// study, program version, columns and arithmetic. InputError (store) shows what differs; (io) if the
/// folder cannot be written to. Any number of workers may call it at the same time.
void claim_folder(const std::string& folder, const Manifest& manifest);

/// InputError (store) if the folder holds no study or its manifest is damaged.
Manifest read_manifest(const std::string& folder);

}  // namespace drift::mc
