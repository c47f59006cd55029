#pragma once

#include <memory>

#include "analysis/inference/lone_input.hpp"
#include "analysis/inference/noise.hpp"
#include "analysis/search/adequacy.hpp"

namespace drift::search {

/// A model fitted to a test and everything that can be said about what it leaves.
struct Examination {
  FilterSpec filter;
  BatchResult fit;
  inference::CandidateSet set;
  inference::LinearProblem problem;
  inference::NoiseEstimate noise;
  std::unique_ptr<inference::Projector> projector;
  std::vector<inference::PositionScan> scans;
  std::unique_ptr<Field> field;
  std::vector<Score> scores;   ///< of every candidate
  inference::LoneEffect lone;  ///< beside everything that is in the model; where it was asked for

  double log_likelihood2() const { return projector->candidates().log_likelihood2(); }
};

/// Thresholds of a family of tests on one plan; they depend on the signatures, not on the data.
struct Nulls {
  inference::MaxNull library, scan;
  /// Strengths that are exceeded with probability alpha under the null, in each family.
  double library_threshold = 0.0, scan_threshold = 0.0;
};

/// How the chance of a false alarm is shared between the families.
inline constexpr double library_share = 0.5, scan_share = 0.15, pair_share = 0.15, lone_share = 0.2;

/// Fits (from `start`), linearises and lists candidates; noise is estimated unless `given` says it.
Examination examine(const FilterSpec& filter, const inference::Test& test, const Theta& start,
                    const inference::NoiseEstimate* given = nullptr);
/// The same about a fit that there is already. driven: noise that drives the platform may be found.
Examination examine(const FilterSpec& filter, const inference::Test& test, const BatchResult& fit,
                    const inference::NoiseEstimate* given = nullptr, bool driven = true);

/// Scores again under another noise.
void set_noise(Examination& e, const Timeline& timeline, const inference::NoiseEstimate& noise);

Nulls make_nulls(const Examination& e, double alpha, int draws);

/// What the filter says its noise is.
inference::NoiseModel declared_noise(const FilterSpec& filter);

}  // namespace drift::search
