#include "analysis/search/refine_grids.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>

#include "analysis/inference/thresholds.hpp"
#include "core/base/check.hpp"
#include "core/physics/own/own_scenes.hpp"

namespace drift::search {
namespace {

constexpr int between = 3;       // settings put between each two points
constexpr int parts_about = 16;  // of a cell about a setting that was found

/// Time constants and periods are spread by factors, moments evenly.
double part_of_the_way(ParamKind kind, double a, double b, double part) {
  return kind != ParamKind::moment && a > 0.0 && b > 0.0 ? a * std::pow(b / a, part)
                                                         : a + part * (b - a);
}

/// The columns of a candidate at one more setting, computed once for all candidates of its term.
class Columns {
 public:
  explicit Columns(Fitted& e) : e_(e), first_(e.set.signatures.size()) {}

  std::vector<int> of(const inference::Candidate& c, const inference::Variant& pattern,
                      std::size_t place, double value) {
    const std::size_t param = pattern.settings[place].first;
    std::vector<int> columns;
    for (std::size_t k = 0; k < c.params.size(); ++k) {
      inference::SignatureSpec spec =
          e_.set.signatures[static_cast<std::size_t>(pattern.columns[k])];
      spec.theta[param] = value;
      const auto [at, fresh] = known_.try_emplace({c.params[k], others(pattern, place), value},
                                                  static_cast<int>(e_.set.signatures.size()));
      if (fresh) e_.set.signatures.push_back(spec);
      columns.push_back(at->second);
    }
    return columns;
  }
  std::span<const inference::SignatureSpec> added() const {
    return std::span(e_.set.signatures).subspan(first_);
  }

