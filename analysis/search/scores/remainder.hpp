#pragma once

#include <vector>

#include "analysis/search/scores/field.hpp"

namespace drift::search {

/// What is left when some causes are in the model, their amplitudes free.
struct Remainder {
  double library = 0.0;       ///< largest strength among the other candidates
  double scan = 0.0;          ///< largest strength among the windows
  std::size_t strongest = 0;  ///< the candidate that has `library`
};

/// Conditional scores T_(c|d). The neighbouring variant on the grid goes in with
/// a cause, so that a time constant between two of them is allowed for. Members of a chosen
/// candidate's own family do not count as others.
Remainder remainder(const Field& field, const std::vector<Choice>& choices);

/// Whether many sets of causes leave anything beyond thresholds of strength. Whoever spoke against
/// a set is asked first about the next: one objection is enough, and what one cause cannot explain
/// few can.
class QuietTest {
 public:
  /// The field must outlive it.
  QuietTest(const Field& field, double library_threshold, double scan_threshold);
  bool quiet_beside(const std::vector<Choice>& choices);

 private:
  struct Asked {
    enum class What { candidate, windows } what;
    std::size_t number;  ///< of the candidate, or of the position
  };
  const Field& field_;
  double library_threshold_, scan_threshold_;
  std::vector<Asked> asked_;  ///< in this order; those that are dear last, at first
};

}  // namespace drift::search
