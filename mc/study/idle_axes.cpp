#include "mc/study/idle_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/base/check.hpp"
#include "core/base/words.hpp"
#include "core/physics/own/own_terms.hpp"
#include "mc/study/no_effect.hpp"
#include "mc/study/run_inputs.hpp"
#include "mc/study/sweep_config.hpp"

namespace drift::mc {
namespace {

using config::Node;

/// Numbers of the values of all axes at a study point.
using Choice = std::vector<std::size_t>;

/// Points of a sweep, each read once.
class PointsRead {
 public:
  PointsRead(const Node& root, const Study& study) : base_(root), study_(&study) {
    std::erase_if(base_.members, [](const config::Member& m) { return m.key == "sweep"; });
  }

  Node tree(const Choice& choice) const {
    Node root = base_;
    for (std::size_t a = 0; a < choice.size(); ++a)
      apply_sweep_value(root, study_->sweep[a].key, study_->sweep[a].values[choice[a]]);
    return root;
  }
  /// What its runs depend on; empty of a point that has none, or that cannot be read.
  const std::string& inputs(const Choice& choice) {
    const auto [at, is_new] = known_.try_emplace(choice);
    if (is_new) try {
        at->second = run_inputs(read_study_tree(tree(choice), study_->path));
      } catch (const InputError&) {
        at->second.clear();  // study_points() says what is wrong
      }
    return at->second;
  }
  bool enough() const { return known_.size() >= most; }

 private:
  static constexpr std::size_t most = 4000;
  Node base_;
  const Study* study_;
  std::map<Choice, std::string> known_;
};

/// The next values of all axes but one; false behind the last.
bool next_beside(std::size_t axis, const std::vector<SweepAxis>& sweep, Choice& choice) {
  for (std::size_t a = choice.size(); a-- > 0;) {
    if (a == axis) continue;
    if (++choice[a] < sweep[a].values.size()) return true;
    choice[a] = 0;
  }
  return false;
}

bool changes_something(std::size_t axis, const std::vector<SweepAxis>& sweep, PointsRead& points) {
  Choice choice(sweep.size(), 0);
  do {
    const std::string first = points.inputs(choice);
    for (std::size_t k = 1; k < sweep[axis].values.size(); ++k) {
      choice[axis] = k;
      if (first.empty() || points.inputs(choice) != first || points.enough()) return true;
    }
    choice[axis] = 0;
  } while (next_beside(axis, sweep, choice));
  return false;
}

NoEffect reason_of(const config::Member& line, const Node& root, const Node& point,
                   const std::string& path) {
  const NoEffect any{"the runs are the same with each of its values",
                     "Remove the line, or sweep what they depend on"};
  const std::vector<std::string> keys = keys_set_by(line, root);
  if (keys == std::vector<std::string>{"site.gravity"})
    return {"runs are simulated in local g, gravity is for recordings in m/s^2", "Remove the line"};
  const Study study = read_study_tree(point, path);
  std::vector<std::string> reasons;
  NoEffect last = any;
  for (const std::string& key : keys) {
    const auto why = no_effect(point, study, key);
    if (!why) return any;
    last = *why;
    if (std::ranges::find(reasons, why->why) == reasons.end()) reasons.push_back(why->why);
  }
  if (reasons.size() > 1) last.what_to_do = any.what_to_do;
  last.why = listed(reasons, "and");
  return last;
}

std::string place_text(const config::Member& line, const std::string& path) {
  const config::Place& at = line.value.at.set_key.empty() ? line.at : line.value.at;
  return at.set_key.empty() ? fmt::format("{}:{}:{}", path, at.line, at.column)
                            : fmt::format("--set {}", at.set_key);
}

}  // namespace

void refuse_idle_axes(const Node& root, const Study& study) {
  const Node* sweep = root.find("sweep");
  if (sweep == nullptr) return;
  const KeptOwnTerms kept;
  PointsRead points(root, study);
  std::vector<std::string> messages;
  for (std::size_t a = 0; a < study.sweep.size(); ++a) {
    if (study.sweep[a].values.size() < 2 || changes_something(a, study.sweep, points)) continue;
    const config::Member& line = sweep->members[a];
    const NoEffect why =
        reason_of(line, root, points.tree(Choice(study.sweep.size(), 0)), study.path);
    messages.push_back(fmt::format(
        "{}: 'sweep.\"{}\"' changes nothing: {} (expected a key that the runs depend on: its "
        "points would be one and the same). {}",
        place_text(line, study.path), line.key, why.why, why.what_to_do));
  }
  if (!messages.empty()) throw InputError(ExitCode::config, messages);
}

}  // namespace drift::mc
