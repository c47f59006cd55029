#include "core/recording/rows/row_remarks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/recording/rows/repeated_rows.hpp"

namespace drift {
namespace {

constexpr double good_part = 0.1;  // of a position

std::string longest_text(const Gap& g) {
  return fmt::format("{:.5g} s after {:.10g} s (line {})", g.length, g.start, g.line);
}

}  // namespace

std::string rows_in_words(const Recording& r, std::size_t first, std::size_t count) {
  const std::size_t last = first + count - 1;
  const Channel *position = r.find("position"), *time = r.find("time");
  std::string text;
  if (position) {
    const double a = position->values[first], b = position->values[last];
    text = a == b ? fmt::format("position {}", a) : fmt::format("positions {} to {}", a, b);
  }
  if (time)
    text += fmt::format("{}from {:.10g} s on", text.empty() ? "" : ", ", time->values[first]);
  return fmt::format("lines {} to {}{}", r.lines[first], r.lines[last],
                     text.empty() ? "" : " (" + text + ")");
}

void remark_repeats(const Recording& recording, QualityCard& card) {
  const std::vector<RepeatedRows> all = repeated_rows(recording);
  if (all.empty()) return;
  const RepeatedRows& most = *std::ranges::max_element(all, {}, &RepeatedRows::count);
  std::string more;
  if (all.size() > 1)
    more = fmt::format("; {} other stretches repeat earlier ones", all.size() - 1);
  if (all.size() == 2) more = "; one other stretch repeats an earlier one";
  card.remarks.add(Weight::wrong,
                   fmt::format("{} hold the readings of {}, number for number: copied into the log "
                               "by mistake{}?",
                               rows_in_words(recording, most.again, most.count),
                               rows_in_words(recording, most.first, most.count), more));
}

void remark_gaps(QualityCard& card) {
  if (!card.gaps.empty()) {
    const Gap& g = *std::ranges::max_element(card.gaps, {}, &Gap::length);
    const bool large = std::ranges::any_of(
        card.gaps, [](const Gap& gap) { return gap.length > good_part * gap.within; });
    card.remarks.add(
        large ? Weight::wrong : Weight::doubtful,
        fmt::format("{} gap{}{}, the longest {}: about {:.0f} rows are missing", card.gaps.size(),
                    card.gaps.size() == 1 ? "" : "s", card.positions > 0 ? " within positions" : "",
                    longest_text(g), card.lost));
  }
  if (card.between.empty()) return;
  const Gap& g = *std::ranges::max_element(card.between, {}, &Gap::length);
  const std::size_t changes = card.positions - 1, without = changes - card.between.size();
  const bool few = without > card.between.size();
  card.remarks.add(
      few ? Weight::doubtful : Weight::note,
      fmt::format(
          "{} gap{} between positions, the longest {}: normal if the platform was caged "
          "there{}",
          card.between.size(), card.between.size() == 1 ? "" : "s", longest_text(g),
          few ? fmt::format(", but {} positions follow without one: was the log interrupted?",
                            without)
              : ""));
}

}  // namespace drift
