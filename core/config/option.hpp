#pragma once

#include <limits>
#include <string_view>

#include "core/base/units.hpp"

namespace drift::config {

/// All that is to be known of one key of a section: what visit_options() of an options struct names
/// once, and readers, writers and help texts use.
struct Option {
  std::string_view key;
  Unit unit = unit::one;  ///< in which min and max are given and defaults are shown
  double min = -std::numeric_limits<double>::max();
  double max = std::numeric_limits<double>::max();
  std::string_view doc = {};
  bool difference = false;  ///< of temperatures: the zero of a scale does not matter
};

/// An options struct: visit_options(struct, field) calls field(Option, member) for each member.
template <class T>
concept Options = requires(T& options) {
  visit_options(options, [](const Option&, auto&) {});
};

}  // namespace drift::config
