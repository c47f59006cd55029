#pragma once

#include <optional>

#include "analysis/forms/bins.hpp"
#include "analysis/forms/grammar.hpp"

namespace drift::forms {

/// A form and what the linearised test says of it.
struct ScreenedForm {
  Form form;
  double T = 0.0;
  int dof = 0;
  VecX amplitude;  ///< SI, a number per column of the form
  /// Log of the chance that noise gives a form as much, the number of forms paid for: its tail over
  /// its prior (a weighted Bonferroni bound, which holds because the priors sum to 1 at most).
  double log_p = 0.0;
};

/// The forms of a grammar against a misfit.
struct Screening {
  std::vector<ScreenedForm> best;  ///< of every place and pair of kinds one; least log_p first
  std::size_t forms = 0;           ///< that were tried
};

/// Which forms are scored: all; of the attitude alone, which the time of a test does not multiply,
/// so that coarser bins do, its settings left at the points of their grids (a hundredth of the
/// time).
enum class Reach { whole, attitude };

/// Scores every form of the grammar by what the parameters cannot absorb, as candidates of the
/// library are: each is a linear map from an input in bins of time, so a form costs an inner
/// product. Within the dwell of a position an attitude part counts as constant, unless it stands
/// alone. The settings of the best are moved between the points of their grids. `keep`: how many.
Screening screen_forms(const inference::LinearProblem& problem, const Timeline& timeline,
                       const inference::Projector& projector, std::size_t keep,
                       Reach reach = Reach::whole);

/// What a form that was screened does to the rows at the amplitudes that were found.
VecX trace_of(const ScreenedForm& screened, const inference::MeasuredRows& rows,
              const Timeline& timeline, Reach reach);

}  // namespace drift::forms
