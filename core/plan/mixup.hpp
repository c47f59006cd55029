#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/linalg.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift {

/// Three columns as they may have been exchanged or reversed.
struct Mixup {
  std::array<int, 3> from{0, 1, 2};
  std::array<double, 3> sign{1.0, 1.0, 1.0};

  Vec3 of(const Vec3& v) const {
    return {sign[0] * v[from[0]], sign[1] * v[from[1]], sign[2] * v[from[2]]};
  }
  int changes() const;
};

/// All 48, the one that changes nothing among them.
std::vector<Mixup> every_mixup();

/// By which one mixup is plainer than another: fewer changes, of these fewer reversed columns.
std::pair<int, long> plainness(const Mixup& mixup);

/// The one mixup with the fewest changes, of these the one with the fewest reversed columns, that
/// explains what is seen; none if several do, or nothing needs to be changed.
std::optional<Mixup> the_one_mixup(const std::function<bool(const Mixup&)>& explains);

/// Which columns are wrong, and the line of a study that puts them right. all: what then is as it
/// should be.
std::string mixup_text(const Mixup& mixup, const ChannelTriple& channels, const std::string& all);

}  // namespace drift
