#pragma once

#include "analysis/forms/bins.hpp"

namespace drift::forms {

/// A form that begins, or begins and ends, at times of the test, which are moved from the edges of
/// the bins that it was screened on to those of rows, no further than a bin, where its score is
/// largest; other forms as they are. What is left of a large effect where an edge is a minute off
/// would call for a second one.
Form with_edges_moved(Form form, const Instants& at, const Bins& bins,
                      const inference::MeasuredRows& rows, const Timeline& timeline,
                      const inference::Projector& projector);

}  // namespace drift::forms
