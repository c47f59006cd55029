#pragma once

#include <optional>
#include <span>

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "analysis/search/search.hpp"

namespace drift::diagnosis {

/// How far the best explanation goes that was not good enough; empty if it explains next to
/// nothing.
std::optional<NearestKnown> nearest_known(const search::Fitted& nominal,
                                          const search::Search& found);

/// With that explanation in the model, the strongest of what is left.
std::optional<remark::StrongestLeft> strongest_left(const search::Fitted& nominal,
                                                    const search::Search& found);

/// Where the fit with the explanation leaves innovations that are not white.
std::optional<remark::LeftNotWhite> left_not_white(const Whiteness& whiteness);

/// Terms of a fitted model, a cause among them, that remember another path than that of the fit, or
/// a gap in which nobody knows when the platform was turned; alternatives: whose terms may
/// remember such a gap, too.
std::optional<remark::MemoryOff> memory_off(const search::Fitted& fit,
                                            std::span<const search::Refit> alternatives,
                                            const Timeline& timeline);

/// Whether the drift equation is (5) or (6) is part of the nominal model: where the test does not
/// tell, its agreement says nothing of it (physics.md 1.7). Empty where a cause is the equation.
std::optional<remark::OtherEquation> equation_against_other(const Diagnosis& diagnosis);

/// The terms that were left out of the comparison, and why; those that the nominal model holds and
/// those that act through random numbers alone are not among them. timeline: of the test.
std::vector<NotExamined> not_examined(const search::Fitted& nominal,
                                      const std::vector<search::Cause>& causes,
                                      const Timeline& timeline);

}  // namespace drift::diagnosis
