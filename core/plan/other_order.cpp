#include "core/plan/other_order.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/words.hpp"

namespace drift {

std::optional<std::vector<std::size_t>> shown_positions(
    const std::vector<Sight>& sights, std::size_t positions,
    const std::function<double(const Sight&, std::size_t)>& mismatch) {
  std::vector<std::size_t> shown;
  for (const Sight& s : sights) {
    std::vector<std::size_t> fits;
    for (std::size_t p = 0; p < positions; ++p)
      if (mismatch(s, p) < largest_mismatch) fits.push_back(p);
    const auto own = static_cast<std::size_t>(s.position);
    if (std::ranges::find(fits, own) != fits.end()) fits = {own};
    if (fits.size() != 1 || std::ranges::find(shown, fits.front()) != shown.end())
      return std::nullopt;
    shown.push_back(fits.front());
  }
  return shown;
}

std::string other_order_advice(const std::optional<std::vector<std::size_t>>& shown,
                               bool complete) {
  constexpr std::size_t most = 24;
  if (!shown || !complete)
    return "Is this the plan the recording was made with, and are its positions in the order in "
           "which they were held?";
  std::vector<std::string> numbers;
  for (const std::size_t p : *shown) numbers.push_back(std::to_string(p + 1));
  const std::string held = listed_up_to(numbers, most);
  if (std::ranges::is_sorted(*shown))
    return fmt::format(
        "They show positions {} of the plan. Say in [recording] of the study file which is which: "
        "positions = {{ \"NUMBER IN THE FILE\" = NUMBER IN THE PLAN, ... }}",
        held);
  return fmt::format(
      "Put [[plan.position]] of the study file into the order in which they were held: {}. Those "
      "of a preset are written one by one then, as `driftscope new diagnose` with this file does",
      held);
}

}  // namespace drift
