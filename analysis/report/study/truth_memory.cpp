#include "analysis/report/study/truth_memory.hpp"

#include "analysis/identification/memory_doubt.hpp"
#include "analysis/report/page/wording.hpp"

namespace drift::report {

std::string truth_memory_text(const mc::Study& study, std::uint64_t run) {
  const auto doubt = identification::memory_doubt(study, run);
  return doubt.empty() ? ""
                       : fmt::format("note: [truth]: run {} is not what a platform does: the {}\n",
                                     run, memory_text(doubt));
}

}  // namespace drift::report
