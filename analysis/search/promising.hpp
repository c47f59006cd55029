#pragma once

#include "analysis/search/search.hpp"

namespace drift::search {

/// Explanations that are worth a refit, by the linearised test.

/// A candidate at its strongest setting, and at another far from it that explains the test nearly
/// as well: which of two onsets it was, the refit decides.
std::vector<Choice> ways_of(const Fitted& e, std::size_t candidate);

/// Single candidates: at most `most` adequate ones, best first, and where the linearised test
/// cannot judge those that it must not miss.
std::vector<std::size_t> promising_singles(const Search& s, std::size_t most);

/// Where a part of a term will not do, more of the term: what the linearised test finds adequate
/// and what the refit asks for.
std::vector<std::size_t> more_than(const Search& s, const Refit& part);

/// What is to be tried before a size that nobody expects is believed: candidates of sizes that
/// their priors make credible which explain as much, give or take what linearisation may be wrong
/// by. Best first.
std::vector<std::size_t> as_good_with_credible_sizes(const Search& s);

/// Two causes at once, by the linearised test.
std::vector<Explanation> promising_pairs(const Search& s, std::size_t most);

/// Of these the ones of two terms that by the linearised test have a twentieth of the weight of a
/// single cause or more (SearchLimits::credible): with less none would be listed beside it.
std::vector<Explanation> pairs_against(const Search& s, const Refit& single, std::size_t most);

/// More than two, one by one.
std::vector<Explanation> promising_several(const Search& s);

/// Explanations in which a part of one member's term stands for all of it. Where everything is far
/// off a whole term scores best whatever part of it is missing; which of it the recording shows is
/// told by evidence only once the others are in the model.
std::vector<Explanation> with_parts(const Search& s, const Explanation& in);

}  // namespace drift::search
