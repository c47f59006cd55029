#include "analysis/report/diagnosis/words/alternative_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "analysis/inference/thresholds.hpp"
#include "analysis/report/diagnosis/words/effect_words.hpp"
#include "core/base/words.hpp"

namespace drift::report {

using namespace diagnosis;

namespace {

bool same_trace(const Diagnosis& d, std::size_t i, std::size_t k) {
  if (d.causes[i].term == d.causes[k].term && d.causes[i].axis == d.causes[k].axis) return true;
  const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(k);
  const MatX& cosine = d.cosines.cosine;
  return a < cosine.rows() && b < cosine.cols() && inference::same_trace(cosine(a, b));
}

bool same_trace(const Diagnosis& d, const CauseIndices& one, const CauseIndices& other) {
  const auto met_in = [&](const CauseIndices& there) {
    return [&](std::size_t i) {
      return std::ranges::any_of(there, [&](std::size_t k) { return same_trace(d, i, k); });
    };
  };
  return std::ranges::all_of(one, met_in(other)) && std::ranges::all_of(other, met_in(one));
}

/// Whether a cause that was fitted with several sizes is one with another effect in all of them.
bool one_in_all(const Diagnosis& d, const search::Cause& c, const search::Confusable& o) {
  if (std::ranges::count(c.parameters, false, &search::CauseParameter::profiled) < 2) return true;
  return std::ranges::any_of(d.inseparable, [&](const Twins& t) {
    return t.one.term == c.term && t.one.axis == c.axis && t.other.term == o.term &&
           t.other.axis == o.axis;
  });
}

}  // namespace

std::vector<CauseIndices> alternatives_of(const Diagnosis& d) {
  std::vector<CauseIndices> all;
  for (std::size_t k = 0; k < d.causes.size(); ++k) {
    if (k == 0 || d.causes[k].set != d.causes[k - 1].set) all.emplace_back();
    all.back().push_back(k);
  }
  return all;
}

std::string together(const Diagnosis& d, const CauseIndices& causes) {
  std::vector<std::string> words;
  for (const std::size_t k : causes) words.push_back(in_words(d.causes[k], instrument_of(d)));
  return fmt::format("{}", fmt::join(words, " together with "));
}

std::string_view positions_at_hand(const Diagnosis& d) {
  return d.absent_positions.empty() ? "this plan" : "these positions";
}

std::string twins_text(const Diagnosis& d, const std::vector<CauseIndices>& all) {
  std::vector<bool> said(all.size(), false);
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<std::string> group{fmt::format("({})", i + 1)};
    for (std::size_t k = i + 1; k < all.size() && !said[i]; ++k)
      if (!said[k] && same_trace(d, all[i], all[k])) {
        group.push_back(fmt::format("({})", k + 1));
        said[k] = true;
      }
    if (group.size() > 1)
      text += fmt::format(" {} leave the same trace on {}.", listed(group, "and"),
                          positions_at_hand(d));
  }
  return text;
}

std::string outside_twins_text(const Diagnosis& d) {
  std::string text;
  for (const search::Cause& c : d.causes)
    for (const search::Confusable& o : c.confusable_with) {
      const bool among =
          std::ranges::any_of(d.causes, [&](const search::Cause& k) { return k.term == o.term; });
      const bool narrower =
          o.axis.empty() &&
          std::ranges::any_of(c.confusable_with, [&](const search::Confusable& k) {
            return k.term == o.term && !k.axis.empty() && inference::same_trace(k.cosine);
          });
      if (!inference::same_trace(o.cosine) || among || narrower || !one_in_all(d, c, o)) continue;
      const auto line =
          fmt::format(" On {} {} ({}) and {} ({}) leave the same trace.", positions_at_hand(d),
                      in_words(c.term, c.axis, instrument_of(d)), search::keyed(c.term, c.axis),
                      in_words(o.term, o.axis, instrument_of(d)), search::keyed(o.term, o.axis));
      if (text.find(line) == std::string::npos) text += line;
    }
  return text;
}

}  // namespace drift::report
