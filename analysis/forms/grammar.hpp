#pragma once

#include "analysis/forms/form.hpp"

namespace drift::forms {

/// The parts that forms are made of, with the prior of each: every kind is as likely as another,
/// and shares that among its members. A form is one place, one attitude part and one time part,
/// independent of each other; so the priors of all forms sum to 1 at most.
struct Grammar {
  std::vector<OwnTarget> places;
  std::vector<AttitudePart> where;  ///< "one" first
  std::vector<TimePart> when;       ///< "one" first; windows are counted, not listed
  std::size_t windows = 0;

  double log_prior(AttitudePart::Kind where, TimePart::Kind when) const;
};

/// All that a test allows. Grids are those of the test: periods from its length down to four bins,
/// half a cycle apart over it; time constants and widths by halves; thresholds between the specific
/// forces that the positions have; onsets at the bins. A drift and the rate of the platform about
/// the same axis leave one trace: drift stands for both.
Grammar grammar_of(const Instants& at, const std::vector<double>& bin_starts, double bin_length,
                   bool accelerometers, bool gimbals);

}  // namespace drift::forms
