#include "analysis/blind/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/stats/median.hpp"
#include "core/stats/normal.hpp"

namespace drift::blind {
namespace {

using Scores = std::vector<TrialScore>;
using Condition = std::function<bool(const TrialScore&)>;

/// Of the trials in `group`, those for which `success` holds. Failed trials count as unsuccessful.
stats::Proportion share(const Scores& scores, const Condition& group, const Condition& success) {
  std::size_t k = 0, n = 0;
  for (const TrialScore& s : scores) {
    if (!group(s)) continue;
    ++n;
    if (success(s)) ++k;
  }
  return stats::proportion(k, n);
}

Condition in(Stratum stratum) {
  return [stratum](const TrialScore& s) { return s.key.plan.stratum == stratum; };
}
bool is_effect(const TrialScore& s) {
  return s.key.plan.stratum != Stratum::null && s.key.plan.stratum != Stratum::wrong_noise;
}
bool large_single(const TrialScore& s) {
  return s.key.plan.stratum == Stratum::single && s.size() >= eight_sigma;
}

bool detected(const TrialScore& s) {
  return s.detected;
}
bool exact(const TrialScore& s) {
  return s.exact;
}
bool exact_or_twin(const TrialScore& s) {
  return s.exact_or_twin;
}
bool in_set(const TrialScore& s) {
  return s.in_set;
}
bool subsystem(const TrialScore& s) {
  return s.subsystem;
}
bool wrong(const TrialScore& s) {
  return s.confidently_wrong;
}
bool false_alarm(const TrialScore& s) {
  return s.false_alarm;
}
bool unexplained(const TrialScore& s) {
  return s.unexplained;
}

/// Chance that one score of mean A beats the 5 % threshold of the largest of about 100 (11.6);
/// either sign.
double theory(double A) {
  const double k = std::sqrt(11.6);
  return stats::normal_distribution(A - k) + stats::normal_distribution(-A - k);
}

std::vector<PowerPoint> power_curve(const Scores& scores) {
  // Wide enough for a list of sizes and for sizes drawn evenly.
  const double edges[] = {0.0, 3.5, 4.5, 5.5, 6.5, eight_sigma, 9.0, 10.5, 12.5, 15.0, 1e9};
  std::vector<PowerPoint> points;
  for (std::size_t k = 0; k + 1 < std::size(edges); ++k) {
    const double low = edges[k], high = edges[k + 1];
    const Condition group = [low, high](const TrialScore& s) {
      return s.key.plan.stratum == Stratum::single && s.size() >= low && s.size() < high;
    };
    PowerPoint p{low,
                 high,
                 0.0,
                 share(scores, group, detected),
                 share(scores, group, exact),
                 share(scores, group, in_set),
                 share(scores, group, subsystem),
                 share(scores, group, wrong),
                 0.0};
    if (p.detected.n == 0) continue;
    for (const TrialScore& s : scores)
      if (group(s)) {
        p.mean += s.size() / static_cast<double>(p.detected.n);
        p.theory += theory(s.size()) / static_cast<double>(p.detected.n);
      }
    points.push_back(p);
  }
  return points;
}

std::vector<GroupScore> groups(const Scores& scores,
                               const std::function<std::string(const TrialScore&)>& name_of) {
  std::set<std::string> names;
  for (const TrialScore& s : scores) names.insert(name_of(s));
  std::vector<GroupScore> all;
  for (const std::string& name : names) {
    const Condition null = [&](const TrialScore& s) { return !is_effect(s) && name_of(s) == name; };
    const Condition large = [&](const TrialScore& s) {
      return large_single(s) && name_of(s) == name;
    };
    all.push_back({name, share(scores, null, false_alarm), share(scores, large, detected),
                   share(scores, large, exact), share(scores, large, in_set),
                   share(scores, large, subsystem), share(scores, large, wrong)});
  }
  return all;
}

/// Shares of a stratum by the kind of thing that was hidden.
std::vector<std::pair<std::string, stats::Proportion>> by_kind(const Scores& scores,
                                                               Stratum stratum,
                                                               const Condition& success) {
  std::set<std::string> kinds;
  for (const TrialScore& s : scores)
    if (s.key.plan.stratum == stratum && !s.key.effects.empty())
      kinds.insert(s.key.effects.front().term);
  std::vector<std::pair<std::string, stats::Proportion>> all;
  for (const std::string& kind : kinds)
    all.emplace_back(kind, share(
                               scores,
                               [&](const TrialScore& s) {
                                 return s.key.plan.stratum == stratum && !s.key.effects.empty() &&
                                        s.key.effects.front().term == kind;
                               },
                               success));
  return all;
}

Confusion confusion_of(const Scores& scores) {
  std::map<std::string, std::map<std::string, std::size_t>> count;
  std::set<std::string> columns;
  for (const TrialScore& s : scores) {
    ++count[s.hidden()][s.called];
    columns.insert(s.called);
  }
  Confusion c;
  c.columns.assign(columns.begin(), columns.end());
  for (const auto& [hidden, row] : count) {
    ConfusionRow r{hidden, std::vector<std::size_t>(c.columns.size(), 0)};
    for (std::size_t k = 0; k < c.columns.size(); ++k)
      if (const auto found = row.find(c.columns[k]); found != row.end())
        r.called[k] = found->second;
    c.rows.push_back(std::move(r));
  }
  return c;
}

stats::Proportion pulls_within(const std::vector<double>& pulls, double limit) {
  const auto k =
      std::count_if(pulls.begin(), pulls.end(), [&](double p) { return std::abs(p) <= limit; });
  return stats::proportion(static_cast<std::size_t>(k), pulls.size());
}

void add_targets(const Scores& scores, Summary& s) {
  const Condition at_eight = [](const TrialScore& t) {
    return t.key.plan.stratum == Stratum::single && t.size() >= eight_sigma && t.size() < 9.0;
  };
  const double none = 0.0, all = 1.0;
  s.targets = {
      {Goal::looks_healthy, s.concealed, 0.8, all},
      {Goal::alarm_on_null, share(scores, in(Stratum::null), false_alarm), none, 0.05},
      {Goal::alarm_on_noise, share(scores, in(Stratum::wrong_noise), false_alarm), none, 0.05},
      {Goal::detected_at_8_sigma, share(scores, at_eight, detected), 0.98, all},
      {Goal::in_set, share(scores, large_single, in_set), 0.95, all},
      {Goal::right_name, share(scores, large_single, exact), 0.75, all},
      {Goal::wrong_name, share(scores, large_single, wrong), none, 0.01},
      {Goal::pair_in_set, share(scores, in(Stratum::pair), in_set), 0.9, all},
      {Goal::outside_unexplained, share(scores, in(Stratum::outside), unexplained), 0.8, all},
      {Goal::size_within_two_sigma, pulls_within(s.pulls, 2.0), 0.91, 0.99}};
}

void add_further(const Scores& scores, Summary& s) {
  const auto add = [&](std::string name, stats::Proportion p) {
    s.further.emplace_back(std::move(name), p);
  };
  add("recovered parameter within 3 sigma", pulls_within(s.pulls, 3.0));
  add("8 sigma and above: exact, where an identical twin counts as the same cause",
      share(scores, large_single, exact_or_twin));
  Scores large;
  std::ranges::copy_if(scores, std::back_inserter(large), large_single);
  add("8 sigma and above: right, if all were named that one wrong name in 100 allows",
      right_if_named_by_probability(large, 0.01));
  add("8 sigma and above: right subsystem", share(scores, large_single, subsystem));
  add("8 sigma and above: right causes among others",
      share(scores, large_single, [](auto& t) { return t.extra; }));
  add("8 sigma and above: unexplained", share(scores, large_single, unexplained));
  add("pairs: detected", share(scores, in(Stratum::pair), detected));
  add("pairs: named exactly", share(scores, in(Stratum::pair), exact));
  add("pairs: named, or in a set of any size",
      share(scores, in(Stratum::pair), [](auto& t) { return t.offered; }));
  add("pairs that cancel (cosine < -0.3): pair or set",
      share(
          scores,
          [](auto& t) { return t.key.plan.stratum == Stratum::pair && t.key.cosine < -0.3; },
          in_set));
  add("outside the library: detected", share(scores, in(Stratum::outside), detected));
  add("outside the library: named as something else", share(scores, in(Stratum::outside), wrong));
  // What a library effect looks like to within a cosine of 0.9 may be taken for it.
  const auto unlike = [](const TrialScore& t) {
    return t.key.plan.stratum == Stratum::outside && t.key.effects.front().nearest_cosine < 0.9;
  };
  add("outside the library and unlike it (cosine < 0.9): unexplained",
      share(scores, unlike, unexplained));
  add("outside the library and unlike it: named as something else", share(scores, unlike, wrong));
  add("local: detected", share(scores, in(Stratum::local), detected));
  add("local: right position",
      share(scores, in(Stratum::local), [](auto& t) { return t.position_right; }));
  add("local: right equation",
      share(scores, in(Stratum::local), [](auto& t) { return t.equation_right; }));
  add("local: window overlaps by 0.6",
      share(scores, in(Stratum::local), [](auto& t) { return t.overlap >= 0.6; }));
  add("held-out prediction gains where named exactly",
      share(
          scores, [](auto& t) { return t.exact && t.answer.held_out; },
          [](auto& t) { return t.answer.held_out_gain > 0.0; }));
}

/// Trials that were asked for by number, where the effect is one that a test could show.
void add_harder(const Scores& scores, Summary& s) {
  const std::pair<Stratum, const char*> harder[] = {
      {Stratum::other_equation, "wrong nominal equation"},
      {Stratum::noisy_single, "effect beside undeclared noise"},
      {Stratum::noisy_covariate, "covariate with noise"}};
  for (const auto& [stratum, title] : harder) {
    const Stratum wanted = stratum;  // clang captures no binding
    const char* name = title;
    const auto group = [wanted](const TrialScore& t) {
      return t.key.plan.stratum == wanted && t.size() >= eight_sigma;
    };
    if (!std::ranges::any_of(scores, group)) continue;
    const auto add = [&](const char* what, bool (*success)(const TrialScore&)) {
      s.further.emplace_back(fmt::format("{}, 8 sigma and above: {}", name, what),
                             share(scores, group, success));
    };
    add("detected", detected);
    add("named exactly", exact);
    add("exactly or in a set of at most 3", in_set);
    add("a wrong name alone", wrong);
  }
}

}  // namespace

Summary summarise(const Scores& all) {
  Summary s;
  s.trials = all.size();
  std::vector<double> biases;
  Scores scores;  // targets are those of the trials that have shares
  for (const TrialScore& t : all) {
    s.failed += t.answer.failed;
    s.mean_seconds += t.answer.seconds / static_cast<double>(all.size());
    s.longest_seconds = std::max(s.longest_seconds, t.answer.seconds);
    if (!is_further(t.key.plan.stratum)) scores.push_back(t);
  }
  for (const TrialScore& t : scores) {
    for (const Pull& p : t.pulls) s.pulls.push_back(p.pull());
    if (is_effect(t)) biases.push_back(t.key.certificate.largest_bias);
  }
  std::vector<double> sizes;
  for (const double p : s.pulls) sizes.push_back(std::abs(p));
  s.pull_rms = 1.4826 * stats::upper_median(sizes);
  s.largest_bias_median = stats::upper_median(biases);
  s.concealed =
      share(scores, is_effect, [](const TrialScore& t) { return t.key.certificate.concealed; });
  s.power = power_curve(scores);
  s.plans = groups(scores, [](const TrialScore& t) { return t.key.plan.plan; });
  s.couplings =
      groups(scores, [](const TrialScore& t) { return std::string(key_of(t.key.plan.coupling)); });
  s.modes =
      groups(scores, [](const TrialScore& t) { return std::string(key_of(t.key.plan.mode)); });
  s.wrong_noise = by_kind(scores, Stratum::wrong_noise, false_alarm);
  s.outside = by_kind(scores, Stratum::outside, unexplained);
  s.confusion = confusion_of(scores);
  s.reliability = reliability_of(scores);
  add_targets(scores, s);
  add_further(scores, s);
  add_harder(all, s);
  return s;
}

}  // namespace drift::blind
