#include "analysis/diagnosis/sentence.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/number_text.hpp"

namespace drift::diagnosis {
namespace {

constexpr double one_direction =
    0.999;  // squared cosine above which two signatures leave the same trace
constexpr std::size_t most_numbers = 3;

std::string keyed(std::string_view term, std::string_view axis) {
  return axis.empty() ? std::string(term) : fmt::format("{}.{}", term, axis);
}

/// "a", "a and b", "a, b and c".
std::string listed(const std::vector<std::string>& items, std::string_view last) {
  if (items.size() < 2) return items.empty() ? "" : items.front();
  return fmt::format("{} {} {}", fmt::join(items.begin(), items.end() - 1, ", "), last,
                     items.back());
}

/// What an axis of a term belongs to: "gyro y", "accelerometer y", "axis y", "outer gimbal".
std::string part_of(const TermInfo& term, std::string_view axis) {
  if (axis.size() > 1) return fmt::format("{} gimbal", axis);
  if (term.in_readout) return fmt::format("accelerometer {}", axis);
  if (term.in_offset || term.in_gimbals || term.key == "base_motion_leak")
    return fmt::format("platform axis {}", axis);
  return fmt::format("gyro {}", axis);
}

/// Distance of a found number from its prior's mean, in sigmas of the prior; 0 of what was
/// profiled.
double in_prior_sigmas(const search::CauseParameter& p) {
  const ParamSpec& spec = TermLibrary::specs[p.param];
  const double sigma = spec.prior.sigma();
  return p.profiled || !(sigma > 0.0) ? 0.0 : std::abs(p.value - spec.prior.mean()) / sigma;
}

std::string number_of(const search::CauseParameter& p) {
  return fmt::format("{} = {}{}{}", p.key, with_sigma(p.value, p.sigma), p.unit == "1" ? "" : " ",
                     p.unit == "1" ? "" : p.unit);
}

/// The shape of the strongest recovered signal, its equation said where it is not the one located.
std::string shape_text(const Diagnosis& d) {
  if (d.signals.empty() || d.signals.front().shape.empty()) return "";
  const RecoveredSignal& s = d.signals.front();
  const std::string head = s.equation + ": ";
  const std::string shape = s.shape.starts_with(head) ? s.shape.substr(head.size()) : s.shape;
  if (s.equation == d.where.equation) return ": " + shape;
  return fmt::format(". As an input to the {}: {}", equation_in_words(s.equation), shape);
}

/// What stands in the brackets behind a cause.
std::string numbers_of(const search::Cause& c) {
  std::string text = keyed(c.term, c.axis);
  if (c.parameters.empty()) return text;
  if (c.parameters.size() > most_numbers) {
    const auto largest = std::ranges::max_element(c.parameters, {}, in_prior_sigmas);
    return text + fmt::format(": {} and {} more", number_of(*largest), c.parameters.size() - 1);
  }
  std::vector<std::string> numbers;
  for (const search::CauseParameter& p : c.parameters) numbers.push_back(number_of(p));
  text += fmt::format(": {}", fmt::join(numbers, ", "));
  const search::CauseParameter& p = c.parameters.front();
  if (c.term == "frame_closure")  // between two equations the interval is the answer
    text += fmt::format(", 95 % interval {:.3g} to {:.3g}, where eq. (5) is 0 and eq. (6) is 1",
                        p.value - 1.96 * p.sigma, p.value + 1.96 * p.sigma);
  return text;
}

/// Words with something in brackets behind; brackets at their end take it in.
std::string with_brackets(std::string words, const std::string& inside) {
  if (!words.ends_with(')')) return fmt::format("{} ({})", words, inside);
  words.pop_back();
  return fmt::format("{}; {})", words, inside);
}

/// Causes that act together are one alternative.
using Alternative = std::vector<std::size_t>;  // indices into Diagnosis::causes

std::vector<Alternative> alternatives_of(const Diagnosis& d) {
  std::vector<Alternative> all;
  for (std::size_t k = 0; k < d.causes.size(); ++k) {
    if (k == 0 || d.causes[k].set != d.causes[k - 1].set) all.emplace_back();
    all.back().push_back(k);
  }
  return all;
}

bool same_trace(const Diagnosis& d, std::size_t i, std::size_t k) {
  if (d.causes[i].term == d.causes[k].term && d.causes[i].axis == d.causes[k].axis) return true;
  const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(k);
  const MatX& cosine = d.cosines.cosine;
  return a < cosine.rows() && b < cosine.cols() &&
         cosine(a, b) * cosine(a, b) > one_direction;
}

bool same_trace(const Diagnosis& d, const Alternative& one, const Alternative& other) {
  const auto met_in = [&](const Alternative& there) {
    return [&](std::size_t i) {
      return std::ranges::any_of(there, [&](std::size_t k) { return same_trace(d, i, k); });
    };
  };
  return std::ranges::all_of(one, met_in(other)) && std::ranges::all_of(other, met_in(one));
}

/// The alternatives that no data of this plan tells apart: " (1) and (2) leave the same trace on
/// this plan."
std::string twins_text(const Diagnosis& d, const std::vector<Alternative>& all) {
  std::vector<bool> said(all.size(), false);
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<std::string> group{fmt::format("({})", i + 1)};
    for (std::size_t k = i + 1; k < all.size() && !said[i]; ++k)
      if (!said[k] && same_trace(d, all[i], all[k])) {
        group.push_back(fmt::format("({})", k + 1));
        said[k] = true;
      }
    if (group.size() > 1)
      text += fmt::format(" {} leave the same trace on this plan.", listed(group, "and"));
  }
  return text;
}

/// What leaves the same trace as a cause and is no part of the verdict. A candidate of all axes of
/// a term is passed over for the one axis of it that does.
std::string outside_twins_text(const Diagnosis& d) {
  std::string text;
  for (const search::Cause& c : d.causes)
    for (const search::Confusable& o : c.confusable_with) {
      const bool among =
          std::ranges::any_of(d.causes, [&](const search::Cause& k) { return k.term == o.term; });
      const bool narrower =
          o.axis.empty() &&
          std::ranges::any_of(c.confusable_with, [&](const search::Confusable& k) {
            return k.term == o.term && !k.axis.empty() && k.cosine * k.cosine > one_direction;
          });
      if (o.cosine * o.cosine <= one_direction || among || narrower) continue;
      const auto line = fmt::format(" On this plan {} ({}) and {} ({}) leave the same trace.",
                                    in_words(c.term, c.axis), keyed(c.term, c.axis),
                                    in_words(o.term, o.axis), keyed(o.term, o.axis));
      if (text.find(line) == std::string::npos) text += line;
    }
  return text;
}

std::string together(const Diagnosis& d, const Alternative& causes) {
  std::vector<std::string> words;
  for (const std::size_t k : causes) words.push_back(in_words(d.causes[k]));
  return fmt::format("{}", fmt::join(words, " together with "));
}

std::string noise_text(const Diagnosis& d) {
  std::vector<std::string> parts;
  for (const inference::NoiseFinding& f : d.noise)
    if (f.significant && f.component != "outliers")
      parts.push_back(fmt::format("{} ({}: {})", noise_in_words(f.component), f.component,
                                  std::isfinite(f.factor)
                                      ? fmt::format("{:.2f} times as declared", f.factor)
                                      : fmt::format("{:.2g} {}", f.value, f.unit)));
  return parts.empty() ? ""
                       : fmt::format(" The noise is not as declared: {}.", listed(parts, "and"));
}

std::string held_out_text(const HeldOut& held, bool several) {
  if (held.folds.empty() && held.recordings.empty())
    return "nothing was held out of the fit to judge it";
  return fmt::format("with {}, held-out positions are predicted {}", several ? "them" : "it",
                     held.improves ? "better" : "no better");
}

std::string ambiguous_text(const Diagnosis& d) {
  const std::string missing =
      fmt::format("Something is missing from the nominal model (chance of a false alarm: {})",
                  p_text(d.p_value));
  const auto all = alternatives_of(d);
  if (all.empty()) return missing + ", and this plan cannot tell what.";
  if (all.size() == 1)
    return fmt::format("{}; it may be {}, but {}.", missing, together(d, all.front()),
                       held_out_text(d.fit.held_out, all.front().size() > 1));
  std::vector<std::string> words;
  for (std::size_t k = 0; k < all.size(); ++k)
    words.push_back(fmt::format("({}) {}", k + 1, together(d, all[k])));
  return fmt::format("{}, and this plan cannot tell which: either {}.{}", missing,
                     fmt::join(words, ", or "), twins_text(d, all));
}

}  // namespace

