#include "analysis/identification/stated_loop.hpp"

#include <algorithm>
#include <cmath>

#include "core/recording/recording_channels.hpp"

namespace drift::identification {

std::optional<StatedLoop> stated_loop(const std::vector<Recording>& recordings) {
  StatedLoop loop;
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    bool acts = false;
    for (const std::string_view name : loop_channels) {
      const Channel* c = recordings[k].find(name);
      loop.whole = loop.whole && c != nullptr;
      acts = acts || (c != nullptr && std::ranges::any_of(c->values, [](double removed) {
                        return std::isfinite(removed) && removed != 0.0;
                      }));
    }
    if (acts) loop.recordings.push_back(k + 1);
  }
  return loop.recordings.empty() ? std::nullopt : std::optional(std::move(loop));
}

}  // namespace drift::identification
