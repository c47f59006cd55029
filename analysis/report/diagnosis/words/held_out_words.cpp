#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "analysis/report/diagnosis/words/words.hpp"
#include "core/base/number_text.hpp"

namespace drift::report {
namespace {

/// "1.03 → 1.00" of chi-squares per degree of freedom, with as many decimals as tell two that are
/// not one apart.
std::string from_to(double before, double after) {
  constexpr int most = 4;
  const auto text = [&](double value, int decimals) {
    return std::abs(value) < 10.0 ? decimal_text(value, decimals)
                                  : number_text(value, decimals + 1);
  };
  int decimals = 2;
  while (decimals < most && text(before, decimals) == text(after, decimals)) ++decimals;
  if (text(before, decimals) == text(after, decimals)) decimals = 2;
  return fmt::format("{} → {}", text(before, decimals), text(after, decimals));
}

/// How the score judges, which weighs each error by how surely it was predicted; said where
/// chi-square goes the other way.
std::string judged_by_score(double gain, double before, double after) {
  const bool better = gain > 0.0;
  return fmt::format(
      "{}better{}", better ? "" : "no ",
      (better && after > before) || (!better && after < before) ? " by their score" : "");
}

std::string score_text(double gain) {
  return std::isfinite(gain) ? fmt::format(", log score {:+.3g}", gain) : std::string();
}

}  // namespace

std::string held_out_sentence(const diagnosis::HeldOut& held) {
  std::string out;
  if (!held.folds.empty())
    out = fmt::format(
        "Data held out of the fit are predicted {}: chi-square per degree of freedom {} in {} "
        "folds{}.",
        judged_by_score(held.log_score_gain, held.chi2_per_dof_before, held.chi2_per_dof_after),
        from_to(held.chi2_per_dof_before, held.chi2_per_dof_after), held.folds.size(),
        score_text(held.log_score_gain));
  if (!held.recordings.empty())
    out +=
        fmt::format("{}Whole recordings, each from a fit to the others, are predicted {}: {}{}.",
                    out.empty() ? "" : " ",
                    judged_by_score(held.recording_gain, held.recording_chi2_per_dof_before,
                                    held.recording_chi2_per_dof_after),
                    from_to(held.recording_chi2_per_dof_before, held.recording_chi2_per_dof_after),
                    score_text(held.recording_gain));
  return out;
}

std::string held_out_text(const diagnosis::Diagnosis& d, bool several) {
  const diagnosis::HeldOut& held = d.fit.held_out;
  if (held.folds.empty() && held.recordings.empty())
    return "nothing was held out of the fit to judge it";
  if (held.recordings_disagree)
    return fmt::format(
        "with {}, held-out positions are predicted better, and whole recordings, each from a fit "
        "to "
        "the others, are not: {} may be in one recording only",
        several ? "them" : "it", several ? "they" : "it");
  // The score weighs each error by how surely it was predicted; the errors themselves are not.
  const bool some_grow =
      held.improves && d.has_patch &&
      std::ranges::any_of(d.errors, [](const diagnosis::ErrorOfKind& k) {
        return k.after > k.before && number_text(k.after, 2) != number_text(k.before, 2);
      });
  return fmt::format("with {}, held-out {} are predicted {}{}", several ? "them" : "it",
                     d.of_case ? "dwells" : "positions", held.improves ? "better" : "no better",
                     some_grow
                         ? fmt::format(" by their score (log score {:+.1f}±{:.1f}, errors weighed "
                                       "by their sigmas), though not all errors become smaller",
                                       held.log_score_gain, held.log_score_gain_sigma)
                         : "");
}

std::string errors_text(const diagnosis::Diagnosis& d) {
  if (d.errors.empty() || !d.has_patch) return "";
  std::vector<std::string> numbers;
  for (const diagnosis::ErrorOfKind& k : d.errors)
    numbers.push_back(
        fmt::format("{} {} → {} {}", k.what, number_text(k.before), number_text(k.after), k.unit));
  return fmt::format(" Error on held-out data: {}.", fmt::join(numbers, ", "));
}

}  // namespace drift::report