 private:
  using Key = std::tuple<std::size_t, std::vector<double>, double>;
  static std::vector<double> others(const inference::Variant& v, std::size_t place) {
    std::vector<double> values;
    for (std::size_t k = 0; k < v.settings.size(); ++k)
      if (k != place) values.push_back(v.settings[k].second);
    return values;
  }
  Fitted& e_;
  std::size_t first_;
  std::map<Key, int> known_;
};

bool same_but(const inference::Variant& a, const inference::Variant& b, std::size_t place) {
  for (std::size_t k = 0; k < a.settings.size(); ++k)
    if (k != place && a.settings[k].second != b.settings[k].second) return false;
  return true;
}

/// Puts so many settings between variants `v` and `v + 1`; each of these hands over the nearer part
/// of its chance.
void fill(inference::Candidate& c, std::size_t v, int settings, std::size_t place,
          Columns& columns) {
  const inference::Variant low = c.variants[v], high = c.variants[v + 1];
  const double kept = 0.5 + 0.5 / (settings + 1);  // half lies on the other side
  c.variants[v].share *= kept;
  c.variants[v + 1].share *= kept;
  std::vector<inference::Variant> more;
  for (int k = 1; k <= settings; ++k) {
    inference::Variant one = low;
    one.settings[place].second = part_of_the_way(TermLibrary::specs[low.settings[place].first].kind,
                                                 low.settings[place].second,
                                                 high.settings[place].second, k / (settings + 1.0));
    one.columns = columns.of(c, low, place, one.settings[place].second);
    one.share = (1.0 - kept) * (low.share + high.share) / settings;
    one.between = true;
    more.push_back(std::move(one));
  }
  c.variants.insert(c.variants.begin() + static_cast<std::ptrdiff_t>(v) + 1, more.begin(),
                    more.end());
}

/// Gaps of a candidate's grid and how many settings are put into each, from above, so that those
/// below stay where they are.
using Gaps = std::map<std::size_t, int, std::greater<>>;

Gaps beside_best_settings(const Fitted& e, std::size_t k) {
  Gaps gaps;
  for (const std::size_t v : best_settings(e, k, inference::ReachLimits::refine_setting,
                                           inference::EffortLimits::settings)) {
    if (v + 1 < e.set.candidates[k].variants.size()) gaps[v] = between;
    if (v > 0) gaps[v - 1] = between;
  }
  return gaps;
}

Gaps between_points(const Fitted& e, std::size_t k) {
  const auto& variants = e.set.candidates[k].variants;
  Gaps gaps;
  for (std::size_t v = 0; v + 1 < variants.size(); ++v)
    if (!variants[v].between && !variants[v + 1].between) gaps[v] = between;
  return gaps;
}

/// The gaps of the cells of the library's grid about a value and of the cells beside it.
Gaps about(const inference::Candidate& c, std::size_t place, double value) {
  std::vector<std::size_t> grid;
  for (std::size_t v = 0; v < c.variants.size(); ++v)
    if (!c.variants[v].between) grid.push_back(v);
  Gaps gaps;
  for (std::size_t cell = 0; cell + 1 < grid.size(); ++cell) {
    const auto at = [&](std::size_t point) {
      return c.variants[grid[std::min(point, grid.size() - 1)]].settings[place].second;
    };
    const bool near = at(cell > 0 ? cell - 1 : 0) <= value && value <= at(cell + 2);
    const int parts = static_cast<int>(grid[cell + 1] - grid[cell]);
    for (std::size_t v = grid[cell]; v < grid[cell + 1] && near && parts < parts_about; ++v)
      gaps[v] = parts_about / parts - 1;
  }
  return gaps;
}

bool without_slope(const inference::Candidate& c) {
  const auto place = continuous_setting(c);
  return place && !has_slope(c.variants.front().settings[*place].first);
}

/// Whether the gap behind a variant is wider than a row of the test, or a thousandth of the grid.
bool is_wide(const inference::Candidate& c, std::size_t v, const Timeline& timeline) {
  const std::size_t place = *continuous_setting(c);
  const auto at = [&](std::size_t variant) { return c.variants[variant].settings[place].second; };
  const bool is_time =
      TermLibrary::specs[c.variants.front().settings[place].first].unit.same_dimension(unit::s);
  double least = 1e-3 * std::abs(at(c.variants.size() - 1) - at(0));
  if (is_time) least = std::ranges::min(timeline.intervals, {}, &Interval::length).length();
  return std::abs(at(v + 1) - at(v)) > least;
}

template <class GapsOf>
Fitted refined(Fitted e, const MeasuredTest& test, double least_log_bayes, GapsOf&& gaps_of) {
  Columns columns(e);
  for (std::size_t k = 0; k < e.set.candidates.size(); ++k) {
    inference::Candidate& c = e.set.candidates[k];
    const auto place = continuous_setting(c);
    if (!place || e.scores[k].dof == 0 || e.scores[k].log_bayes < least_log_bayes) continue;
    for (const auto& [v, settings] : gaps_of(e, k))
      if (same_but(c.variants[v], c.variants[v + 1], *place)) fill(c, v, settings, *place, columns);
  }
  const auto added = columns.added();
  if (added.empty()) return e;
  const MatX more = inference::signature_columns(e.filter, test, e.fit, added, e.problem.tags);
  const Eigen::Index before = e.problem.extra.cols();
  e.problem.extra.conservativeResize(Eigen::NoChange, before + more.cols());
  e.problem.extra.rightCols(more.cols()) = more;
  const inference::NoiseEstimate noise = e.noise;
  return with_noise(std::move(e), test.timeline, noise);
}

}  // namespace

std::optional<std::size_t> continuous_setting(const inference::Candidate& c) {
  std::optional<std::size_t> found;
  const auto& settings = c.variants.front().settings;
  for (std::size_t k = 0; k < settings.size(); ++k) {
    if (!TermLibrary::specs[settings[k].first].continuous()) continue;
    if (found) return {};
    found = k;
  }
  return found;
}

Fitted refine_grids(Fitted e, const MeasuredTest& test, double worth) {
  double top = 0.0;
  for (const Score& s : e.scores) top = std::max(top, s.log_bayes);
  return refined(std::move(e), test, top - worth, beside_best_settings);
}

Fitted settle_without_slope(Fitted e, const MeasuredTest& test, double worth) {
  constexpr int most_passes = 8;  // of four parts each: 65,000
  for (int pass = 0; pass < most_passes; ++pass) {
    double top = 0.0;
    for (const Score& s : e.scores) top = std::max(top, s.log_bayes);
    bool wide = false;
    e = refined(std::move(e), test, top - worth, [&](const Fitted& now, std::size_t k) {
      Gaps gaps = without_slope(now.set.candidates[k]) ? beside_best_settings(now, k) : Gaps{};
      std::erase_if(gaps, [&](const auto& gap) {
        return !is_wide(now.set.candidates[k], gap.first, test.timeline);
      });
      wide = wide || !gaps.empty();
      return gaps;
    });
    if (!wide) break;
  }
  return e;
}

Fitted refine_whole_grids(Fitted e, const MeasuredTest& test) {
  return refined(std::move(e), test, -std::numeric_limits<double>::infinity(), between_points);
}

Fitted refine_about(Fitted e, const MeasuredTest& test, const std::vector<SettingFound>& found) {
  return refined(std::move(e), test, -std::numeric_limits<double>::infinity(),
                 [&](const Fitted& now, std::size_t k) {
                   const inference::Candidate& c = now.set.candidates[k];
                   Gaps gaps;
                   for (const SettingFound& f : found)
                     if (f.candidate == k) gaps.merge(about(c, *continuous_setting(c), f.value));
                   return gaps;
                 });
}

std::size_t variant_at(const inference::Candidate& candidate, const inference::Settings& settings) {
  const auto at = std::ranges::find(candidate.variants, settings, &inference::Variant::settings);
  DRIFT_EXPECTS(at != candidate.variants.end());
  return static_cast<std::size_t>(at - candidate.variants.begin());
}

}  // namespace drift::search
