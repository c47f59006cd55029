#include "analysis/search/scores/choice.hpp"

#include <algorithm>

namespace drift::search {

bool same(const Explanation& a, const Explanation& b) {
  return a.size() == b.size() && std::ranges::all_of(a, [&](const Choice& x) {
           return std::ranges::any_of(b, [&](const Choice& y) {
             return x.candidate == y.candidate && x.variant == y.variant;
           });
         });
}

bool same_causes(const Explanation& a, const Explanation& b) {
  return std::ranges::is_permutation(a, b, {}, &Choice::candidate, &Choice::candidate);
}

std::vector<int> columns_of(const inference::CandidateSet& set,
                            const std::vector<Choice>& choices) {
  std::vector<int> columns;
  for (const Choice& choice : choices) {
    const auto& more = set.candidates[choice.candidate].variants[choice.variant].columns;
    columns.insert(columns.end(), more.begin(), more.end());
  }
  return columns;
}

std::vector<int> distinct_columns_of(const inference::CandidateSet& set,
                                     const std::vector<Choice>& choices) {
  std::vector<int> columns = columns_of(set, choices);
  std::ranges::sort(columns);
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  return columns;
}

bool of_a_chosen_family(const inference::CandidateSet& set, const std::vector<Choice>& choices,
                        const inference::Candidate& candidate) {
  return std::ranges::any_of(choices, [&](const Choice& choice) {
    const inference::Candidate& chosen = set.candidates[choice.candidate];
    return chosen.term == candidate.term &&
           (chosen.params == candidate.params || chosen.contains(candidate));
  });
}

}  // namespace drift::search
