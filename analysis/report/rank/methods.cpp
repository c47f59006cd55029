#include "analysis/report/rank/sections.hpp"

namespace drift::report {

/// Rank correlation of the other methods with the learning ratio; where two rankings disagree and
/// why, one sentence each.
Section methods(const RankedGroup& v) {
  Section section;
  for (std::size_t k = 0; k < v.group.models.size(); ++k) {
    const planning::ModelRanking& m = v.group.models[k];
    Table t(
        fmt::format("Other methods beside the learning ratio, {}", key_of(m.model.spec.coupling)),
        "<method | Spearman",
        fmt::format(
            "PWCS: rank {} of {} (attitude and parameters) of the positions held level "
            "with known slews between them{}.",
            m.pwcs.rank, m.pwcs.states,
            m.pwcs.clear() ? "" : "; not beyond doubt here (gap or condition of the theorem)"));
    Sentences disagreements;
    for (const observability::MethodRanking& method : m.methods) {
      t.add({method.method, decimals(method.spearman, 2)});
      for (const auto& d : method.disagreements)
        disagreements.items.push_back(
            fmt::format("{}: rank {:g} by {}, {:g} by learning ratio: {}.",
                        parameter_key(m.ranking.layout, d.state), d.rank_here, method.key,
                        d.rank_learning, d.reason));
    }
    section.add({{t, shown_of(k)}, {disagreements, shown_of(k)}});
  }
  return section;
}

}  // namespace drift::report
