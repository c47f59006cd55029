#include "analysis/diagnosis/judge_members.hpp"

#include "analysis/diagnosis/held_out.hpp"

namespace drift::diagnosis {

std::vector<double> judge_members(const search::Examination& nominal, const inference::Test& test,
                                  const search::Refit& best, const search::Nulls& nulls) {
  std::vector<double> gains;
  if (best.choices.size() < 2) return gains;
  for (std::size_t k = 0; k < best.choices.size(); ++k) {
    std::vector<search::Choice> others = best.choices;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    gains.push_back(held_out_gain(search::refit(nominal, test, others, nulls).after, best.after));
  }
  return gains;
}

}  // namespace drift::diagnosis
