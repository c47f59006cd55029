#pragma once

#include <vector>

#include "core/physics/model_spec.hpp"
#include "core/plan/timeline.hpp"

namespace drift {

/// Where a study's own term is no finite number on a test: a pole, the root of something negative.
struct OwnTermGap {
  std::size_t own = 0;  ///< which of own_terms()
  double t = 0.0;       ///< since the start of the test [s]
  int position = 0;     ///< from 0
  bool slew = false;    ///< on the way to it
};

/// Follows each own term of a model along the nominal path of a planned test, its amplitudes one
/// prior sigma from their means: at every node, and between them with all that it reads linear, so
/// that a pole is found wherever it lies. The first place of each term that has one. A term that
/// reads what the timeline does not carry is left out.
std::vector<OwnTermGap> own_term_gaps(const Timeline& timeline, const ModelSpec& model);

}  // namespace drift
