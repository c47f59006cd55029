#pragma once

#include <string>
#include <vector>

#include "analysis/blind/belief.hpp"
#include "analysis/diagnosis/findings/diagnosis.hpp"

namespace drift::blind {

/// What was answered to one trial: the parts of a diagnosis that are scored.
struct AnswerCause {
  std::string term, axis;
  int set = 0;  ///< simultaneous causes share a number; alternatives have different ones
  double probability = 0.0;
  std::vector<search::CauseParameter> parameters;
  std::vector<search::Confusable>
      confusable_with{};  ///< likest first; |cosine| 1: the same trace on this plan
};

struct Answer {
  std::size_t number = 0;
  bool failed = false;
  std::string failure;  ///< why there is no diagnosis
  diagnosis::Verdict verdict = diagnosis::Verdict::consistent;
  double p_value = 1.0;
  std::vector<AnswerCause> causes;
  std::string equation;  ///< of the strongest location, empty if nothing was located
  int position = 0;      ///< 1-based, of the strongest window; 0: none
  double start_s = 0.0, end_s = 0.0;
  std::vector<std::string> noise;              ///< components that are not as declared
  double chi2_before = 1.0, chi2_after = 1.0;  ///< per degree of freedom, in sample
  bool held_out = false;                       ///< positions were held out
  double held_out_gain = 0.0;                  ///< log score
  Belief belief;
  double seconds = 0.0;  ///< by the clock; no part of what is sealed

  /// Alternatives: causes or combinations of causes that are offered.
  std::vector<std::vector<const AnswerCause*>> alternatives() const;
};

Answer answer_of(const diagnosis::Diagnosis& diagnosis);

std::string to_json(const Answer& answer);
/// All answers, as answers.json.
std::string to_json(const std::vector<Answer>& answers);
/// InputError (self_check), naming the file that the text is of, if it holds no answers.
std::vector<Answer> answers_of(const std::string& json, const std::string& path = "answers.json");
Answer answer_of_json(const std::string& json, const std::string& path = "answer.json");

}  // namespace drift::blind
