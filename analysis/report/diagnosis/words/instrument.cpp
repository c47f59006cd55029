#include "analysis/report/diagnosis/words/instrument.hpp"

#include <algorithm>
#include <iterator>

namespace drift::report {
namespace {

/// Of the terms that have another name on a case; equations in the sensors' convention, w the rate
/// along the input axis.
struct OnCase {
  std::string_view key, title, equation;
};
constexpr OnCase on_case[] = {
    {"torquer_scale", "scale factor error of the gyros", "reading_i += s_i w_i"},
    {"torquer_asymmetry", "scale factor asymmetry of the gyros", "reading_i += s_a_i |w_i|"},
    {"torquer_nonlinearity", "scale factor nonlinearity of the gyros",
     "reading_i += s_2_i w_i |w_i| / (0.5 deg/s)"},
    {"torquer_temperature", "temperature coefficients of the scale factor of the gyros",
     "reading_i += (s_T_i dT + s_T2_i dT^2 + s_T3_i dT^3) w_i"}};

const OnCase* found(const TermInfo& term, Instrument instrument) {
  if (instrument == Instrument::platform) return nullptr;
  const auto at = std::ranges::find(on_case, term.key, &OnCase::key);
  return at == std::end(on_case) ? nullptr : at;
}

}  // namespace

std::string_view title_of(const TermInfo& term, Instrument instrument) {
  const OnCase* own = found(term, instrument);
  return own ? own->title : term.title;
}

std::string_view equation_of(const TermInfo& term, Instrument instrument) {
  const OnCase* own = found(term, instrument);
  return own ? own->equation : term.equation;
}

}  // namespace drift::report
