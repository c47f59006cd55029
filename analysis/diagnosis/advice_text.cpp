#include "analysis/diagnosis/advice_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace drift::diagnosis {
namespace {

constexpr std::size_t most_shown = 8;

/// The rival is the nominal model as it is: what is asked is whether the effect is seen.
bool against_nominal(const Question& q, const Contest& pair) {
  return q.alternatives[pair.rival].causes.empty() &&
         !q.alternatives[pair.rival].label.starts_with("eq.");
}

std::string pair_text(const Question& q, const Contest& pair, std::string_view between = " from ") {
  const std::string& truth = q.alternatives[pair.truth].label;
  return against_nominal(q, pair)
             ? truth
             : fmt::format("{}{}{}", truth, between, q.alternatives[pair.rival].label);
}

/// "a, b, c and 4 more"; each once, whichever way round.
std::string listed(const Question& q, const std::vector<Contest>& pairs, std::string_view between) {
  std::vector<std::string> texts;
  std::set<std::pair<std::string, std::string>> said;
  for (const Contest& p : pairs) {
    const std::string &a = q.alternatives[p.truth].label, &b = q.alternatives[p.rival].label;
    if (said.insert(std::minmax(a, b)).second) texts.push_back(pair_text(q, p, between));
  }
  if (texts.size() <= most_shown) return fmt::format("{}", fmt::join(texts, ", "));
  const std::size_t more = texts.size() - most_shown;
  texts.resize(most_shown);
  return fmt::format("{} and {} more", fmt::join(texts, ", "), more);
}

std::string sized(const Question& q) {
  return q.size.empty() ? "" : ", " + q.size + ",";
}

}  // namespace

std::vector<std::string> labels_of(const Question& q, const std::vector<Contest>& pairs) {
  std::vector<std::string> labels;
  for (std::size_t k = 0; k < q.alternatives.size(); ++k) {
    const auto holds = [&](const Contest& p) { return p.truth == k || p.rival == k; };
    if (!std::ranges::any_of(pairs, holds)) continue;
    if (std::ranges::find(labels, q.alternatives[k].label) == labels.end())
      labels.push_back(q.alternatives[k].label);
  }
  return labels;
}

std::string helped_text(const Advice& a, const Question& q, const std::vector<Helped>& helped,
                        std::size_t asked, double wanted) {
  std::vector<std::string> names;
  for (const Position& p : a.plan) names.push_back(p.name.substr(p.name.find(": ") + 2));
  const std::string verified = std::isfinite(a.verified_sigma)
                                   ? fmt::format(" (in a simulation: {:.1f})", a.verified_sigma)
                                   : "";
  const std::string enough = a.expected_sigma < wanted ? ", which is not enough" : "";
  std::vector<Helped> ways;  // either may be true: the way round that ends closest
  for (const Helped& h : helped)
    if (std::ranges::none_of(ways, [&](const Helped& w) {
          return w.pair.truth == h.pair.rival && w.pair.rival == h.pair.truth;
        }))
      ways.push_back(h);
  if (ways.size() == 1) {
    const Helped& h = ways.front();
    return fmt::format(
        "{} and {}{} are {:.1f} sigma apart on this plan. Add {}: then {:.1f} sigma{}{}.",
        q.alternatives[h.pair.truth].label, q.alternatives[h.pair.rival].label, sized(q),
        a.now_sigma, fmt::join(names, "; "), a.expected_sigma, verified, enough);
  }
  std::vector<std::string> shown;
  std::vector<Helped> hardest = ways;
  std::ranges::stable_sort(hardest, {}, &Helped::now);
  for (const Helped& h : hardest)
    if (shown.size() < most_shown)
      shown.push_back(fmt::format("{} {:.1f} to {:.1f}", pair_text(q, h.pair), h.now, h.after));
  const auto reached =
      std::ranges::count_if(ways, [&](const Helped& h) { return h.after >= wanted; });
  const std::string state =
      q.size.empty() ? fmt::format("Of {} pairs, {} are less than {:g} sigma apart on this plan",
                                   asked, ways.size(), wanted)
                     : fmt::format(
                           "Of {} effects {}, {} show with less than {:g} sigma on this plan and "
                           "with more on another",
                           asked, q.size, ways.size(), wanted);
  return fmt::format(
      "{}. Add {}: then {} of them come above {:g} sigma and {} stay between 2 and {:g}. Hardest "
      "now, in sigma before and "
      "after: {}. The last comes to {:.1f}: {}{}.",
      state, fmt::join(names, "; "), reached, wanted,
      static_cast<std::ptrdiff_t>(ways.size()) - reached, wanted, fmt::join(shown, ", "),
      a.expected_sigma, pair_text(q, helped.front().pair), verified);
}

std::string twins_text(const Question& q, const std::vector<Contest>& pairs) {
  return fmt::format(
      "No position of the pool separates {}: they leave the same trace in all of them. Another "
      "measurement is needed, "
      "of one of them by itself (a bench test of the instrument, say); more positions are futile.",
      listed(q, pairs, " and "));
}

std::string hidden_text(const Question& q, const std::vector<Contest>& pairs, std::size_t most,
                        std::size_t pool) {
  std::vector<Contest> unseen, near;
  for (const Contest& p : pairs) (against_nominal(q, p) ? unseen : near).push_back(p);
  std::string text;
  if (!unseen.empty())
    text = fmt::format(
        "No {} of {} possible additions show {}{}{} with 2 sigma: what the nominal model fits "
        "takes the trace, or it "
        "is too small for these instruments.",
        most, pool, listed(q, unseen, ""), q.size.empty() ? "" : " ", q.size);
  if (!near.empty())
    text += fmt::format(
        "{}No {} of {} possible additions separate {}{}{} by 2 sigma: another measurement is "
        "needed.",
        text.empty() ? "" : " ", most, pool, listed(q, near, " from "), q.size.empty() ? "" : " ",
        q.size);
  return text;
}

std::string told_text(const Question& q, const Contest& closest, double sigma) {
  return fmt::format(
      "Nothing needs to be added: {} this plan tells {} by {:.1f} sigma, and that is the closest.",
      q.size.empty() ? "at the sizes found" : q.size, pair_text(q, closest), sigma);
}

std::string nothing_alike_text(const Question& q) {
  return fmt::format(
      "Nothing needs to be added: no other candidate leaves a trace like that of {} on this plan.",
      q.alternatives.front().label);
}

std::string unexplained_text(const Diagnosis& d, const TestPlan& plan) {
  std::string where;
  for (const Share& s : d.where.positions)
    if (where.empty() && s.position >= 1 &&
        static_cast<std::size_t>(s.position) <= plan.positions.size())
      where = fmt::format(
          "Repeat position {} ('{}'), where most of the misfit sits: if the signal comes again it "
          "belongs to the "
          "attitude, if not to the hour.",
          s.position, plan.positions[static_cast<std::size_t>(s.position) - 1].name);
  return fmt::format(
      "No known effect explains the misfit, so there are no candidates to tell apart. {}", where);
}

Advice text_alone(std::string text) {
  Advice a;
  a.text = std::move(text);
  a.expected_sigma = a.now_sigma = a.verified_sigma = std::nan("");
  return a;
}

}  // namespace drift::diagnosis
