#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/inference/thresholds.hpp"
#include "analysis/report/diagnosis/sections.hpp"
#include "core/base/number_text.hpp"

namespace drift::report {

using namespace diagnosis;

Section odds(const Diagnosis& d) {
  using inference::PosteriorPrior;
  constexpr double least_shown = 0.02;
  const Probabilities& p = d.probabilities;
  if (!p.known()) return {};
  Table table("", "< | probability");
  const auto* beyond = remark_in<remark::BeyondPrior>(d);
  const std::string_view other_way = beyond != nullptr && beyond->taken
                                         ? ", and all priors right"
                                         : ", and priors of the model wrong";
  const auto add = [&](const std::string& what, double probability) {
    table.add({what, probability < 5e-4 ? Cell("below 0.001") : decimals(probability, 3)});
  };
  add("nothing missing, noise as declared", p.consistent - p.wrong_priors);
  if (p.wrong_priors > 0.0) add("nothing missing, but priors of the model wrong", p.wrong_priors);
  add("nothing missing, noise not as declared", p.noise_only);
  double others = 0.0;
  for (const Probabilities::Explanation& e : p.named) {
    if (e.probability < least_shown) {
      others += e.probability;
      continue;
    }
    std::vector<std::string> labels;
    for (const NamedEffect& c : e.causes) labels.push_back(c.label);
    add(fmt::format("{}{}", fmt::join(labels, " together with "), e.other_priors ? other_way : ""),
        e.probability);
  }
  if (others > 0.0)
    add(fmt::format("another effect of the library, each below {}", least_shown), others);
  add("something that no term of the library describes", p.outside);
  return {"What the recording may be",
          {table, Paragraph{fmt::format(
                      "By the marginal likelihood of each and a prior that is the same for all "
                      "recordings: nothing missing {}, an effect of the library {}, something else "
                      "{} (more of it in the documents, analysis/docs/diagnose.md); they sum to 1.",
                      PosteriorPrior::nothing, PosteriorPrior::library, PosteriorPrior::outside)}}};
}

}  // namespace drift::report
