#pragma once

#include "analysis/report/page/report.hpp"
#include "mc/study/study.hpp"

namespace drift::report {

/// The study as a file of this name, its plan written out as these positions; headed by what of its
/// [sweep] is left out.
TextFile study_file_with_positions(const std::string& name, const mc::Study& study,
                                   const std::vector<Position>& positions);

/// The same with positions added behind those of the plan.
TextFile extended_study_file(const std::string& name, const mc::Study& study,
                             const std::vector<Position>& positions);

/// That a file whose plan is written out does not sweep what the study does, whole sentences; empty
/// where it does.
std::string unswept_text(const std::string& name, const mc::Study& study);

}  // namespace drift::report
