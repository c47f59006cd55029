#pragma once

#include <optional>

#include "analysis/search/fitted.hpp"

namespace drift::search {

/// Looks between the points of the library's grids: candidates whose log evidence is within `worth`
/// of the best one get further settings on either side of their best settings (three between each
/// two points), their signatures are computed and everything is scored again. A step at 3.5 h
/// leaves a trace that steps at 3 and 4 h together do not explain, and something else would be
/// called for beside it.
Fitted refine_grids(Fitted e, const MeasuredTest& test, double worth);

/// The same again and again, of settings that no slope leads a fit to (has_slope()): down to a row
/// of the test, or a thousandth of the grid where the setting is no time. What a fit cannot settle
/// must be settled before it, or something else is called for beside it.
Fitted settle_without_slope(Fitted e, const MeasuredTest& test, double worth);

/// The same between all points, of all candidates: a step between two points that are further apart
/// than the positions of a plan is at neither of them, and another setting scores best. Variants
/// are numbered anew by that.
Fitted refine_whole_grids(Fitted e, const MeasuredTest& test);

/// The one setting of a candidate that may lie between grid points, its place among the settings of
/// a variant; none if there is no such or several.
std::optional<std::size_t> continuous_setting(const inference::Candidate& c);

/// A candidate whose continuous setting a fit found, SI.
struct SettingFound {
  std::size_t candidate = 0;
  double value = 0.0;
};

/// The same to a sixteenth of the cells about what was found and the cells beside them, of these
/// candidates alone: where the plan turns an axis into and out of what an effect follows, an onset
/// has valleys of a few minutes. Variants are numbered anew by that.
Fitted refine_about(Fitted e, const MeasuredTest& test, const std::vector<SettingFound>& found);

/// The number of the variant with these settings, which there is.
std::size_t variant_at(const inference::Candidate& candidate, const inference::Settings& settings);

}  // namespace drift::search
