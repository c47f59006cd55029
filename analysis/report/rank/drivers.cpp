#include <algorithm>
#include <numeric>

#include "analysis/report/rank/sections.hpp"
#include "analysis/report/svg/bar_chart.hpp"
#include "analysis/report/svg/figure.hpp"

namespace drift::report {
namespace {

/// One thing that could be known twice as well, and how much that takes off a sigma.
struct Gain {
  enum class Of { accelerometers, gimbals, attitude, own_prior, other_prior, process_noise };
  Of of = Of::own_prior;
  std::size_t state = 0;  ///< whose prior
  double part = 0.0;      ///< of the sigma
};

std::string driver_in_words(const Gain& gain, const Layout& layout) {
  switch (gain.of) {
    case Gain::Of::accelerometers:
      return "accelerometer noise";
    case Gain::Of::gimbals:
      return "gimbal noise";
    case Gain::Of::attitude:
      return "attitude at caging";
    case Gain::Of::own_prior:
      return "its own prior";
    case Gain::Of::process_noise:
      return "process noise";
    case Gain::Of::other_prior:
      break;
  }
  return "prior of " + parameter_key(layout, gain.state);
}

/// Everything that moves a parameter, the strongest first.
std::vector<Gain> gains_of(const observability::Drivers& d, std::size_t k) {
  const auto row = static_cast<Eigen::Index>(k);
  std::vector<Gain> all{{Gain::Of::accelerometers, 0, 1.0 - d.accelerometers[row]},
                        {Gain::Of::gimbals, 0, 1.0 - d.gimbals[row]},
                        {Gain::Of::attitude, 0, 1.0 - d.attitude[row]},
                        {Gain::Of::process_noise, 0, 1.0 - d.process_noise[row]}};
  for (Eigen::Index j = 0; j < d.priors.cols(); ++j)
    all.push_back({j == row ? Gain::Of::own_prior : Gain::Of::other_prior,
                   static_cast<std::size_t>(j), 1.0 - d.priors(row, j)});
  std::ranges::stable_sort(all, std::greater{}, &Gain::part);
  return all;
}

/// The strongest that is not the parameter's own prior.
double reach(const std::vector<Gain>& gains) {
  for (const Gain& g : gains)
    if (g.of != Gain::Of::own_prior) return g.part;
  return 0.0;
}

BarChart tornado(const planning::ModelRanking& m) {
  constexpr std::size_t most_parameters = 8, most_drivers = 3;
  constexpr double least = 0.01;  // of a sigma
  const Layout& layout = m.ranking.layout;
  std::vector<std::vector<Gain>> gains;
  for (std::size_t k = 0; k < layout.size(); ++k) gains.push_back(gains_of(m.drivers, k));
  std::vector<std::size_t> states(layout.size());
  std::iota(states.begin(), states.end(), std::size_t{0});
  std::ranges::stable_sort(states, std::greater{}, [&](std::size_t k) { return reach(gains[k]); });
  BarChart chart{fmt::format("What drives the sigmas, {}", key_of(m.model.spec.coupling)),
                 "how much smaller the sigma becomes where this is known twice as well [%]",
                 {},
                 std::nullopt,
                 860.0};
  for (std::size_t i = 0; i < std::min(most_parameters, states.size()); ++i) {
    std::string name = parameter_key(layout, states[i]) + ":  ";
    for (std::size_t g = 0; g < most_drivers; ++g) {
      const Gain& gain = gains[states[i]][g];
      if (gain.part < least) break;
      constexpr std::size_t colours[] = {0, 2, 3, 6, 1, 4};
      chart.bars.push_back({.label = name + driver_in_words(gain, layout),
                            .value = 100.0 * gain.part,
                            .colour = colours[static_cast<std::size_t>(gain.of)],
                            .text = fmt::format("{:.0f} %", 100.0 * gain.part)});
      name.clear();
    }
  }
  return chart;
}

/// "Driven most by gimbal noise: 12 parameters; ..."
std::string count_of_drivers(const planning::ModelRanking& m) {
  const Layout& layout = m.ranking.layout;
  std::vector<std::pair<std::string, std::size_t>> counts;
  for (std::size_t k = 0; k < layout.size(); ++k) {
    const Gain first = gains_of(m.drivers, k).front();
    const std::string word = first.of == Gain::Of::other_prior ? "the prior of another parameter"
                                                               : driver_in_words(first, layout);
    const auto at = std::ranges::find(counts, word, &std::pair<std::string, std::size_t>::first);
    if (at == counts.end())
      counts.emplace_back(word, 1);
    else
      ++at->second;
  }
  std::ranges::stable_sort(counts, std::greater{}, &std::pair<std::string, std::size_t>::second);
  std::vector<std::string> parts;
  for (const auto& [word, n] : counts) parts.push_back(fmt::format("{} by {}", n, word));
  return fmt::format("What drives the sigma most, of {} parameters: {}.", layout.size(),
                     fmt::join(parts, ", "));
}

}  // namespace

Table driver_table(const planning::ModelRanking& m) {
  const Layout& layout = m.ranking.layout;
  Table t(fmt::format("What drives the sigma of each parameter, {}", key_of(m.model.spec.coupling)),
          "key=<parameter | accelerometer_noise=accelerometers | gimbal_noise=gimbals | "
          "attitude_at_caging=attitude | own_prior=own prior | other_prior_of=<prior of | "
          "other_prior=there | process_noise=process noise",
          "How much smaller the sigma becomes, in percent, where the noise of the accelerometers, "
          "of the gimbals, the process noise, or a prior sigma is halved.");
  const auto percent_of = [](double part) { return decimals(100.0 * part, 1); };
  for (const std::size_t k : m.ranking.order) {
    const auto row = static_cast<Eigen::Index>(k);
    const std::vector<Gain> gains = gains_of(m.drivers, k);
    const auto other = std::ranges::find(gains, Gain::Of::other_prior, &Gain::of);
    const bool any = other != gains.end() && other->part >= 0.001;
    t.add({parameter_key(layout, k), percent_of(1.0 - m.drivers.accelerometers[row]),
           percent_of(1.0 - m.drivers.gimbals[row]), percent_of(1.0 - m.drivers.attitude[row]),
           percent_of(1.0 - m.drivers.priors(row, row)),
           Cell(any ? parameter_key(layout, other->state) : "-"),
           any ? percent_of(other->part) : Cell("-"),
           percent_of(1.0 - m.drivers.process_noise[row])});
  }
  return t;
}

/// Which prior or instrument decides how well each parameter will be known.
Section drivers(const RankedGroup& v) {
  Section section{"What would make it better", {}, On::page};
  for (std::size_t k = 0; k < v.group.models.size(); ++k) {
    const planning::ModelRanking& m = v.group.models[k];
    if (m.drivers.priors.rows() != static_cast<Eigen::Index>(m.ranking.layout.size())) continue;
    if (BarChart chart = tornado(m); !chart.bars.empty())
      section.add(
          {figure_of(std::move(chart),
                     "The parameters that something else than their own prior moves most, "
                     "each with the three strongest things that could be known twice as well.",
                     k == 0 ? fmt::format("drivers{}.svg", v.suffix) : "")});
    section.add({Paragraph{count_of_drivers(m)}, driver_table(m)});
  }
  return section;
}

}  // namespace drift::report
