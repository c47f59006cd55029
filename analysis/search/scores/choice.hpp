#pragma once

#include <vector>

#include "analysis/inference/candidate.hpp"

namespace drift::search {

/// A cause as it is put into the model: a candidate at one variant.
struct Choice {
  std::size_t candidate = 0, variant = 0;
};

/// Simultaneous causes.
using Explanation = std::vector<Choice>;

bool same(const Explanation& a, const Explanation& b);
/// Whether they are of the same candidates, at whatever variants.
bool same_causes(const Explanation& a, const Explanation& b);

/// The columns of causes, one after the other; a parameter of two of them twice.
std::vector<int> columns_of(const inference::CandidateSet& set, const std::vector<Choice>& choices);
/// The same, each once and in order.
std::vector<int> distinct_columns_of(const inference::CandidateSet& set,
                                     const std::vector<Choice>& choices);

/// Whether a candidate is of the family of one of the causes: same term, parameters among its own.
bool of_a_chosen_family(const inference::CandidateSet& set, const std::vector<Choice>& choices,
                        const inference::Candidate& candidate);

}  // namespace drift::search
