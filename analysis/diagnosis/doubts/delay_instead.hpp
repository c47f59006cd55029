#pragma once

#include <optional>
#include <vector>

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::diagnosis {

/// Asks whether accelerometers and gimbals of different instants stand in place of what was found
/// (identification::delay_of_misfit()): momentary readings of accelerometers among them, which are
/// half an interval from the means that the model has. With it go the odds against the causes: both
/// fitted to the same dwells under the same noise, one recording of 1000 being so
/// (SiteLimits::another), and of the effects of the library one as likely as another.
///
/// Asked where the verdict is not `consistent`, or chi-square is above its band. recordings: as
/// they were diagnosed. recorded: as they were read. Empty otherwise.
std::optional<remark::DelayInstead> delay_instead(const mc::Study& study,
                                                  const std::vector<Recording>& recordings,
                                                  const std::vector<Recording>& recorded,
                                                  const Diagnosis& diagnosis);

/// The same diagnosis with that said. What was named is only one of two explanations unless its
/// odds against the delay are better than 19 to 1 (SearchLimits::credible): the verdict is
/// `ambiguous`.
Diagnosis with_delay(Diagnosis diagnosis, const remark::DelayInstead& delay);

}  // namespace drift::diagnosis
