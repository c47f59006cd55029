#include "analysis/forms/grammar.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace drift::forms {
namespace {

using Where = AttitudePart::Kind;
using When = TimePart::Kind;

/// Products of quantities, to third order.
std::vector<AttitudePart> products(std::size_t quantities) {
  std::vector<AttitudePart> all;
  for (std::size_t i = 0; i < quantities; ++i) {
    all.push_back({Where::product, {i}});
    for (std::size_t j = i; j < quantities; ++j) {
      all.push_back({Where::product, {i, j}});
      for (std::size_t k = j; k < quantities; ++k) all.push_back({Where::product, {i, j, k}});
    }
  }
  return all;
}

/// Thresholds that part the positions, by what they have of something: in the middles of the gaps.
std::vector<AttitudePart> gates(Where kind, std::size_t axis, const VecX& value,
                                const std::vector<int>& position) {
  std::vector<double> sums, counts;
  for (Eigen::Index i = 0; i < value.size(); ++i) {
    const auto p = static_cast<std::size_t>(position[i]);
    if (p >= sums.size()) {
      sums.resize(p + 1, 0.0);
      counts.resize(p + 1, 0.0);
    }
    sums[p] += value[i];
    counts[p] += 1.0;
  }
  std::set<double> means;
  for (std::size_t p = 0; p < sums.size(); ++p)
    if (counts[p] > 0.0) means.insert(sums[p] / counts[p]);
  std::vector<AttitudePart> all;
  for (auto at = means.begin(); at != means.end() && std::next(at) != means.end(); ++at) {
    const double gap = *std::next(at) - *at;
    // Positions that are meant to be alike are not parted by rounding.
    if (gap > 1e-6) all.push_back({kind, {axis}, 1, *at + 0.5 * gap, 0.5 * gap});
  }
  return all;
}

std::vector<AttitudePart> attitude_parts(const Instants& at) {
  constexpr int most_harmonic = 8, most_halves = 4;
  std::vector<AttitudePart> all{{}};
  const auto append = [&](std::vector<AttitudePart> more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  append(products(at.quantities.size()));
  for (std::size_t a = 0; a < 3; ++a) {
    for (int half = 0; half <= most_halves; ++half)
      all.push_back({Where::saturation, {a}, 1, std::ldexp(1.0, -half), 0.0});
    for (int n = 1; n <= most_harmonic; ++n) all.push_back({Where::harmonic, {a}, n});
    append(gates(Where::above, a, at.force[a], at.position));
    append(gates(Where::below, a, at.force[a], at.position));
    append(gates(Where::beyond, a, at.force[a].cwiseAbs(), at.position));
  }
  return all;
}

std::vector<TimePart> time_parts(const Instants& at, const std::vector<double>& bin_starts,
                                 double bin_length) {
  std::vector<TimePart> all{{}};
  const double length = at.t.maxCoeff() - at.t.minCoeff(), dwell = at.t_position.maxCoeff();
  for (const int n : {1, 2}) all.push_back({When::power, n});
  for (double T = length; T > 2.0 * bin_length; T *= 0.5) all.push_back({When::decay, 1, T});
  for (double T = dwell; T > 2.0 * bin_length; T *= 0.5)
    all.push_back({When::decay_in_position, 1, T});
  for (int k = 2; 2.0 * length / k > 4.0 * bin_length; ++k)
    all.push_back({When::harmonic, 1, 2.0 * length / k});
  for (std::size_t b = 1; b < bin_starts.size(); ++b)
    all.push_back({When::onset, 1, bin_starts[b], 0.0, 0.5 * bin_length});
  return all;
}

/// How many kinds there are, and members of one.
template <class Part>
std::pair<double, double> kinds_and_members(const std::vector<Part>& parts,
                                            decltype(Part::kind) kind) {
  std::set<decltype(Part::kind)> kinds;
  double members = 0.0;
  for (const Part& p : parts) {
    kinds.insert(p.kind);
    members += p.kind == kind;
  }
  return {static_cast<double>(kinds.size()), members};
}

}  // namespace

double Grammar::log_prior(AttitudePart::Kind w, TimePart::Kind t) const {
  const auto [kinds, members] = kinds_and_members(where, w);
  const auto [listed, alike] = kinds_and_members(when, t);
  const double times = t == When::window ? static_cast<double>(windows) : alike;
  return -std::log(static_cast<double>(places.size()) * kinds * members * (listed + 1.0) * times);
}

Grammar grammar_of(const Instants& at, const std::vector<double>& bin_starts, double bin_length,
                   bool accelerometers, bool gimbals) {
  Grammar g;
  for (const auto& target : own_targets) {
    const OwnSlot slot = target.value.slot;
    if (slot == OwnSlot::drift || (slot == OwnSlot::accelerometer && accelerometers) ||
        (slot == OwnSlot::gimbal && gimbals))
      g.places.push_back(target.value);
  }
  g.where = attitude_parts(at);
  g.when = time_parts(at, bin_starts, bin_length);
  const std::size_t n = bin_starts.size();
  g.windows = n * (n + 1) / 2;
  return g;
}

}  // namespace drift::forms
