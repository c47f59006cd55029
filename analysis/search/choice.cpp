#include "analysis/search/choice.hpp"

#include <algorithm>

namespace drift::search {

std::vector<int> columns_of(const inference::CandidateSet& set,
                            const std::vector<Choice>& choices) {
  std::vector<int> all;
  for (const Choice& choice : choices) {
    const auto& own = set.candidates[choice.candidate].variants[choice.variant].columns;
    all.insert(all.end(), own.begin(), own.end());
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

bool is_part_of(const inference::Candidate& c, const inference::CandidateSet& set,
                const std::vector<Choice>& choices) {
  return std::ranges::any_of(choices, [&](const Choice& choice) {
    const inference::Candidate& chosen = set.candidates[choice.candidate];
    return chosen.term == c.term && (chosen.params == c.params || chosen.contains(c));
  });
}

}  // namespace drift::search
