#include <algorithm>
#include <cmath>

#include "analysis/report/rank/sections.hpp"
#include "analysis/report/svg/curve.hpp"
#include "analysis/report/svg/figure.hpp"

namespace drift::report {
namespace {

constexpr double least_shown = -12.0;  // log10 of the information that counts as none in a picture

Table null_table(const planning::ModelRanking& m) {
  Table t = direction_table(
      fmt::format("Directions this test does not see, {}", key_of(m.model.spec.coupling)));
  add_directions(t, unseen_directions(m));
  if (const auto held = held_by_attitude(m); !held.empty()) {
    t.add_heading(
        "Only the prior of the attitude at the cagings holds these (signal: without that prior):");
    add_directions(t, held);
  }
  return t;
}

bool same_rows(const Table& a, const Table& b) {
  return std::ranges::equal(a.rows, b.rows, [](const TableRow& x, const TableRow& y) {
    return std::ranges::equal(x.cells, y.cells, {}, &Cell::text, &Cell::text);
  });
}

}  // namespace

std::vector<NamedDirection> unseen_directions(const planning::ModelRanking& m) {
  const observability::Ranking& r = m.ranking;
  return name_degeneracies(r.layout, m.model.spec.mounting,
                           {r.unseen, r.root, r.excitation, m.model.spec.coupling});
}

std::vector<NamedDirection> held_by_attitude(const planning::ModelRanking& m) {
  const observability::Ranking& r = m.ranking;
  return name_degeneracies(r.layout, m.model.spec.mounting,
                           {r.unheld, r.root_unheld, r.excitation, m.model.spec.coupling},
                           r.unseen);
}

Chart spectrum_chart(const planning::RankingGroup& group) {
  Panel panel;
  panel.x_label = "direction, best seen first; those not seen at all left out";
  panel.y_label = "log10(information / prior)";
  panel.references.push_back({0.0, "as good as the prior", Stroke::dashed});
  for (std::size_t m = 0; m < group.models.size(); ++m) {
    Series s = curve(key_of(group.models[m].model.spec.coupling), m,
                     m == 0 ? Stroke::solid : Stroke::dashed);
    double index = 1.0;
    for (const observability::EigenDirection& d : group.models[m].ranking.spectrum) {
      const double x = index++, y = std::log10(std::max(d.information, 0.0));
      if (y < least_shown) continue;  // not seen at all
      s.x.push_back(x);
      s.y.push_back(y);
    }
    panel.series.push_back(std::move(s));
  }
  return {fmt::format("Eigenvalues of the information, {}", group.filters),
          {std::move(panel)},
          1,
          narrow_page,
          320.0};
}

/// Eigenvalues, and the directions of which the data say nothing. Both equations often fail to see
/// the same: said once then.
Section unseen(const RankedGroup& v) {
  Section section;
  section.add({figure_of(spectrum_chart(v.group),
                         "Prior-scaled eigenvalues of the information. Below 0 the prior says more "
                         "than the data; -12 stands for anything less.",
                         fmt::format("spectrum{}.svg", v.suffix))});
  std::vector<Table> tables;
  for (const planning::ModelRanking& m : v.group.models) tables.push_back(null_table(m));
  if (tables.size() == 2 && same_rows(tables[0], tables[1])) {
    tables.pop_back();
    tables[0].title = "Directions this test does not see, by eq. (5) or (6)";
  }
  for (Table& t : tables)
    if (t.rows.empty())
      section.add({Paragraph{t.title + ": none. Every direction leaves a signal."}});
    else
      section.add({std::move(t)});
  return section;
}

/// The directions best and worst seen.
Section directions(const RankedGroup& v) {
  constexpr std::size_t most = 5;
  Section section;
  for (std::size_t k = 0; k < v.group.models.size(); ++k) {
    const planning::ModelRanking& m = v.group.models[k];
    Table t(fmt::format("Directions best and worst seen, {}", key_of(m.model.spec.coupling)),
            "# | information | left | <made of (participation)",
            "Eigenvalues of the prior-scaled information: 1 is as good as the prior.");
    const observability::Ranking& r = m.ranking;
    const std::size_t seen = r.spectrum.size() - r.unseen.size();
    for (std::size_t i = 0; i < seen; ++i) {
      if (i >= most && i + most < seen) continue;
      const observability::EigenDirection& d = r.spectrum[i];
      t.add({i + 1, d.information, 1.0 / std::sqrt(1.0 + d.information),
             observability::name_of(d, r.layout)});
    }
    section.add({{t, shown_of(k)}});
  }
  return section;
}

}  // namespace drift::report
