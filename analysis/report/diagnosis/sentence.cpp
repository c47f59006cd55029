#include "analysis/report/diagnosis/sentence.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "analysis/identification/absent_channels.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/report/diagnosis/doubts.hpp"
#include "analysis/report/diagnosis/not_examined_words.hpp"
#include "analysis/report/diagnosis/remark_words.hpp"
#include "analysis/report/diagnosis/too_large.hpp"
#include "core/base/number_text.hpp"
#include "core/base/words.hpp"
#include "core/stats/normal.hpp"

namespace drift::report {
namespace {

using namespace diagnosis;

/// The shape of the strongest recovered signal, its equation said where it is not the one located;
/// a form that fits says more.
std::string located_shape_text(const Diagnosis& d) {
  if (d.proposal || d.signals.empty() || d.signals.front().shape.kind == Shape::Kind::unknown)
    return "";
  const RecoveredSignal& s = d.signals.front();
  if (s.equation == d.where.equation) return ": " + shape_text(s);
  return fmt::format(". As an input to the {}: {}", equation_in_words(s.equation), shape_text(s));
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
  return a < cosine.rows() && b < cosine.cols() && inference::same_trace(cosine(a, b));
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

/// Whether a cause that was fitted with several sizes is one with another effect in all of them.
bool one_in_all(const Diagnosis& d, const search::Cause& c, const search::Confusable& o) {
  if (std::ranges::count(c.parameters, false, &search::CauseParameter::profiled) < 2) return true;
  return std::ranges::any_of(d.inseparable, [&](const Twins& t) {
    return t.one.term == c.term && t.one.axis == c.axis && t.other.term == o.term &&
           t.other.axis == o.axis;
  });
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
            return k.term == o.term && !k.axis.empty() && inference::same_trace(k.cosine);
          });
      if (!inference::same_trace(o.cosine) || among || narrower || !one_in_all(d, c, o)) continue;
      const auto line =
          fmt::format(" On this plan {} ({}) and {} ({}) leave the same trace.",
                      in_words(c.term, c.axis, instrument_of(d)), search::keyed(c.term, c.axis),
                      in_words(o.term, o.axis, instrument_of(d)), search::keyed(o.term, o.axis));
      if (text.find(line) == std::string::npos) text += line;
    }
  return text;
}

