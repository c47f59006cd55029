#include <fmt/format.h>

#include <algorithm>

#include "analysis/report/rank/tables.hpp"
#include "core/physics/coupling_text.hpp"

namespace drift::report {
namespace {

/// A named direction over the prior-scaled layout, unit length.
VecX scaled(const NamedDirection& direction, const Layout& layout) {
  VecX v = VecX::Zero(static_cast<Eigen::Index>(layout.size()));
  for (const auto& part : direction.parts) {
    const auto k = std::ranges::find(layout.params, part.param) - layout.params.begin();
    v[k] = part.coefficient * TermLibrary::specs[part.param].unit.to_si / layout.sigma[k];
  }
  return v.normalized();
}

}  // namespace

std::vector<NamedDirection> exact_degeneracies(const planning::ModelRanking& m) {
  return name_degeneracies(m.ranking.layout, m.model.spec.mounting, m.ranking.exact);
}

std::vector<NamedDirection> held_by_attitude(const planning::ModelRanking& m) {
  constexpr double outside = 0.1;  // of a unit vector; parts below 2 % were left out of its name
  std::vector<NamedDirection> found;
  const observability::Ranking& r = m.ranking;
  if (r.held_by_attitude.size() <= r.exact.size()) return found;
  for (NamedDirection& d : name_degeneracies(r.layout, m.model.spec.mounting, r.held_by_attitude)) {
    VecX rest = scaled(d, r.layout);
    for (const WeakDirection& w : r.exact) rest -= w.direction.dot(rest) * w.direction;
    if (rest.norm() > outside) found.push_back(std::move(d));
  }
  return found;
}

Table null_table(const planning::ModelRanking& m) {
  Table t;
  t.title = fmt::format("Directions this test does not see, {}", key_of(m.model.spec.coupling));
  t.columns = {{"combination", Align::left}, {"why", Align::left}};
  const auto add = [&](const std::vector<NamedDirection>& all) {
    for (const NamedDirection& d : all)
      t.add({d.combination, d.reason.empty() ? "not a known one" : d.reason});
  };
  add(exact_degeneracies(m));
  if (const auto held = held_by_attitude(m); !held.empty()) {
    t.add_heading("only the prior of the attitude at the cagings holds these:");
    add(held);
  }
  t.note = t.rows.empty() ? "None: every direction leaves a signal, however small." : "";
  return t;
}

}  // namespace drift::report
