#include "analysis/report/rank/tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/number_text.hpp"
#include "core/physics/coupling_text.hpp"

namespace drift::report {
namespace {

constexpr double hour = 3600.0, minute = 60.0;  // [s]
constexpr double well_known = 0.5;              // learning ratio: one bit and more
constexpr double other_sigma = 1.5;             // factor between eqs. (5) and (6) worth a line

std::string_view key_of(const Layout& layout, std::size_t state) {
  return TermLibrary::specs[layout.params[state]].key.view();
}

std::string key_and_unit(const Layout& layout, std::size_t state) {
  const auto& spec = TermLibrary::specs[layout.params[state]];
  return fmt::format("{} [{}]", spec.key.view(), spec.unit.symbol.view());
}

std::string in_unit(const observability::ParameterRank& p, double si) {
  return number_text(si / TermLibrary::specs[p.param].unit.to_si);
}

Tone tone_of(double ratio) {
  if (ratio < 0.1) return Tone::good;
  return ratio > 0.9 ? Tone::bad : ratio > well_known ? Tone::doubtful : Tone::plain;
}

std::string coupling_key(const planning::ModelRanking& m) {
  return std::string(key_of(m.model.spec.coupling));
}

/// "D_I_z 9.1, eta_x 3.2" of the largest, with so many decimals; those below `least` are left out.
std::string largest(const Layout& layout, const VecX& values, std::size_t count, double least) {
  std::vector<std::size_t> states(layout.size());
  std::iota(states.begin(), states.end(), std::size_t{0});
  std::ranges::stable_sort(states, std::greater{}, [&](std::size_t k) { return values[k]; });
  std::vector<std::string> parts;
  for (const std::size_t k : states)
    if (parts.size() < count && values[k] >= least)
      parts.push_back(fmt::format("{} {}", key_of(layout, k), decimal_text(values[k], 1)));
  return parts.empty() ? "-" : fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

std::string label_of(const planning::RankingGroup& group, const planning::ModelRanking& m) {
  return fmt::format("{} ({} {})", key_of(m.model.spec.coupling),
                     m.of_the_file ? "filter" : "beside filter", group.filters);
}

std::string plan_line(const mc::Study& study, const planning::PlanRanking& rank) {
  std::vector<std::string> noise;
  if (study.readout.accelerometers)
    noise.push_back(
        fmt::format("accelerometers {} ug", number_text(study.readout.accelerometer_noise / 1e-6)));
  if (study.readout.gimbals)
    noise.push_back(fmt::format("gimbals {} arcsec",
                                number_text(study.readout.gimbal_noise / unit::arcsec.to_si)));
  const auto count = study.plan.positions.size();
  return fmt::format(
      "{} position{} in {:.2f} h{}; linearised at the means of {}; noise of a sample: {}", count,
      count == 1 ? "" : "s", rank.duration / hour,
      study.plan.preset.empty() ? "" : fmt::format(" (preset {})", study.plan.preset),
      rank.at_truth ? "[truth]" : "the priors", fmt::join(noise, ", "));
}

std::vector<std::string> headlines(const mc::Study& study, const planning::PlanRanking& rank) {
  std::vector<std::string> all;
  for (const planning::RankingGroup& g : rank.groups)
    for (const planning::ModelRanking& m : g.models) {
      const observability::Ranking& r = m.ranking;
      const auto known = std::ranges::count_if(
          r.parameters, [](const auto& p) { return p.learning_ratio() < well_known; });
      const auto better =
          std::ranges::count_if(r.spectrum, [](const auto& d) { return d.information > 1.0; });
      std::string text = fmt::format(
          "{}: {:.1f} bits; {} of {} parameters end below half their prior sigma; {} directions "
          "are better known "
          "from the data than from the prior, {} {} not seen at all.",
          label_of(g, m), r.bits, known, r.parameters.size(), better, r.exact.size(),
          r.exact.size() == 1 ? "is" : "are");
      if (r.held_by_attitude.size() > r.exact.size())
        text += fmt::format(" {} more only because the attitude at the cagings has a prior.",
                            r.held_by_attitude.size() - r.exact.size());
      all.push_back(std::move(text));
    }
  if (rank.process_noise)
    all.push_back(
        "A filter has process noise, which this information does not model: sigmas are lower "
        "bounds.");
  if (std::ranges::any_of(study.plan.positions,
                          [](const Position& p) { return p.mode == CommandLaw::free; }))
    all.push_back(
        "Free drift: the rank of the piecewise-constant problem holds for the same positions held "
        "level.");
  return all;
}

Table ranking_table(const planning::RankingGroup& group) {
  const planning::ModelRanking& a = group.models.front();
  const planning::ModelRanking* b = group.models.size() > 1 ? &group.models[1] : nullptr;
  Table t;
  t.title = fmt::format("Ranking for {}", group.filters);
  t.columns = {{"#"},       {"parameter", Align::left},
               {"prior"},   {coupling_key(a)},
               {"left"},    {"alone"},
               {"collin."}, {"bits"}};
  if (b) t.columns.insert(t.columns.end(), {{coupling_key(*b)}, {"left"}});
  for (std::size_t i = 0; i < a.ranking.order.size(); ++i) {
    const std::size_t k = a.ranking.order[i];
    const observability::ParameterRank& p = a.ranking.parameters[k];
    std::vector<Cell> row{std::to_string(i + 1),
                          key_and_unit(group.layout(), k),
                          in_unit(p, p.prior_sigma),
                          in_unit(p, p.posterior_sigma),
                          {number_text(p.learning_ratio()), tone_of(p.learning_ratio())},
                          in_unit(p, p.conditional_sigma),
                          number_text(p.collinearity()),
                          decimal_text(p.bits(), 1)};
    if (b) {
      const observability::ParameterRank& q = b->ranking.parameters[k];
      row.push_back(in_unit(q, q.posterior_sigma));
      row.push_back({number_text(q.learning_ratio()), tone_of(q.learning_ratio())});
    }
    t.add(std::move(row));
  }
  t.note =
      "1 sigma after the test; left: of the prior sigma (the learning ratio, by which they are "
      "ranked); alone: if all "
      "other parameters were known; collin.: sigma over alone; bits: log2(1/left).";
  return t;
}

Table elsewhere_table(const planning::ModelRanking& m) {
  constexpr double factor = 1.5;
  Table t;
  t.title = fmt::format("Where the promise depends on the truth, {}", coupling_key(m));
  t.columns = {
      {"parameter", Align::left}, {"left, as ranked"}, {"left, at four drawn truths", Align::left}};
  for (const std::size_t k : m.ranking.order) {
    const double here = m.ranking.learning_ratio(k);
    const planning::Elsewhere& e = m.elsewhere[k];
    if (e.high < factor * here && e.low > here / factor) continue;
    t.add({key_and_unit(m.ranking.layout, k), number_text(here),
           fmt::format("{} to {}", number_text(e.low), number_text(e.high))});
  }
  t.note = t.rows.empty()
               ? fmt::format(
                     "No sigma changes by more than a factor {} at truths drawn from the priors.",
                     factor)
               : "Parameters enter as products here: the sigma at the point of the ranking is not "
                 "the one elsewhere.";
  return t;
}

Table coupling_table(const planning::RankingGroup& group) {
  Table t;
  t.title = "Where eqs. (5) and (6) promise different sigmas";
  t.columns = {{"parameter", Align::left}, {"prior"}, {"eq5"}, {"eq6"}, {"eq6/eq5"}};
  if (group.models.size() < 2) return t;
  const bool swapped = group.models[0].model.spec.coupling == Coupling::eq6;
  const observability::Ranking& r5 = group.models[swapped ? 1 : 0].ranking;
  const observability::Ranking& r6 = group.models[swapped ? 0 : 1].ranking;
  std::vector<std::size_t> states = r5.order;
  const auto factor = [&](std::size_t k) { return r6.learning_ratio(k) / r5.learning_ratio(k); };
  std::ranges::stable_sort(states, std::greater{},
                           [&](std::size_t k) { return std::abs(std::log(factor(k))); });
  for (const std::size_t k : states) {
    if (std::abs(std::log(factor(k))) < std::log(other_sigma)) break;
    const observability::ParameterRank &p5 = r5.parameters[k], &p6 = r6.parameters[k];
    t.add({key_and_unit(group.layout(), k), in_unit(p5, p5.prior_sigma),
           in_unit(p5, p5.posterior_sigma), in_unit(p6, p6.posterior_sigma),
           number_text(factor(k))});
  }
  t.note = t.rows.empty()
               ? fmt::format(
                     "No parameter's sigma differs by more than a factor {}: on this plan the two "
                     "equations see equally much.",
                     other_sigma)
               : "";
  return t;
}

Table position_table(const mc::Study& study, const planning::ModelRanking& m) {
  Table t;
  t.title = fmt::format("What each position tells, {}", coupling_key(m));
  t.columns = {{"#"},
               {"position", Align::left},
               {"bits"},
               {"tells most of [bit]", Align::left},
               {"lost without it [bit]", Align::left}};
  for (std::size_t p = 0; p < study.plan.positions.size(); ++p)
    t.add({std::to_string(p + 1), study.plan.positions[p].name, decimal_text(m.course.bits[p], 1),
           largest(m.ranking.layout, m.course.position_gain.col(p), 3, 0.1),
           largest(m.ranking.layout, m.course.loss.col(p), 3, 0.1)});
  t.note =
      "Bits are log2 of sigma before over after, positions taken in their order; lost: of sigma "
      "without what was "
      "measured there over sigma.";
  return t;
}

Table minutes_table(const mc::Study& study, const planning::ModelRanking& m) {
  Table t;
  t.title = fmt::format("Which minutes tell most of each parameter, {}", coupling_key(m));
  t.columns = {{"parameter", Align::left}, {"bits"},       {"position", Align::left},
               {"minutes", Align::left},   {"bits there"}, {"cannot do without", Align::left}};
  for (const std::size_t k : m.ranking.order) {
    const double bits = m.ranking.parameters[k].bits();
    Eigen::Index bin = 0, position = 0;
    const double there = m.course.gain.row(k).maxCoeff(&bin);
    const double loss = m.course.loss.row(k).maxCoeff(&position);
    const bool some = there > 0.01;
    const observability::TimeBin& b = m.bins[bin];
    t.add({std::string(key_of(m.ranking.layout, k)), decimal_text(bits, 1),
           some ? study.plan.positions[b.position].name : "-",
           some ? fmt::format("{} to {}{}", number_text(b.t0 / minute, 4),
                              number_text(b.t1 / minute, 4), b.slew ? " (slew)" : "")
                : "-",
           some ? decimal_text(there, 1) : "-",
           loss > 0.1 ? fmt::format("{} ({} bit)", study.plan.positions[position].name,
                                    decimal_text(loss, 1))
                      : "-"});
  }
  t.note = "Minutes from the start of the test.";
  return t;
}

Table direction_table(const planning::ModelRanking& m) {
  constexpr std::size_t shown = 5;
  const observability::Ranking& r = m.ranking;
  Table t;
  t.title = fmt::format("Directions best and worst seen, {}", coupling_key(m));
  t.columns = {{"#"}, {"information"}, {"left"}, {"made of (participation)", Align::left}};
  const std::size_t seen = r.spectrum.size() - r.exact.size();
  for (std::size_t i = 0; i < seen; ++i) {
    if (i >= shown && i + shown < seen) continue;
    const observability::EigenDirection& d = r.spectrum[i];
    t.add({std::to_string(i + 1), number_text(d.information),
           number_text(1.0 / std::sqrt(1.0 + d.information)), observability::name_of(d, r.layout)});
  }
  t.note = "Eigenvalues of the prior-scaled information: 1 is as good as the prior.";
  return t;
}

Table method_table(const planning::ModelRanking& m) {
  Table t;
  t.title = fmt::format("Other methods beside the learning ratio, {}", coupling_key(m));
  t.columns = {{"method", Align::left}, {"Spearman"}};
  for (const observability::MethodRanking& method : m.methods)
    t.add({method.method, decimal_text(method.spearman, 2)});
  t.note = fmt::format(
      "PWCS: rank {} of {} (attitude and parameters) of the positions held level with known slews "
      "between them{}.",
      m.pwcs.rank, m.pwcs.states,
      m.pwcs.clear() ? "" : "; not beyond doubt here (gap or condition of the theorem)");
  return t;
}

std::vector<std::string> disagreements(const planning::ModelRanking& m) {
  std::vector<std::string> all;
  for (const observability::MethodRanking& method : m.methods)
    for (const auto& d : method.disagreements)
      all.push_back(fmt::format("{}: rank {:g} by {}, {:g} by learning ratio: {}.",
                                key_of(m.ranking.layout, d.state), d.rank_here, method.key,
                                d.rank_learning, d.reason));
  return all;
}

}  // namespace drift::report
