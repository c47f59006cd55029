#include "analysis/search/greedy.hpp"

namespace drift::search {

std::vector<Choice> greedy(const Field& field, const std::vector<Score>& scores,
                           double library_threshold, double scan_threshold, std::size_t most) {
  std::vector<Choice> in;
  std::size_t next = 0;
  for (std::size_t k = 1; k < scores.size(); ++k)
    if (scores[k].strength > scores[next].strength) next = k;
  const auto quiet = [&](const Remainder& r) {
    return r.library <= library_threshold && r.scan <= scan_threshold;
  };
  Remainder r;
  do {
    in.push_back({next, scores[next].variant});
    r = remainder(field, in);
    next = r.strongest;
  } while (!quiet(r) && in.size() < most && r.library > library_threshold);
  if (!quiet(r)) return {};
  for (std::size_t k = 0; k < in.size() && in.size() > 1;) {
    std::vector<Choice> fewer = in;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
    if (quiet(remainder(field, fewer))) {
      in = fewer;
      k = 0;
    } else {
      ++k;
    }
  }
  return in;
}

}  // namespace drift::search
