#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace drift::config {

/// Cost of turning what was typed into what was meant: Damerau-Levenshtein (optimal string
/// alignment) with the costs of real slips of a keyboard. Insertion, deletion, substitution and
/// swap of neighbours cost 1; the wrong case 0.25, a doubled letter 0.8, a neighbouring key 0.9.
double typing_distance(std::string_view typed, std::string_view meant);

/// The keys closest to what was typed, best first, at most three; more than one only if they are
/// equally close. Empty if none is close enough to be what was meant.
std::vector<std::string_view> nearest(std::string_view typed,
                                      std::span<const std::string_view> keys);

/// Whether what was typed is that name with a slip of the keyboard, where it may be another name as
/// well: one slip, or two in words of six letters. What a further word ("x_raw", "oil_x"), a number
/// ("x2", "x_2") or, in a name of two letters, one of them tells apart is another name.
bool is_slip(std::string_view typed, std::string_view meant);

/// "Did you mean 'x'?" for messages, or `otherwise` if nothing is close.
std::string suggestion(std::string_view typed, std::span<const std::string_view> keys,
                       std::string_view otherwise = "Use one of these");

}  // namespace drift::config
