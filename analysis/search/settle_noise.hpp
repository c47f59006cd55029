#pragma once

#include "analysis/search/examination.hpp"

namespace drift::search {

/// Candidates that can be observed, best evidence first.
std::vector<std::size_t> by_evidence(const Examination& e);

/// Where noise that drives the platform seemed necessary, an effect may have been taken for it. Two
/// things speak against noise, and then it is estimated again without what was no noise:
/// - an input in one equation alone does better than such noise would let it (noise_doubt.hpp):
/// what is
///   noise, all three instruments have;
/// - a candidate in the mean does, or it is significant by the likelihood ratio with the noise at
/// its best
///   in both. All candidates are asked under several noises, the best `tries` of them with the
///   noise estimated anew.
/// threshold: strength that makes a candidate significant. rounds: candidates that may be in the
/// mean together. True if the noise was replaced.
bool settle_noise(Examination& e, const inference::Test& test, double threshold,
                  std::size_t tries = 4, int rounds = 3);

}  // namespace drift::search
