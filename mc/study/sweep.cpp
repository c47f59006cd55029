#include "mc/study/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/check.hpp"
#include "core/base/fnv.hpp"
#include "core/config/load.hpp"
#include "mc/study/own_terms_check.hpp"

namespace drift::mc {
namespace {

using config::Node;

/// Two of a million points share an id with a probability of 3e-8.
std::string hash_of(std::string_view text) {
  return fmt::format("{:016x}", fnv1a<std::uint64_t>(text));
}

/// A value as people say it: a plain string without its quotes.
std::string plain(std::string text) {
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  if (quoted && text.find_first_of("\"\\", 1) == text.size() - 1)
    return text.substr(1, text.size() - 2);
  return text;
}

StudyPoint make_point(const Node& base, const Study& study,
                      const std::vector<std::size_t>& choice) {
  StudyPoint point;
  Node root = base;
  for (std::size_t a = 0; a < study.sweep.size(); ++a) {
    const SweepAxis& axis = study.sweep[a];
    const std::string& value = axis.values[choice[a]];
    apply_sweep_value(root, axis.key, value);
    point.values.emplace_back(axis.key, plain(value));
    point.label +=
        fmt::format("{}{} = {}", a == 0 ? "" : ", ", axis.key, point.values.back().second);
  }
  try {
    point.study = read_study_tree(root, study.path);
  } catch (const InputError& error) {
    std::vector<std::string> messages;
    for (const auto& message : error.messages())
      messages.push_back(
          fmt::format("{}: at the study point {}: {}", study.path, point.label, message));
    throw InputError(ExitCode::config, messages);
  }
  point.study.text = config::to_document(root);
  point.id = hash_of(point.study.text);
  return point;
}

}  // namespace

std::vector<StudyPoint> study_points(const Study& study) {
  require_own_terms(study);
  if (study.sweep.empty()) {
    StudyPoint point{hash_of(study.text), "", {}, study};
    return {std::move(point)};
  }
  Node base = config::parse_document(study.text, study.path);
  std::erase_if(base.members, [](const auto& member) { return member.key == "sweep"; });
  std::vector<StudyPoint> points;
  std::vector<std::size_t> choice(study.sweep.size(), 0);
  for (bool more = true; more;) {
    points.push_back(make_point(base, study, choice));
    more = false;
    for (std::size_t a = choice.size(); a-- > 0 && !more;) {
      more = ++choice[a] < study.sweep[a].values.size();
      if (!more) choice[a] = 0;
    }
  }
  return points;
}

}  // namespace drift::mc
