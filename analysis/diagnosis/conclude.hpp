#pragma once

#include "analysis/diagnosis/diagnosis.hpp"
#include "analysis/search/search.hpp"

namespace drift::diagnosis {

/// The table of candidates after the refits: frame_closure scored by the jump to the other
/// equation, which its linear score at the nominal fit need not see, and the probabilities of the
/// refits in place of those of the linear scores.
void weigh_candidates(const search::Examination& nominal, const search::Search& found,
                      Diagnosis& d);

/// For `unexplained`: how far the best explanation goes that was not good enough.
void say_partial(const search::Examination& nominal, const search::Search& found, Diagnosis& d);

/// Nominal parameters that the recording moves more than five sigmas of their prior: the fit is
/// good, what it says is not to be believed (isotropic D_I, for one, is Earth rate about Up). Where
/// a cause is named it is what has moved them.
void say_beyond_prior(const BatchResult& nominal, Diagnosis& d);

/// Whether the drift equation is (5) or (6) is part of the nominal model: where the test does not
/// tell, its agreement says nothing of it (physics.md 1.7), and the verdict says so.
void say_equation(Diagnosis& d);

/// Where noise that drives the platform leaves nothing significant: what would be, were it no
/// noise.
void say_noise_or_effect(const search::Examination& nominal, Diagnosis& d);

}  // namespace drift::diagnosis
