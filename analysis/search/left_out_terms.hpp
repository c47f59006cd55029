#pragma once

#include "analysis/search/search.hpp"

namespace drift::search {

/// Terms that the nominal model leaves out unknowingly, one after the other, each fitted through
/// the full dynamics: whoever leaves out one usually leaves out several, and beside them the
/// linearised test says little. Nor is anything known of what drives the platform. One of a size
/// that nobody expects would stand for all of them. The last fit.
std::vector<Refit> refit_left_out_terms(const Search& s, const MeasuredTest& test);

}  // namespace drift::search
