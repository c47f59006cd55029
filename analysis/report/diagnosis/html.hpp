#pragma once

#include <string>
#include <vector>

#include "analysis/diagnosis/diagnosis.hpp"
#include "analysis/report/identify/figures.hpp"
#include "analysis/report/page/html_report.hpp"
#include "mc/study/study.hpp"

namespace drift::report {

/// What the report says beside the diagnosis: where it came from.
struct DiagnosisSource {
  std::vector<std::string> recordings;  ///< files
  std::string details;                  ///< kept as written, fixed width; may be empty
};

/// Everything there is to say of a diagnosis, with its pictures: verdict, where, candidates, fit
/// before and after, what moved, noise, likeness, advice, provenance.
HtmlReport diagnosis_html(const mc::Study& study, const diagnosis::Diagnosis& diagnosis,
                          const DiagnosisSource& source);

/// All pictures of a diagnosis, in the order of the report.
std::vector<Figure> diagnosis_figures(const diagnosis::Diagnosis& diagnosis);

}  // namespace drift::report