std::string in_words(std::string_view term, std::string_view axis) {
  if (term == "frame_closure") return "another drift equation";
  const auto known = TermLibrary::find_term(term);
  if (!known) return keyed(term, axis);
  const TermInfo& info = TermLibrary::terms[*known];
  return axis.empty() ? std::string(info.title)
                      : fmt::format("{}, {}", info.title, part_of(info, axis));
}

std::string in_words(const search::Cause& c) {
  return with_brackets(in_words(c.term, c.axis), numbers_of(c));
}

std::string equation_in_words(const std::string& equation) {
  constexpr std::string_view gimbal = "gimbal ";
  return equation.starts_with(gimbal) ? equation.substr(gimbal.size()) + " gimbal" : equation;
}

std::string lacking(const std::vector<search::Cause>& causes) {
  std::vector<std::string> effects;
  std::string equation;
  for (const search::Cause& c : causes)
    if (c.term == "frame_closure")
      equation = fmt::format(" has the wrong drift equation ({})", numbers_of(c));
    else
      effects.push_back(in_words(c));
  const std::string lacks = effects.empty() ? "" : fmt::format(" lacks {}", listed(effects, "and"));
  return fmt::format("The nominal model{}{}{}", equation,
                     equation.empty() || lacks.empty() ? "" : " and", lacks);
}

