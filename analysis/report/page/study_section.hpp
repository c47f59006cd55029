#pragma once

#include "analysis/report/page/report.hpp"
#include "mc/study/study.hpp"

namespace drift::report {

/// Every value of a study and where it comes from; nothing of a study that was not read.
Section study_section(const mc::Study& study);

}  // namespace drift::report
