#pragma once

#include "analysis/discovery/examination.hpp"

namespace drift::discovery {

/// Candidates that can be observed, best evidence first.
std::vector<std::size_t> by_evidence(const Examination& e);

/// Where noise that drives the platform seemed necessary, an effect may have been taken for it: the
/// noise is estimated again with the best candidates in the mean, one after the other, and that noise is
/// kept if the likelihood ratio (noise at its best with and without the candidate) is significant.
/// threshold: strength. tries: candidates looked at in each round, under each of two views of the noise.
/// True if the noise was replaced.
bool settle_noise(Examination& e, const Test& test, double threshold, std::size_t tries = 4, int rounds = 3);

}  // namespace drift::discovery
