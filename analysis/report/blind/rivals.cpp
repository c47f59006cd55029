#include "analysis/report/blind/sections.hpp"

namespace drift::report {
namespace {

Cell cell_of(const stats::Proportion& p) {
  if (p.n == 0) return "-";
  return {std::vector<double>{p.share(), p.low, p.high},
          fmt::format("{} of {} ({:.2f} to {:.2f})", p.k, p.n, p.low, p.high)};
}

}  // namespace

Table rivals_table(const BlindResults& results) {
  Table table("Other methods on the same trials (95 % intervals)",
              "method=<method | false_alarms=false alarms, nothing hidden | noise_alarms=noise not "
              "as declared | detected=effects detected | right=single: the right name alone | "
              "among=among others | wrong=wrong names only");
  std::vector<blind::RivalScore> all{blind::rival_score("driftscope", results.scores)};
  all.insert(all.end(), results.rivals.begin(), results.rivals.end());
  for (const blind::RivalScore& r : all)
    table.add({r.name, cell_of(r.false_alarms), cell_of(r.noise_alarms), cell_of(r.detected),
               cell_of(r.right), cell_of(r.among), cell_of(r.wrong)});
  return table;
}

Section others(const BlindResults& results) {
  if (results.rivals.empty()) return {};
  return {"Rivals", {rivals_table(results)}};
}

}  // namespace drift::report
