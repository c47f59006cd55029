#include "mc/study/own_terms_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/check.hpp"
#include "core/physics/own/own_terms.hpp"

namespace drift::mc {
namespace {

std::string names_in(const OwnTermSet& set) {
  std::vector<std::string_view> keys;
  for (const OwnTerm& term : set.terms) keys.push_back(term.key);
  return keys.empty() ? "none" : fmt::format("{}", fmt::join(keys, ", "));
}

}  // namespace

void require_own_terms(const Study& study) {
  if (!study.own_terms || *study.own_terms == own_terms()) return;
  const std::string now = names_in(own_terms()), before = names_in(*study.own_terms);
  throw InputError(
      ExitCode::config,
      fmt::format(
          "{}: the own terms of another study have been read since: a process holds one set "
          "of [[term]], now {}{} (expected those that this study was read with: {}). Read "
          "this study again, or keep its terms by KeptOwnTerms while others are read",
          study.path, now, now == before ? ", declared otherwise" : "", before));
}

}  // namespace drift::mc
