#include "analysis/report/page/study_section.hpp"

namespace drift::report {

Section study_section(const mc::Study& study) {
  if (study.resolved.empty()) return {};
  Table table("", "<key | <value | <from");
  for (const mc::Resolved& r : study.resolved) table.add({r.key, r.value, r.origin});
  return {"Study",
          {Paragraph{"Every value the study resolves to, and where it comes from."}, table},
          On::page,
          Part::provenance};
}

}  // namespace drift::report
