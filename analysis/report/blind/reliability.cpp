#include "analysis/report/blind/sections.hpp"
#include "analysis/report/svg/curve.hpp"
#include "analysis/report/svg/figure.hpp"

namespace drift::report {
namespace {

Chart reliability_chart(const std::vector<blind::ReliabilityBin>& bins) {
  Panel panel;
  panel.x_label = "probability stated";
  panel.y_label = "share of right ones";
  panel.y_range = Range{0.0, 1.02};
  Series right = curve("right", 0), honest = curve("as stated", 6, Stroke::dashed);
  ExpectedBand band{"95 % interval", {}, {}, {}};
  honest.x = honest.y = {0.0, 1.0};
  for (const blind::ReliabilityBin& b : bins) {
    right.x.push_back(b.stated);
    right.y.push_back(b.right.share());
    band.x.push_back(b.stated);
    band.low.push_back(b.right.low);
    band.high.push_back(b.right.high);
  }
  panel.expected = {band};
  panel.series = {right, honest};
  return {"How often what was called most probable was right", {panel}, 1, narrow_page, 320.0};
}

}  // namespace

Section reliability(const BlindResults& results) {
  const auto& bins = results.summary.reliability.bins;
  if (bins.empty()) return {};
  Table t("", "<stated | mean | right | trials | 95 %");
  for (const blind::ReliabilityBin& b : bins)
    t.add({fmt::format("{:.2f} to {:.2f}", b.low, b.high), decimals(b.stated, 3),
           decimals(b.right.share(), 3), b.right.n,
           fmt::format("{:.3f} to {:.3f}", b.right.low, b.right.high)});
  return {"Are the probabilities right?",
          {t,
           Paragraph{fmt::format("Calibration error {:.3f}: the mean distance of the probability "
                                 "stated from the share of right ones. Were they all right, chance "
                                 "alone would make it {:.3f} with so many trials.",
                                 results.summary.reliability.error,
                                 results.summary.reliability.error_by_chance)},
           figure_of(reliability_chart(bins),
                     "What a diagnosis takes for most probable, by the probability that it states, "
                     "against how often that was hidden.",
                     "reliability.svg")}};
}

}  // namespace drift::report
