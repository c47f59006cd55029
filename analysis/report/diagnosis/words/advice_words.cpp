#include "analysis/report/diagnosis/words/advice_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "analysis/inference/thresholds.hpp"
#include "analysis/planning/position_pool.hpp"
#include "core/base/words.hpp"
#include "core/physics/own/own_terms.hpp"

namespace drift::report {
namespace {

using diagnosis::Advice;
using diagnosis::AdvisedPair;
using diagnosis::Alternative;
using diagnosis::Sizes;
using inference::AdviceLimits;

constexpr std::size_t most_shown = 8;
constexpr std::size_t most_in_brief = 2;  // more have no room in four lines

/// "magnetic_drift.y", "g2_drift (D_IS_x)": one parameter tells more than its term.
std::string cause_text(const search::Cause& c) {
  const auto linear = std::count_if(c.parameters.begin(), c.parameters.end(),
                                    [](const search::CauseParameter& p) { return !p.profiled; });
  const std::string own =
      linear == 1 && !c.parameters.empty() && !c.parameters[0].key.starts_with(c.term)
          ? fmt::format(" ({})", c.parameters[0].key)
          : "";
  return search::keyed(c.term, c.axis) + own;
}

std::string alternative_text(const Alternative& a) {
  if (a.kind == Alternative::Kind::nominal) return "the nominal model";
  if (a.kind == Alternative::Kind::equation)
    return fmt::format("eq. ({})", facts(a.equation).number);
  if (!a.asked.empty()) return a.asked;
  std::string label;
  for (const search::Cause& c : a.causes) label += (label.empty() ? "" : " + ") + cause_text(c);
  return label;
}

/// What a cause follows that varies while a test runs: "temperature", a column of the recording.
std::string_view followed_by(const Alternative& a) {
  CovariateSet set = 0;
  for (const search::Cause& c : a.causes)
    if (const auto term = TermLibrary::find_term(c.term))
      set |= TermLibrary::terms[*term].needs.covariates & varying_covariates;
  for (const CovariateSpec& c : known_covariates)
    if ((set & c.set()) != 0) return c.what;
  for (std::size_t k = 0; k < own_terms().covariates.size(); ++k)
    if ((set & further_column(k)) != 0) return own_terms().covariates[k];
  return "surroundings";
}

const Alternative& truth_of(const Advice& a, const AdvisedPair& p) {
  return a.alternatives[p.pair.truth];
}
const Alternative& rival_of(const Advice& a, const AdvisedPair& p) {
  return a.alternatives[p.pair.rival];
}

/// Whether the effect is seen at all is what is asked.
bool against_nominal(const Advice& a, const AdvisedPair& p) {
  return rival_of(a, p).kind == Alternative::Kind::nominal;
}

std::string pair_text(const Advice& a, const AdvisedPair& p, std::string_view between = " from ") {
  const std::string truth = alternative_text(truth_of(a, p));
  return against_nominal(a, p)
             ? truth
             : fmt::format("{}{}{}", truth, between, alternative_text(rival_of(a, p)));
}

/// "a, b, c and 4 more"; each once, whichever way round.
std::string pairs_in_words(const Advice& a, const std::vector<AdvisedPair>& pairs,
                           std::string_view between, std::size_t most = most_shown) {
  std::vector<std::string> texts;
  std::set<std::pair<std::string, std::string>> said;
  for (const AdvisedPair& p : pairs) {
    std::pair labels{alternative_text(truth_of(a, p)), alternative_text(rival_of(a, p))};
    if (labels.second < labels.first) std::swap(labels.first, labels.second);
    if (said.insert(std::move(labels)).second) texts.push_back(pair_text(a, p, between));
  }
  return listed_up_to(texts, most);
}

/// How large the effects are, "at one prior sigma"; empty: as found.
std::string_view size_text(Sizes sizes) {
  switch (sizes) {
    case Sizes::as_found:
      break;
    case Sizes::one_prior_sigma:
      return "at one prior sigma";
    case Sizes::as_found_or_one_prior_sigma:
      return "at the sizes found, others at one prior sigma";
  }
  return "";
}

std::string before_it(std::string_view head, std::string_view text) {
  return text.empty() ? "" : fmt::format("{}{}", head, text);
}

std::string plan_text(const Advice& a) {
  std::vector<std::string> all;
  for (const Position& p : a.plan) all.push_back(planning::description(p, a.usual_dwell));
  return fmt::format("{}", fmt::join(all, "; "));
}

/// The same where there is room for a few lines.
std::string plan_in_brief(const Advice& a) {
  return a.plan.size() <= most_in_brief
             ? plan_text(a)
             : fmt::format("{} positions, which --full lists", a.plan.size());
}

/// What a plan does for one pair. beside: what is said with how it is now.
std::string helped_pair(const Advice& a, const AdvisedPair& p, const std::string& positions,
                        const std::string& verified, std::string_view beside) {
  const std::string size = before_it(", ", size_text(a.sizes));
  return fmt::format(
      "{} and {}{} are {:.1f} sigma apart on this plan{}. Add {}: then {:.1f} sigma{}{}.",
      alternative_text(truth_of(a, p)), alternative_text(rival_of(a, p)),
      size.empty() ? "" : size + ",", a.now_sigma, beside, positions, a.expected_sigma, verified,
      a.expected_sigma < a.wanted ? ", which is not enough" : "");
}

std::string helped_text(const Advice& a, const std::string& positions,
                        std::string_view beside = "") {
  const std::string verified = std::isfinite(a.verified_sigma)
                                   ? fmt::format(" (in a simulation: {:.1f})", a.verified_sigma)
                                   : "";
  std::vector<AdvisedPair> ways;  // either may be true: the way round that ends closest
  for (const AdvisedPair& p : a.pairs)
    if (std::none_of(ways.begin(), ways.end(), [&](const AdvisedPair& w) {
          return w.pair.truth == p.pair.rival && w.pair.rival == p.pair.truth;
        }))
      ways.push_back(p);
  if (ways.size() == 1) return helped_pair(a, ways.front(), positions, verified, beside);
  std::vector<AdvisedPair> hardest = ways;
  std::stable_sort(hardest.begin(), hardest.end(),
                   [](const AdvisedPair& x, const AdvisedPair& y) { return x.now < y.now; });
  std::vector<std::string> shown;
  for (const AdvisedPair& p : hardest)
    if (shown.size() < most_shown)
      shown.push_back(fmt::format("{} {:.1f} to {:.1f}", pair_text(a, p), p.now, p.after));
  const auto reached = std::count_if(ways.begin(), ways.end(),
                                     [&](const AdvisedPair& p) { return p.after >= a.wanted; });
  const std::string names = listed_up_to(a.names, most_shown);
  const std::string state =
      a.sizes == Sizes::as_found
          ? fmt::format(
                "Of {} pairs, {} are less than {:g} sigma apart on this plan and more on another",
                a.asked, ways.size(), a.wanted)
      : !names.empty()
          ? fmt::format(
                "{}, {}: of {} pairs with them, {} are less than {:g} sigma apart on this plan and "
                "more on another",
                names, size_text(a.sizes), a.asked, ways.size(), a.wanted)
          : fmt::format(
                "Of {} effects {}, {} show with less than {:g} sigma on this plan and with more "
                "on another",
                a.asked, size_text(a.sizes), ways.size(), a.wanted);
  const auto short_of_it = static_cast<std::ptrdiff_t>(ways.size()) - reached;
  return fmt::format(
      "{}{}. Add {}: then {} of them come above {:g} sigma{}. Hardest now, in sigma before and "
      "after: {}. The last comes to {:.1f}: {}{}.",
      state, beside, positions, reached, a.wanted,
      short_of_it == 0 ? ""
                       : fmt::format(" and {} stay between {:g} and {:g}", short_of_it,
                                     AdviceLimits::told, a.wanted),
      fmt::join(shown, ", "), a.expected_sigma, pair_text(a, a.pairs.front()), verified);
}

std::string hidden_text(const Advice& a) {
  std::vector<AdvisedPair> unseen, near;
  for (const AdvisedPair& p : a.pairs) (against_nominal(a, p) ? unseen : near).push_back(p);
  const std::string size = before_it(" ", size_text(a.sizes));
  // Where no position may be added there is none to count.
  const std::string additions = a.pool > 0
                                    ? fmt::format("No {} of {} possible additions", a.most, a.pool)
                                    : "No additions to this plan";
  std::string text;
  if (!unseen.empty())
    text = fmt::format(
        "{} show {}{} with {:g} sigma: what the nominal model fits "
        "takes "
        "the trace, or it is too small for these instruments.",
        additions, pairs_in_words(a, unseen, ""), size, AdviceLimits::told);
  if (!near.empty())
    text += fmt::format(
        "{}{} separate {}{} by {:g} sigma: another measurement is "
        "needed.",
        text.empty() ? "" : " ", additions, pairs_in_words(a, near, " from "), size,
        AdviceLimits::told);
  return text;
}

std::string repeat_text(const Advice& a) {
  std::string text =
      "No known effect explains the misfit, so there are no candidates to tell apart.";
  if (a.position > 0)
    text += fmt::format(
        " Repeat position {} ('{}'), where most of the misfit sits: if the signal comes again it "
        "belongs to the attitude, if not to the hour.",
        a.position, a.position_name);
  return text;
}

}  // namespace

std::string advice_text(const Advice& a) {
  switch (a.kind) {
    case Advice::Kind::add:
      return helped_text(a, plan_text(a));
    case Advice::Kind::told:
      return fmt::format(
          "Nothing needs to be added: {} this plan tells {} by {:.1f} sigma, and that is the "
          "closest.",
          a.sizes == Sizes::as_found ? "at the sizes found" : size_text(a.sizes),
          pair_text(a, a.pairs.front()), a.pairs.front().now);
    case Advice::Kind::unlike:
      return fmt::format(
          "Nothing needs to be added: no other candidate leaves a trace like that of {} on this "
          "plan.",
          alternative_text(a.alternatives.front()));
    case Advice::Kind::twins:
      return fmt::format(
          "No position of the pool separates {}: they leave the same trace in all of them. Another "
          "measurement is needed, of one of them by itself (a bench test of the instrument, say); "
          "more positions are futile.",
          pairs_in_words(a, a.pairs, " and "));
    case Advice::Kind::hidden:
      return hidden_text(a);
    case Advice::Kind::varies: {
      const std::string_view what = followed_by(a.alternatives.front());
      return fmt::format(
          "Nothing can be added: {} follows the {}, and positions are planned at one {}. Let it "
          "vary within the dwells and record it.",
          alternative_text(a.alternatives.front()), what, what);
    }
    case Advice::Kind::repeat:
      break;
  }
  return repeat_text(a);
}

std::string advice_in_brief(const Advice& a) {
  return a.kind == Advice::Kind::add ? helped_text(a, plan_in_brief(a)) : advice_text(a);
}

std::string advice_in_brief(const std::vector<Advice>& all) {
  if (all.empty()) return "";
  std::vector<std::string> together;
  for (const Advice& a : std::span(all).subspan(1))
    if (a.kind == Advice::Kind::twins && a.sizes != Sizes::one_prior_sigma)
      together.push_back("no position separates " +
                         pairs_in_words(a, a.pairs, " and ", most_in_brief));
    else if (a.kind == Advice::Kind::hidden && a.sizes == Sizes::as_found)
      together.push_back("no addition separates " +
                         pairs_in_words(a, a.pairs, " from ", most_in_brief));
  const Advice& first = all.front();
  if (together.empty()) return advice_in_brief(first);
  // Before what is to be added: of what is longer than four lines the end is left off.
  const std::string text = fmt::format("{}", fmt::join(together, ", and "));
  return first.kind == Advice::Kind::add
             ? helped_text(first, plan_in_brief(first), "; " + text)
             : fmt::format("{} N{}.", advice_in_brief(first), text.substr(1));
}

std::vector<std::string> advised_labels(const Advice& a) {
  std::vector<std::string> labels;
  for (std::size_t k = 0; k < a.alternatives.size(); ++k) {
    const auto holds = [&](const AdvisedPair& p) { return p.pair.truth == k || p.pair.rival == k; };
    if (std::none_of(a.pairs.begin(), a.pairs.end(), holds)) continue;
    const std::string label = alternative_text(a.alternatives[k]);
    if (std::find(labels.begin(), labels.end(), label) == labels.end()) labels.push_back(label);
  }
  return labels;
}

}  // namespace drift::report
