#include "analysis/report/page/planned_study.hpp"

#include <fmt/format.h>

#include "analysis/planning/study_with_positions.hpp"
#include "core/base/words.hpp"

namespace drift::report {
namespace {

TextFile headed(const std::string& name, const mc::Study& study, const std::string& text) {
  return {name, as_comment(unswept_text(name, study)) + text};
}

}  // namespace

TextFile study_file_with_positions(const std::string& name, const mc::Study& study,
                                   const std::vector<Position>& positions) {
  return headed(name, study, planning::study_with_positions(study, positions));
}

TextFile extended_study_file(const std::string& name, const mc::Study& study,
                             const std::vector<Position>& positions) {
  return headed(name, study, planning::extended_study(study, positions));
}

std::string unswept_text(const std::string& name, const mc::Study& study) {
  const std::vector<std::string> keys = planning::swept_of_plan(study);
  if (keys.empty()) return "";
  return fmt::format(
      "{} does not sweep {}: its positions are written out one by one, each with a dwell, sample, "
      "mode and entry of its own. They are those of the values above [sweep].",
      name, listed(keys, "and"));
}

}  // namespace drift::report
