#pragma once

#include <vector>

#include "analysis/inference/candidate.hpp"

namespace drift::search {

/// A cause as it is put into the model: a candidate at one variant.
struct Choice {
  std::size_t candidate = 0, variant = 0;
};

/// The columns of simultaneous causes, ascending, each once.
std::vector<int> columns_of(const inference::CandidateSet& set, const std::vector<Choice>& choices);

/// Whether a candidate is one of the choices or a part of one: the same term, parameters among its
/// own.
bool is_part_of(const inference::Candidate& c, const inference::CandidateSet& set,
                const std::vector<Choice>& choices);

}  // namespace drift::search