std::string together(const Diagnosis& d, const Alternative& causes) {
  std::vector<std::string> words;
  for (const std::size_t k : causes) words.push_back(in_words(d.causes[k], instrument_of(d)));
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

std::string held_out_text(const Diagnosis& d, bool several) {
  const HeldOut& held = d.fit.held_out;
  if (held.folds.empty() && held.recordings.empty())
    return "nothing was held out of the fit to judge it";
  return fmt::format("with {}, held-out {} are predicted {}", several ? "them" : "it",
                     d.of_case ? "dwells" : "positions", held.improves ? "better" : "no better");
}

template <class R>
bool remarked(const Diagnosis& d) {
  return std::ranges::any_of(d.remarks,
                             [](const Remark& r) { return std::holds_alternative<R>(r); });
}

/// Beside a cause, where what the library does not know is more probable than not.
std::string outside_text(const Diagnosis& d) {
  const double outside = d.probabilities.outside;
  if (d.causes.empty() || outside <= inference::SearchLimits::chance) return "";
  return fmt::format(
      " Something that no term describes, in one stretch of the test perhaps, would explain it as "
      "well (probability {}).",
      decimal_text(outside, 2));
}

/// Why the only cause that was found is not named.
std::string not_confirmed_text(const Diagnosis& d, bool several) {
  if (remarked<remark::JustSignificantLeft>(d))
    return fmt::format("with {} something is left that is just significant",
                       several ? "them" : "it");
  if (several && remarked<remark::MemberNotConfirmed>(d))
    return "held-out data do not ask for each of them";
  return held_out_text(d, several);
}

std::string ambiguous_text(const Diagnosis& d) {
  const std::string missing =
      fmt::format("Something is missing from the nominal model (chance of a false alarm: {})",
                  p_text(d.p_value));
  const auto all = alternatives_of(d);
  if (all.empty()) return missing + ", and this plan cannot tell what.";
  if (all.size() == 1)
    return fmt::format("{}; it may be {}, but {}.", missing, together(d, all.front()),
                       not_confirmed_text(d, all.front().size() > 1));
  std::vector<std::string> words;
  for (std::size_t k = 0; k < all.size(); ++k)
    words.push_back(fmt::format("({}) {}", k + 1, together(d, all[k])));
  return fmt::format("{}, and this plan cannot tell which: either {}.{}", missing,
                     fmt::join(words, ", or "), twins_text(d, all));
}

/// "shows as much with a chance of 0.2".
std::string shows_as_much(double p_value) {
  constexpr double nearly_always = 0.995;  // what two digits would call 1
  return p_value > nearly_always
             ? "nearly always shows as much"
             : fmt::format("shows as much with a chance of {}", p_text(p_value));
}

/// Why what noise alone seldom shows is taken for noise: nothing is more probable.
std::string chance_text(const Diagnosis& d) {
  const Probabilities& p = d.probabilities;
  if (d.p_value > inference::SearchLimits::alpha || !p.known()) return "";
  std::string text = fmt::format(
      " Something stands out that noise alone seldom shows; still, that nothing is missing has the "
      "probability {}",
      decimal_text(p.consistent + p.noise_only, 2));
  if (!p.named.empty()) {
    std::vector<std::string> labels;
    for (const NamedEffect& e : p.named.front().causes) labels.push_back(e.label);
    text += fmt::format(", the likeliest effect ({}) {}", fmt::join(labels, " with "),
                        decimal_text(p.named.front().probability, 2));
  }
  return text + ": watch for it in the next recording.";
}

std::string verdict_alone(const Diagnosis& d) {
  const std::string noise = noise_text(d),
                    false_alarm = fmt::format("chance of a false alarm: {}", p_text(d.p_value));
  switch (d.verdict) {
    case Verdict::consistent:
      return fmt::format(
          "The recording agrees with the nominal model; no missing physics is found (noise alone "
          "{}).{}{}",
          shows_as_much(d.p_value), chance_text(d), noise);
    case Verdict::named:
      return fmt::format("{}; {} ({}).{}{}", lacking(d.causes, instrument_of(d)),
                         held_out_text(d, d.causes.size() > 1), false_alarm, outside_twins_text(d),
                         noise);
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
      located_shape_text(d), noise);
}

/// How a recording on a case is predicted, without the cause and with it.
std::string errors_text(const Diagnosis& d) {
  if (d.errors.empty() || !d.has_patch) return "";
  std::vector<std::string> numbers;
  for (const ErrorOfKind& k : d.errors)
    numbers.push_back(fmt::format("{} {:.3g} → {:.3g} {}", k.what, k.before, k.after, k.unit));
  return fmt::format(" Error on held-out data: {}.", fmt::join(numbers, ", "));
}

std::string nearest_text(const NearestKnown& near, Instrument instrument) {
  std::vector<std::string> words;
  for (const NamedEffect& e : near.effects)
    words.push_back(fmt::format("{} ({})", in_words(e.term, e.axis, instrument), e.label));
  return fmt::format(
      " The nearest known is {}: chi-square per degree of freedom goes from {:.3g} to {:.3g}, and "
      "something significant is left.",
      fmt::join(words, " together with "), near.chi2_per_dof_before, near.chi2_per_dof_after);
}

/// What a recording does not hold though the study reads it.
std::string absent_text(const std::vector<std::string>& absent) {
  const bool accelerometers = identification::lacks(absent, accelerometer_channels);
  if (!accelerometers && !identification::lacks(absent, gimbal_channels)) return "";
  return fmt::format("The recording has no {}: what follows is from the {} alone. ",
                     accelerometers ? "accelerometers" : "gimbal angles",
                     accelerometers ? "gimbal angles" : "accelerometers");
}

}  // namespace

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
  if (d.heading_doubt) return heading_text(*d.heading_doubt);
  if (d.site_doubt) return site_text(*d.site_doubt);
  std::string text = absent_text(d.absent) + verdict_alone(d);
  if (d.nearest_known && !d.proposal)  // a form that fits is nearer
    text += nearest_text(*d.nearest_known, instrument_of(d));
  if (d.verdict == Verdict::consistent)
    for (const Remark& r : d.remarks)
      if (const auto* other = std::get_if<remark::OtherEquation>(&r); other && other->open())
        text += fmt::format(" {}.", cannot_tell_equations(*other));
  text += outside_text(d);
  text += too_large_text(d);
  text += unexamined_twins_text(d.not_examined);
  if (d.verdict == Verdict::unexplained) text += lacking_covariate_text(d.not_examined);
  text += errors_text(d);
  return text;
}

}  // namespace drift::report
