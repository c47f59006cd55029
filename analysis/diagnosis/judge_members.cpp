#include "analysis/diagnosis/judge_members.hpp"

#include "analysis/diagnosis/held_out.hpp"

namespace drift::discovery {

std::vector<double> judge_members(const Examination& nominal, const Test& test, const Refit& best,
                                  const Nulls& nulls) {
  std::vector<double> gains;
  if (best.choices.size() < 2) return gains;
  for (std::size_t k = 0; k < best.choices.size(); ++k) {
    std::vector<Choice> others = best.choices;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    gains.push_back(held_out_gain(refit(nominal, test, others, nulls).after, best.after));
  }
  return gains;
}

}  // namespace drift::discovery
