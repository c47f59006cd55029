#include "core/plan/mixup.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace drift {
std::pair<int, long> plainness(const Mixup& m) {
  return {m.changes(), std::ranges::count_if(m.sign, [](double s) { return s < 0.0; })};
}

int Mixup::changes() const {
  int n = 0;
  for (int i = 0; i < 3; ++i) n += from[i] != i || sign[i] < 0.0;
  return n;
}

std::vector<Mixup> every_mixup() {
  std::vector<Mixup> all;
  Mixup m;
  do {
    for (int signs = 0; signs < 8; ++signs) {
      for (int i = 0; i < 3; ++i) m.sign[i] = (signs >> i & 1) != 0 ? -1.0 : 1.0;
      all.push_back(m);
    }
  } while (std::next_permutation(m.from.begin(), m.from.end()));
  return all;
}

std::optional<Mixup> the_one_mixup(const std::function<bool(const Mixup&)>& explains) {
  std::optional<Mixup> found;
  bool several = false;
  for (const Mixup& m : every_mixup()) {
    if (m.changes() == 0 || (found && plainness(m) > plainness(*found)) || !explains(m)) continue;
    several = found && plainness(m) == plainness(*found);
    found = m;
  }
  return several ? std::nullopt : found;
}

std::string mixup_text(const Mixup& m, const ChannelTriple& channels, const std::string& all) {
  std::vector<std::string> wrong, map;
  for (int i = 0; i < 3; ++i)
    if (m.from[i] != i || m.sign[i] < 0.0) {
      wrong.emplace_back(channels.names[i]);
      map.push_back(fmt::format("{} = \"{}{}\"", channels.names[i], m.sign[i] < 0.0 ? "-" : "",
                                channels.names[m.from[i]]));
    }
  return fmt::format(
      "column{} {}: {} ({} with {}). Correct the recording, or say so in the study: [recording] "
      "columns = {{ {} }}, each with its unit as in the header",
      wrong.size() > 1 ? "s" : "", fmt::join(wrong, ", "),
      wrong.size() == 1 ? "the sign is wrong" : "exchanged or of the wrong sign", all,
      fmt::join(map, ", "), fmt::join(map, ", "));
}

}  // namespace drift
