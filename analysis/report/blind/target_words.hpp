#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/blind/summary.hpp"
#include "core/base/weighed_texts.hpp"

namespace drift::report {

/// What a target is set for, as blind.md has it: "8 sigma and more: one name, the right one".
std::string_view in_full(blind::Goal goal);
/// The same where all of them stand in a few lines: "one right name".
std::string_view in_brief(blind::Goal goal);
/// Its "name" in blind.json, by which others find it: it stays when words change.
std::string_view name_for_machines(blind::Goal goal);

/// "at least 0.80", "0.91 to 0.99".
std::string wanted(const blind::Target& target);

/// How many targets stand how, in the words of their table, and of how many trials: "1 of 10
/// targets missed, 6 not decided: 20 trials.".
std::string standings_text(const blind::Summary& summary);

/// All of them, by how they stand: "Missed: one right name 4 of 8 (at least 0.75).", the missed
/// first.
WeighedTexts targets_in_brief(const std::vector<blind::Target>& targets);

}  // namespace drift::report
