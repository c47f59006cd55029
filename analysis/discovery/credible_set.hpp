#pragma once

#include "analysis/discovery/search.hpp"

namespace drift::discovery {

/// Weighs explanations against each other by evidence and prior and keeps the adequate ones up to the
/// credible probability in out.sets, the others in out.rejected. Of several with one name the best stands
/// for all, and what says more is left out where less will do. None is kept if something unknown in one
/// equation explains the test far better than the best of them.
void weigh(const Examination& e, std::vector<Refit> refits, const SearchOptions& options, Search& out);

}  // namespace drift::discovery
