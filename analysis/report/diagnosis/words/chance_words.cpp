#include "analysis/report/diagnosis/words/chance_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "analysis/inference/thresholds.hpp"
#include "analysis/report/diagnosis/words/effect_words.hpp"
#include "analysis/report/diagnosis/words/verdict_openings.hpp"
#include "analysis/report/diagnosis/words/words.hpp"
#include "core/base/number_text.hpp"

namespace drift::report {

using namespace diagnosis;

std::string shows_as_much(double p_value) {
  constexpr double nearly_always = 0.995;  // what two digits would call 1
  return p_value > nearly_always
             ? "nearly always shows as much"
             : fmt::format("shows as much with a chance of {}", p_text(p_value));
}

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

std::string likelier_missing_text(const Diagnosis& d) {
  const auto* likelier = remark_in<remark::LikelierMissing>(d);
  if (likelier == nullptr) return "";
  const Probabilities& p = d.probabilities;
  double of_library = 0.0;
  for (const Probabilities::Explanation& e : p.named) of_library += e.probability;
  std::string likeliest;
  if (!p.named.empty()) {
    std::vector<std::string> words;
    for (const NamedEffect& e : p.named.front().causes)
      words.push_back(fmt::format("{} ({})", in_words(e.term, e.axis, instrument_of(d)), e.label));
    likeliest = fmt::format(" (the likeliest, {}: {})", fmt::join(words, " together with "),
                            decimal_text(p.named.front().probability, 2));
  }
  return fmt::format(
      "{}: noise alone {}, but that nothing is missing has a probability of {} only. An effect of "
      "the library has {}{}, something that no term describes {}: this recording does not tell.",
      something_may_be_missing, shows_as_much(d.p_value), decimal_text(likelier->nothing, 2),
      decimal_text(of_library, 2), likeliest, decimal_text(p.outside, 2));
}

}  // namespace drift::report
