#include "analysis/report/diagnosis/words/not_examined_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "analysis/inference/thresholds.hpp"
#include "core/base/words.hpp"
#include "core/physics/own/own_terms.hpp"

namespace drift::report {

using diagnosis::NotExamined;
using Why = NotExamined::Why;

namespace {

/// The first covariate of the table that a term lacks; null: what it lacks is a column that a study
/// names, or nothing.
const CovariateSpec* lacked_by(const NotExamined& left_out) {
  for (const CovariateSpec& c : known_covariates)
    if (left_out.why == Why::no_covariate && (left_out.missing & c.set()) != 0) return &c;
  return nullptr;
}

std::string_view absence(const CovariateSpec& c) {
  return c.is_vector() ? "is not known" : "was not recorded";
}

/// Of several recordings those that lack something, "b.csv and c.csv"; empty where all do.
std::string lacking_in_words(const NotExamined& left_out, const RecordingSpans& recordings) {
  std::vector<std::string> names;
  for (const std::size_t k : left_out.lacking)
    names.push_back(k < recordings.size() ? recordings[k].name
                                          : fmt::format("recording {}", k + 1));
  return names.empty() ? "" : listed(names, "and");
}

/// " in b.csv", or nothing.
std::string in_which(const NotExamined& left_out, const RecordingSpans& recordings) {
  const std::string lacking = lacking_in_words(left_out, recordings);
  return lacking.empty() ? "" : " in " + lacking;
}

/// Of the study itself, or of the library.
enum class Origin { study, library };

std::vector<NotExamined> lacking_covariate(const std::vector<NotExamined>& all, Origin origin) {
  std::vector<NotExamined> lacking;
  std::ranges::copy_if(all, std::back_inserter(lacking), [&](const NotExamined& n) {
    const bool own =
        std::ranges::find(own_terms().terms, n.term, &OwnTerm::key) != own_terms().terms.end();
    return n.why == Why::no_covariate && own == (origin == Origin::study);
  });
  return lacking;
}

/// What a term lacks: "the temperature", "the column oil".
std::string lacked_in_words(const NotExamined& left_out) {
  std::vector<std::string> words;
  for (const CovariateSpec& c : known_covariates)
    if ((left_out.missing & c.set()) != 0) words.push_back(fmt::format("the {}", c.what));
  for (std::size_t k = 0; k < own_terms().covariates.size(); ++k)
    if ((left_out.missing & further_column(k)) != 0)
      words.push_back(fmt::format("the column {}", own_terms().covariates[k]));
  return words.empty() ? "what it follows" : listed(words, "and");
}

/// Why several terms were not examined: the same text for the same reason.
std::string reason_of_several(const NotExamined& left_out, const RecordingSpans& recordings) {
  const std::string lacking = lacking_in_words(left_out, recordings);
  switch (left_out.why) {
    case Why::no_covariate:
      if (!left_out.instead.empty()) return left_out.instead;
      if (const CovariateSpec* c = lacked_by(left_out))
        return fmt::format("the {} {}{}", c->what, absence(*c), in_which(left_out, recordings));
      return fmt::format("{} lack{} the covariate that they follow",
                         lacking.empty() ? "the recording" : lacking,
                         left_out.lacking.size() > 1 ? "" : "s");
    case Why::no_swing:
      return fmt::format("they ask for a temperature that moves by {:g} degC or more",
                         inference::TemperatureLimits::swing);
    case Why::no_turns:
      return "they act while the case turns, where the accelerometers are read only with "
             "accelerometers_in_turns = true in [plan] and gyros that see the Earth";
    case Why::beyond_reach:
      break;
  }
  return "this plan does not show them, unless they are forty times as large as is usual";
}

}  // namespace

std::string reason_in_words(const NotExamined& left_out, const RecordingSpans& recordings) {
  switch (left_out.why) {
    case Why::no_covariate:
      if (const CovariateSpec* c = lacked_by(left_out))
        return left_out.instead.empty()
                   ? fmt::format("it follows the {}, which {}{}", c->what, absence(*c),
                                 in_which(left_out, recordings))
                   : fmt::format("it follows the {}: {}", c->what, left_out.instead);
      if (!left_out.instead.empty())
        return fmt::format("it follows a column: {}", left_out.instead);
      if (!left_out.lacking.empty())
        return fmt::format("it follows a covariate that is not{}", in_which(left_out, recordings));
      return "it follows a covariate that the recording does not have";
    case Why::no_swing:
      return "it follows the temperature beyond the first order, and that hardly moved";
    case Why::no_turns:
      return "it acts while the case turns, where the accelerometers are not read";
    case Why::beyond_reach:
      break;
  }
  return "this plan does not show it, unless it is forty times as large as is usual";
}

std::vector<std::string> not_examined_sentences(const std::vector<NotExamined>& all,
                                                const RecordingSpans& recordings) {
  std::vector<std::pair<std::string, std::vector<std::string>>> terms_by_reason;
  for (const NotExamined& n : all) {
    const std::string reason = reason_of_several(n, recordings);
    auto same = std::ranges::find(terms_by_reason, reason,
                                  &std::pair<std::string, std::vector<std::string>>::first);
    if (same == terms_by_reason.end()) same = terms_by_reason.insert(same, {reason, {}});
    same->second.push_back(n.term);
  }
  std::vector<std::string> sentences;
  for (const auto& [reason, terms] : terms_by_reason)
    sentences.push_back(fmt::format("Not examined: {}: {}", listed(terms, "and"), reason));
  return sentences;
}

std::string unexamined_twins_text(const std::vector<NotExamined>& all) {
  std::vector<std::string> unseen, twins;
  for (const NotExamined& n : all) {
    if (n.twins.empty()) continue;
    unseen.push_back(n.term);
    for (const diagnosis::NamedEffect& twin : n.twins)
      if (std::ranges::find(twins, twin.label) == twins.end()) twins.push_back(twin.label);
  }
  if (unseen.empty()) return "";
  return fmt::format(
      " Not examined, for want of what they follow: {}; if that moved alike, it is what {} may "
      "be.",
      listed(unseen, "and"), listed(twins, "or"));
}

std::string lacking_covariate_text(const std::vector<NotExamined>& all,
                                   const RecordingSpans& recordings) {
  std::string text;
  for (const std::string& sentence :
       not_examined_sentences(lacking_covariate(all, Origin::library), recordings))
    text += " " + sentence + ".";
  return text;
}

std::string followed_text(const std::vector<NotExamined>& all, const RecordingSpans& recordings) {
  std::vector<std::string> followed;
  std::set<std::string> in;
  for (const NotExamined& n : lacking_covariate(all, Origin::library))
    if (const CovariateSpec* c = lacked_by(n);
        c != nullptr && !c->is_vector() && n.instead.empty()) {
      if (std::ranges::find(followed, c->what) == followed.end()) followed.emplace_back(c->what);
      in.insert(in_which(n, recordings));
    }
  if (followed.empty()) return "";
  return fmt::format(
      " What wanders may follow the {}, which {} not recorded{}: record {} to tell it from noise.",
      listed(followed, "and the"), followed.size() > 1 ? "were" : "was",
      in.size() == 1 ? *in.begin() : "", followed.size() > 1 ? "them" : "it");
}

std::string own_not_examined_text(const std::vector<NotExamined>& all,
                                  const RecordingSpans& recordings) {
  std::vector<std::string> parts;
  for (const NotExamined& n : lacking_covariate(all, Origin::study)) {
    const std::string names = lacking_in_words(n, recordings);
    parts.push_back(fmt::format(
        "{}, a term of the study: {}", n.term,
        !n.instead.empty() ? n.instead
                           : fmt::format("{} lack{} {}", names.empty() ? "the recording" : names,
                                         n.lacking.size() > 1 ? "" : "s", lacked_in_words(n))));
  }
  return parts.empty() ? "" : fmt::format("{}.", fmt::join(parts, "; "));
}

std::string lacking_in_some_next(const std::vector<NotExamined>& all,
                                 const RecordingSpans& recordings) {
  std::vector<std::string> terms;
  const NotExamined* first = nullptr;
  const std::vector<NotExamined> lacking = lacking_covariate(all, Origin::library);
  for (const NotExamined& n : lacking) {
    if (n.lacking.empty() || !n.instead.empty()) continue;
    if (first == nullptr) first = &n;
    if (n.lacking == first->lacking && n.missing == first->missing) terms.push_back(n.term);
  }
  if (first == nullptr) return "";
  return fmt::format("Next: give {} {}, or leave {} out, and diagnose again: {} {} not examined.",
                     lacking_in_words(*first, recordings), lacked_in_words(*first),
                     first->lacking.size() > 1 ? "them" : "it", listed(terms, "and"),
                     terms.size() > 1 ? "were" : "was");
}

std::string lacking_in_all_text(const std::vector<NotExamined>& all) {
  std::vector<std::string> followed;
  for (const NotExamined& n : lacking_covariate(all, Origin::library))
    if (const CovariateSpec* c = lacked_by(n);
        c != nullptr && !c->is_vector() && n.instead.empty() && n.lacking.empty())
      if (std::string what = fmt::format("the {}", c->what);
          std::ranges::find(followed, what) == followed.end())
        followed.push_back(std::move(what));
  return followed.empty()
             ? ""
             : fmt::format("look up whether {} {} the same in all recordings",
                           listed(followed, "and"), followed.size() > 1 ? "were" : "was");
}

std::string own_not_examined_next(const std::vector<NotExamined>& all,
                                  const RecordingSpans& recordings) {
  const std::vector<NotExamined> own = lacking_covariate(all, Origin::study);
  if (own.empty()) return "";
  const NotExamined& first = own.front();
  const std::string names = lacking_in_words(first, recordings);
  return fmt::format(
      "Next: give {} {}{}, and diagnose again: {}, a term of the study, was not examined.",
      names.empty() ? "the recording" : names, lacked_in_words(first),
      names.empty() ? ""
                    : fmt::format(", or leave {} out", first.lacking.size() > 1 ? "them" : "it"),
      first.term);
}

}  // namespace drift::report
