// What a short answer never leaves off: that the cause won by the usual size of its rival alone.
#include <gtest/gtest.h>

#include "analysis/report/diagnosis/report.hpp"
#include "core/physics/term_library.hpp"

namespace drift::size_alone_test {
namespace {

using diagnosis::Diagnosis;

constexpr const char* by_size =
    "What would explain it as well, but loses by its size alone: timing_skew (6.6 times its usual "
    "size).";

search::CandidateScore candidate(const char* term, double log_bayes, double size_sigma) {
  search::CandidateScore c;
  c.term = c.label = term;
  c.p_value = 1e-20;
  c.leaves_nothing = true;
  c.log_bayes = log_bayes;
  c.size_sigma = size_sigma;
  return c;
}

/// A tilt of the pier is named; clocks that are apart would fit, were they apart by less.
Diagnosis tilted() {
  Diagnosis d;
  d.verdict = diagnosis::Verdict::named;
  d.p_value = 2e-19;
  search::Cause cause;
  cause.term = "pier_tilt";
  const auto add = [&cause](const char* key, double value, double sigma, const char* unit) {
    cause.parameters.push_back({key, TermLibrary::find(key).value(), value, sigma, unit});
  };
  add("tilt_c_n", -3.43, 0.21, "arcsec");
  add("tilt_T", 42.6, 2.1, "h");
  d.causes = {cause};
  d.candidates = {candidate("pier_tilt", 28.6, 0.9), candidate("timing_skew", 29.8, 6.64),
                  candidate("encoder_harmonics", 31.2, 1.2)};
  return d;
}

/// The same beside all that a short answer may have to say.
report::InBrief crowded(const Diagnosis& d) {
  report::InBrief brief = report::diagnosis_in_brief(d);
  const auto at = brief.verdict.find(by_size);
  if (at != std::string::npos)
    brief.verdict.insert(at, "The noise is not as declared either: " + std::string(90, 'n') + ". ");
  brief.verdict += " " + std::string(70, 'p') + ". " + std::string(70, 'q') + ".";
  brief.more.add(Weight::wrong, "Prior: " + std::string(60, 'a') + " " + std::string(70, 'b') +
                                    " " + std::string(50, 'c') + ".");
  brief.next = "Next: " + std::string(60, 'd') + " " + std::string(50, 'e') + ".";
  return brief;
}

/// Its lines as one.
std::string flat(const std::string& text) {
  std::string out;
  for (const char c : text)
    if (c != ' ' && c != '\n')
      out += c;
    else if (!out.ends_with(' '))
      out += ' ';
  return out;
}

TEST(SizeAlone, StandsInTheShortAnswerWhateverHasNoRoom) {
  const report::InBrief brief = crowded(tilted());
  EXPECT_EQ(brief.kept, by_size);
  const std::string shown = report::brief_text(brief), text = flat(shown);
  EXPECT_TRUE(text.starts_with("Verdict named: The nominal model lacks daily tilt of the pier"))
      << shown;
  EXPECT_NE(text.find(by_size), text.npos) << shown;
  EXPECT_EQ(text.find("The noise"), text.npos) << shown;
  EXPECT_NE(text.find("Prior: "), text.npos) << shown;
  EXPECT_LE(std::ranges::count(shown, '\n'), 10) << shown;
  // Of a whole sentence that has no room the end is left off, and not this one.
  report::InBrief longer = brief;
  longer.verdict.insert(longer.verdict.find(" (pier_tilt"),
                        " " + std::string(70, 'v') + " " + std::string(70, 'w') + " " +
                            std::string(70, 'x') + " " + std::string(70, 'y'));
  const std::string cut = report::brief_text(longer);
  EXPECT_NE(flat(cut).find("... What would explain it as well"), std::string::npos) << cut;
  EXPECT_LE(std::ranges::count(cut, '\n'), 10) << cut;
}

TEST(SizeAlone, IsOneSentenceOfSeveralWhereAnotherRivalIsNearer) {
  Diagnosis d = tilted();
  d.candidates[2].log_bayes = 80.0;
  EXPECT_EQ(report::diagnosis_in_brief(d).kept, "");
  EXPECT_NE(report::diagnosis_in_brief(d).verdict.find(by_size), std::string::npos);
  d = tilted();
  d.candidates[1].p_value = 0.3;
  EXPECT_EQ(report::diagnosis_in_brief(d).kept, "");
}

}  // namespace
}  // namespace drift::size_alone_test
