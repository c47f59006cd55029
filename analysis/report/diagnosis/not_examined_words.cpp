#include "analysis/report/diagnosis/not_examined_words.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/inference/thresholds.hpp"
#include "core/base/words.hpp"

namespace drift::report {

using diagnosis::NotExamined;
using Why = NotExamined::Why;

std::string reason_in_words(const NotExamined& left_out) {
  switch (left_out.why) {
    case Why::no_temperature:
      if (!left_out.instead.empty()) return "it follows the temperature: " + left_out.instead;
      return "it follows the temperature, which was not recorded";
    case Why::no_swing:
      return "it follows the temperature beyond the first order, and that hardly moved";
    case Why::no_field:
      return "it follows the magnetic field, which is not known";
    case Why::no_covariate:
      return "it follows a covariate that the recording does not have";
    case Why::no_turns:
      return "it acts while the case turns, where the accelerometers are not read";
    case Why::beyond_reach:
      break;
  }
  return "this plan does not show it, however large it is";
}

std::vector<std::string> not_examined_sentences(const std::vector<NotExamined>& all) {
  std::vector<std::string> sentences;
  const std::pair<Why, std::string> reasons[] = {
      {Why::no_temperature, "the temperature was not recorded"},
      {Why::no_swing, fmt::format("they ask for a temperature that moves by {:g} degC or more",
                                  inference::TemperatureLimits::swing)},
      {Why::no_field, "the magnetic field is not known"},
      {Why::no_covariate, "the recording lacks the covariate that they follow"},
      {Why::no_turns,
       "they act while the case turns, where the accelerometers are read only with "
       "accelerometers_in_turns = true in [plan] and gyros that see the Earth"},
      {Why::beyond_reach, "this plan does not show them, however large they are"}};
  for (const auto& [why, said] : reasons) {
    std::vector<std::string> terms;
    std::string instead;
    for (const NotExamined& n : all) {
      if (n.why != why) continue;
      terms.push_back(n.term);
      if (instead.empty()) instead = n.instead;
    }
    if (!terms.empty())
      sentences.push_back(fmt::format("Not examined: {}: {}", listed(terms, "and"),
                                      instead.empty() ? said : instead));
  }
  return sentences;
}

std::string unexamined_twins_text(const std::vector<NotExamined>& all) {
  std::vector<std::string> unseen, twins;
  for (const NotExamined& n : all) {
    if (n.twins.empty()) continue;
    unseen.push_back(n.term);
    for (const diagnosis::NamedEffect& twin : n.twins)
      if (std::ranges::find(twins, twin.label) == twins.end()) twins.push_back(twin.label);
  }
  if (unseen.empty()) return "";
  return fmt::format(
      " Not examined, for want of what they follow: {}; if that moved alike, it is what {} may "
      "be.",
      listed(unseen, "and"), listed(twins, "or"));
}

}  // namespace drift::report