std::string noise_in_words(const std::string& component) {
  constexpr std::pair<std::string_view, std::string_view> known[] = {
      {"gimbal_white", "white noise of the gimbal readout"},
      {"accelerometer_white", "white noise of the accelerometers"},
      {"angle_random_walk", "angle random walk of the gyros"},
      {"drift_random_walk", "random walk of the gyro drift"},
      {"markov_drift", "slowly wandering gyro drift"},
      {"accelerometer_markov", "slowly wandering accelerometer error"},
      {"outliers", "isolated wrong samples"}};
  for (const auto& [key, words] : known)
    if (key == component) return std::string(words);
  return component;
}

std::string patch_text(const Diagnosis& d) {
  const auto all = alternatives_of(d);
  if (d.verdict != Verdict::ambiguous || !d.has_patch || all.empty()) return "";
  const std::string words = together(d, all.front());
  if (all.size() == 1)
    return fmt::format(
        "The patched model (patched.toml) holds the only cause that was found, {}: it is not "
        "confirmed.",
        words);
  const double probability = d.causes.front().probability;
  const std::string odds = std::isfinite(probability)
                               ? fmt::format(", probability {}", decimal_text(probability, 2))
                               : "";
  return fmt::format(
      "The patched model (patched.toml) holds alternative (1) alone, the most probable of {}{}: "
      "{}. The data do not single it out: "
      "its parameters are right only if this is the cause.",
      all.size(), odds, words);
}

std::string sentence(const Diagnosis& d) {
  const std::string noise = noise_text(d),
                    false_alarm = fmt::format("chance of a false alarm: {}", p_text(d.p_value));
  switch (d.verdict) {
    case Verdict::consistent:
      return fmt::format(
          "The recording agrees with the nominal model; no missing physics is found (noise alone "
          "shows as "
          "much with a chance of {}).{}",
          p_text(d.p_value), noise);
    case Verdict::named:
      return fmt::format("{}; {} ({}).{}{}", lacking(d.causes),
                         held_out_text(d.fit.held_out, d.causes.size() > 1), false_alarm,
                         outside_twins_text(d), noise);
    case Verdict::ambiguous:
      return ambiguous_text(d) + outside_twins_text(d) + noise;
    case Verdict::unexplained:
      break;
  }
  return fmt::format(
      "Something is missing from the nominal model ({}) and no known effect explains it; it sits "
      "in the {}{}.{}",
      false_alarm,
      d.where.equation.empty() ? "test as a whole" : equation_in_words(d.where.equation),
      shape_text(d), noise);
}

}  // namespace drift::diagnosis
