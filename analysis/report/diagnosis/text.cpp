#include "analysis/report/diagnosis/text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/report/diagnosis/tables.hpp"
#include "analysis/report/diagnosis/words.hpp"

namespace drift::report {
namespace {

using namespace diagnosis;
using namespace inference;
using namespace search;

constexpr std::size_t page = 100, most_candidates = 6, most_moved = 8;

std::string headed(std::string_view head, const std::string& sentence) {
  return sentence.empty() ? "" : wrapped(fmt::format("{}: {}", head, sentence), page, 2);
}

}  // namespace

std::string to_text(const Diagnosis& d) {
  std::string out = headed(fmt::format("Verdict {}", text(d.verdict)), verdict_sentence(d));
  const bool found = d.verdict != Verdict::consistent;
  if (found) {
    out += headed("Where", where_sentence(d.where));
    out += headed("Held out", held_out_sentence(d.fit.held_out));
  }
  if (!d.causes.empty()) out += "\n" + text_of(cause_table(d), page);
  if (!d.candidates.empty()) {
    Table table = candidate_table(d, most_candidates);
    if (d.candidates.size() <= most_candidates) table.note.clear();
    out += "\n" + text_of(table, page);
  }
  if (found) out += "\n" + text_of(fit_table(d), page);
  if (found && !d.fit.shifted.empty()) out += "\n" + text_of(moved_table(d, most_moved), page);
  if (std::ranges::any_of(d.noise, &NoiseFinding::significant))
    out += "\n" + text_of(noise_table(d), page);
  if (!d.advice.empty()) out += "\n";
  for (const Advice& a : d.advice) out += headed("Advice", a.text);
  const auto remarks = remarks_of(d);
  if (!remarks.empty()) out += "\n";
  for (const auto& remark : remarks) out += wrapped("! " + remark, page, 2);
  return out;
}

}  // namespace drift::report
