#pragma once

#include <optional>

#include "core/physics/own/own_term.hpp"

namespace drift {

/// The own terms that the library holds. The library is the process's: one set at a time.
const OwnTermSet& own_terms();

/// Puts a study's own terms into the library, in place of those of the study read before; an equal
/// set changes nothing. Not while other threads use the library: studies are read before any
/// thread starts. Needs at most most_own_terms, with at most most_own_parameters each.
void set_own_terms(OwnTermSet set);

/// Brings the terms back that were there before, for whoever reads a study only to look at it.
class KeptOwnTerms {
 public:
  KeptOwnTerms() : before_(own_terms()) {}
  // NOLINTNEXTLINE(bugprone-exception-escape): of terms that were checked when they were set
  ~KeptOwnTerms() {
    if (before_) set_own_terms(std::move(*before_));
  }
  KeptOwnTerms(const KeptOwnTerms&) = delete;
  KeptOwnTerms& operator=(const KeptOwnTerms&) = delete;

  /// Leaves those that are there now.
  void forget() { before_.reset(); }

 private:
  std::optional<OwnTermSet> before_;
};

}  // namespace drift
