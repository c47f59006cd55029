#include "core/recording/rows/held_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/words.hpp"

namespace drift {
namespace {

constexpr std::size_t most_told = 24;

}  // namespace

std::string held_order_advice(const std::vector<double>& position) {
  std::vector<double> held;
  for (const double p : position)
    if (p >= 1.0 && (held.empty() || p != held.back())) held.push_back(p);
  if (std::set<double>(held.begin(), held.end()).size() < held.size())
    return "Number them 1, 2, 3 and so on as they were held, anew each time, and put "
           "[[plan.position]] of the study file into that order";
  std::vector<std::string> numbers;
  for (const double p : held) numbers.push_back(fmt::format("{}", p));
  return fmt::format(
      "Put [[plan.position]] of the study file into the order in which they were held, {}, and "
      "number them in it, 1, 2, 3 and so on, in the file or by positions = {{ \"NAME IN THE FILE\" "
      "= 1, ... }} of [recording]. `driftscope new diagnose` with this file writes both, as its "
      "gimbals show",
      listed_up_to(numbers, most_told));
}

}  // namespace drift
