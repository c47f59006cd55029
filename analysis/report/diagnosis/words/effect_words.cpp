#include "analysis/report/diagnosis/words/effect_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "analysis/report/diagnosis/words/too_large.hpp"
#include "core/base/number_text.hpp"
#include "core/base/words.hpp"
#include "core/physics/closure.hpp"
#include "core/physics/term_library.hpp"

namespace drift::report {
namespace {

constexpr std::size_t most_numbers = 3;
constexpr std::string_view less_the_mean = "less the mean of the three";

/// What an axis of a term belongs to: "gyro y", "accelerometer y", "axis y", "outer gimbal".
std::string part_of(const TermInfo& term, std::string_view axis) {
  if (axis.size() > 1) return fmt::format("{} gimbal", axis);
  if (term.in_readout) return fmt::format("accelerometer {}", axis);
  if (term.in_offset || term.in_gimbals || term.subsystem == Subsystem::servo)
    return fmt::format("platform axis {}", axis);
  return fmt::format("gyro {}", axis);
}

/// Distance of a found number from its prior's mean, in sigmas of the prior, the library's where no
/// other is known; 0 of what was profiled.
double in_prior_sigmas(const search::CauseParameter& p) {
  if (!p.profiled && std::isfinite(p.prior_sigmas)) return std::abs(p.prior_sigmas);
  const ParamSpec& spec = TermLibrary::specs[p.param];
  const double sigma = spec.prior.sigma();
  return p.profiled || !(sigma > 0.0) ? 0.0 : std::abs(p.told() - spec.prior.mean()) / sigma;
}

/// Whether value and sigma are all there is to say. Of lambda an end that refits did not reach is
/// taken by its sigma, too.
bool told_by_sigma(const search::CauseParameter& p) {
  return p.sigma_says_it() || (p.param == closure_param && !p.by_refits());
}

/// The sigma that a number has the digits of. Of an interval: as many decimals as its nearer end
/// asks for, but not where that is the value itself.
double sigma_of_digits(const search::CauseParameter& p) {
  if (told_by_sigma(p)) return p.sigma;
  const double value = p.told();
  const bool low = std::isfinite(p.low_95), high = std::isfinite(p.high_95);
  double nearer = std::min(low ? std::abs(value - p.low_95) : HUGE_VAL,
                           high ? std::abs(p.high_95 - value) : HUGE_VAL);
  if (low && high) nearer = std::max(nearer, 0.1 * (p.high_95 - p.low_95));
  return nearer / stats::half_width_95;
}

std::string end_of(const search::CauseParameter& p, double end) {
  const double sigma = sigma_of_digits(p);
  return p.param == closure_param ? lambda_in_words(end, sigma) : to_match(end, sigma);
}

/// The value as it stands before an interval that is told of it in any case.
std::string value_alone(const search::CauseParameter& p) {
  return told_by_sigma(p) ? with_sigma(p.value, p.sigma) : to_match(p.told(), sigma_of_digits(p));
}

/// What a number is relative to: said of each, or once behind all.
enum class Note { said, left_out };

std::string number_of(const search::CauseParameter& p, Note note = Note::said) {
  // Of lambda, which is between two equations, the interval is told in any case.
  const std::string value = p.param == closure_param ? value_alone(p) : value_in_words(p);
  std::string text = fmt::format("{} = {}{}{}", p.key, value, p.unit == "1" ? "" : " ",
                                 p.unit == "1" ? "" : p.unit);
  if (note == Note::said && p.less_mean) text += fmt::format(" {}", less_the_mean);
  if (const double size = in_prior_sigmas(p); size > unusual_size)
    text += fmt::format(", {} times its usual size", number_text(size, 2));
  return text;
}

/// What stands in the brackets behind a cause.
std::string numbers_of(const search::Cause& c) {
  std::string text = search::keyed(c.term, c.axis);
  if (c.parameters.empty()) return text;
  if (c.parameters.size() > most_numbers) {
    const auto largest = std::ranges::max_element(c.parameters, {}, in_prior_sigmas);
    return text + fmt::format(": {} and {} more", number_of(*largest), c.parameters.size() - 1);
  }
  const bool all_less = c.parameters.size() > 1 &&
                        std::ranges::all_of(c.parameters, &search::CauseParameter::less_mean);
  std::vector<std::string> numbers;
  for (const search::CauseParameter& p : c.parameters)
    numbers.push_back(number_of(p, all_less ? Note::left_out : Note::said));
  text += fmt::format(": {}", fmt::join(numbers, ", "));
  if (all_less) text += fmt::format(", each {}", less_the_mean);
  const search::CauseParameter& p = c.parameters.front();
  if (c.term == closure_term)  // between two equations the interval is the answer
    text += fmt::format(", 95 % interval {} to {}, where eq. (5) is 0 and eq. (6) is 1",
                        end_of(p, p.low()), end_of(p, p.high()));
  return text;
}

/// Words with something in brackets behind; brackets at their end take it in.
std::string with_brackets(std::string words, const std::string& inside) {
  if (!words.ends_with(')')) return fmt::format("{} ({})", words, inside);
  words.pop_back();
  return fmt::format("{}; {})", words, inside);
}

}  // namespace

std::string in_words(std::string_view term, std::string_view axis, Instrument instrument) {
  if (term == closure_term) return "another drift equation";
  const auto known = TermLibrary::find_term(term);
  if (!known) return search::keyed(term, axis);
  const TermInfo& info = TermLibrary::terms[*known];
  const std::string_view title = title_of(info, instrument);
  return axis.empty() ? std::string(title) : fmt::format("{}, {}", title, part_of(info, axis));
}

std::string value_in_words(const search::CauseParameter& p) {
  if (!p.any_of.empty()) {
    std::vector<std::string> values;
    for (const double value : p.any_of) values.push_back(number_text(value));
    return listed(values, "or");
  }
  if (told_by_sigma(p)) return with_sigma(p.value, p.sigma);
  const bool low = std::isfinite(p.low_95), high = std::isfinite(p.high_95);
  return fmt::format("{} (95 %: {}{}{}{})", to_match(p.told(), sigma_of_digits(p)),
                     low ? (high ? "" : "at least ") : "at most ", low ? end_of(p, p.low_95) : "",
                     low && high ? " to " : "", high ? end_of(p, p.high_95) : "");
}

std::string lambda_in_words(double lambda, double sigma) {
  constexpr int most_decimals = 9;  // closer it is the equation
  const std::string text = to_match(lambda, sigma);
  const auto point = text.find('.');
  auto decimals = static_cast<int>(point == std::string::npos ? 0 : text.size() - point - 1);
  for (const double equation : {0.0, 1.0})
    for (; decimals <= most_decimals; ++decimals) {
      const std::string finer = decimal_text(lambda, decimals);
      if (lambda == equation || std::strtod(finer.c_str(), nullptr) != equation) break;
    }
  return decimals > most_decimals ? text : decimal_text(lambda, decimals);
}

std::string note_in_words(const search::CauseParameter& p) {
  return std::string(p.less_mean ? less_the_mean : "");
}

std::string note_in_words(const diagnosis::Profile& p) {
  return std::string(p.less_mean ? less_the_mean : "");
}

std::string in_words(const search::Cause& c, Instrument instrument) {
  return with_brackets(in_words(c.term, c.axis, instrument), numbers_of(c));
}

std::string equation_in_words(const std::string& equation) {
  constexpr std::string_view gimbal = "gimbal ";
  return equation.starts_with(gimbal) ? equation.substr(gimbal.size()) + " gimbal" : equation;
}

std::string lacking(const std::vector<search::Cause>& causes, Instrument instrument) {
  std::vector<std::string> effects;
  std::string equation;
  for (const search::Cause& c : causes)
    if (c.term == closure_term)
      equation = fmt::format(" has the wrong drift equation ({})", numbers_of(c));
    else
      effects.push_back(in_words(c, instrument));
  const std::string lacks = effects.empty() ? "" : fmt::format(" lacks {}", listed(effects, "and"));
  return fmt::format("The nominal model{}{}{}", equation,
                     equation.empty() || lacks.empty() ? "" : " and", lacks);
}

std::string noise_in_words(const std::string& component) {
  constexpr std::pair<std::string_view, std::string_view> known[] = {
      {"gimbal_white", "white noise of the gimbal readout"},
      {"gyro_white", "white noise of the gyros"},
      {"accelerometer_white", "white noise of the accelerometers"},
      {"angle_random_walk", "angle random walk of the gyros"},
      {"drift_random_walk", "random walk of the gyro drift"},
      {"markov_drift", "slowly wandering gyro drift"},
      {"caging_drift", "a gyro drift that differs from caging to caging"},
      {"accelerometer_markov", "slowly wandering accelerometer error"},
      {"outliers", "isolated wrong samples"}};
  for (const auto& [key, words] : known)
    if (key == component) return std::string(words);
  return component;
}

}  // namespace drift::report
