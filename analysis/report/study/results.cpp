#include "analysis/report/study/results.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/report/page/swept_value.hpp"
#include "analysis/report/page/wording.hpp"

namespace drift::report {

std::vector<Pair> pairs_of(const StudyResults& results) {
  std::vector<Pair> pairs;
  for (std::size_t p = 0; p < results.statistics.size(); ++p)
    for (std::size_t f = 0; f < results.statistics[p].filters().size(); ++f)
      pairs.push_back({p, f});
  return pairs;
}

const mc::FilterStatistics& statistics_of(const StudyResults& results, const Pair& pair) {
  return results.statistics[pair.point].filters()[pair.filter];
}

bool matched(const StudyResults& results, const Pair& pair) {
  const TruthSpec& truth = results.points[pair.point].study.truth;
  const Coupling filter = statistics_of(results, pair).columns().coupling;
  if (truth.coupling == Coupling::servo)
    return filter == Coupling::eq6 && truth.servo.float_restraint == 0.0;
  if (filter == truth.coupling || filter == Coupling::lambda) return true;
  // A loop that compensates nothing is eq. (5).
  if (truth.coupling == Coupling::compensated)
    return filter == Coupling::eq5 && truth.loop == LoopEstimate::given &&
           truth.theta_loop.isZero(0.0);
  return truth.coupling == Coupling::eq5 && filter == Coupling::compensated;
}

std::string condition_of(const mc::StudyPoint& point) {
  std::string text;
  for (const auto& [key, value] : point.values)
    if (key != "truth.coupling")
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key, short_value(value));
  return text;
}

std::vector<std::size_t> pictured_points(const StudyResults& results) {
  constexpr std::size_t most = 4;
  const std::size_t n = results.statistics.size();
  std::vector<std::size_t> points;
  for (std::size_t k = 0; k < std::min(n, most); ++k)
    points.push_back(n <= most ? k : k * (n - 1) / (most - 1));
  return points;
}

std::string name_of(const StudyResults& results, std::size_t point) {
  const std::string condition = condition_of(results.points[point]);
  return fmt::format("truth {}{}{}", key_of(results.points[point].study.truth.coupling),
                     condition.empty() ? "" : ", ", condition);
}

std::string label_of(const StudyResults& results, const Pair& pair) {
  const std::string condition = condition_of(results.points[pair.point]);
  return fmt::format("{} > {}{}{}", key_of(results.points[pair.point].study.truth.coupling),
                     statistics_of(results, pair).columns().name, condition.empty() ? "" : ", ",
                     condition);
}

Cell rate_cell(const stats::Rate& rate, Tone tone) {
  if (rate.of == 0) return "-";
  return {rate.value(),
          fmt::format("{:.1f} % ({:.1f} to {:.1f})", 100.0 * rate.value(), 100.0 * rate.low(),
                      100.0 * rate.high()),
          tone};
}

Cell percent_cell(double share) {
  return {share, std::isfinite(share) ? fmt::format("{:.1f}", 100.0 * share) : "-"};
}

std::size_t worst_parameter(const mc::FilterStatistics& filter, double claims) {
  std::size_t worst = filter.errors().size();
  double largest = 0.0;
  for (std::size_t k = 0; k < filter.errors().size(); ++k) {
    const mc::ErrorStatistics& e = filter.errors()[k];
    if (!(e.learning() < claims) || !(e.deception().value > largest)) continue;
    largest = e.deception().value;
    worst = k;
  }
  return worst;
}

double coverage_of_claims(const mc::FilterStatistics& filter, double claims) {
  double sum = 0.0;
  int n = 0;
  for (const mc::ErrorStatistics& e : filter.errors())
    if (e.learning() < claims) {
      sum += e.coverage()[1].value();
      ++n;
    }
  return n > 0 ? sum / n : std::nan("");
}

std::string key_at(const mc::FilterStatistics& filter, std::size_t k) {
  return parameter_key(filter.columns().layout, k);
}

}  // namespace drift::report
