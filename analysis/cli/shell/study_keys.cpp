#include "analysis/cli/shell/study_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/config/load.hpp"
#include "mc/study/declared_keys.hpp"

namespace drift::cli {
namespace {

using config::DeclaredKey;
using config::Node;
using Kind = StudyKey::Kind;

/// One study of each kind of test: some keys mean nothing in the other.
constexpr std::string_view studies[] = {"[plan]\n", "[plan]\nkind = \"strapdown\"\n"};

/// A place in the tree: its keys; an element of a list is "0", as the reader calls one without
/// name.
using Way = std::vector<std::string>;
constexpr const char* element = "0";

std::string path_of(const Way& way) {
  std::string path;
  for (const std::string& step : way) path += (path.empty() ? "" : ".") + step;
  return path;
}

/// A table of the tree; made where it is not there.
Node& table_at(Node& root, const Way& way) {
  Node* at = &root;
  for (const std::string& step : way) {
    if (step == element) {
      if (!at->is(Node::Kind::array)) *at = config::list_node({Node{}});
      at = &at->items.front();
    } else {
      if (at->find(step) == nullptr) at->members.push_back({step, {}, Node{}});
      at = at->find(step);
    }
  }
  return *at;
}

/// A study that has every section, and what its reader declares.
struct WholeStudy {
  Node root;
  std::vector<DeclaredKey> declared;
  std::map<std::string, Way> ways = {{"", {}}};  ///< to each section, by the reader's path

  /// Makes what is declared as a section, until no section declares another.
  explicit WholeStudy(Node study) : root(std::move(study)) {
    for (std::size_t known = 0; known != ways.size();) {
      known = ways.size();
      declared = mc::declared_keys(root);
      for (const DeclaredKey& key : declared) {
        if (key.kind != Kind::section && key.kind != Kind::sections) continue;
        const Way way = way_into(key);
        if (ways.emplace(path_of(way), way).second) table_at(root, way);
      }
    }
  }

  /// The way into a section, or into the one element of a list of them.
  Way way_into(const DeclaredKey& key) const {
    Way way = ways.at(key.section);
    way.push_back(key.key);
    if (key.kind == Kind::sections) way.emplace_back(element);
    return way;
  }
};

/// What the reader declares of a key when something stands there: of keys whose kind is said only
/// where they are given.
DeclaredKey declared_when_given(const WholeStudy& study, const DeclaredKey& key) {
  Node root = study.root;
  table_at(root, study.ways.at(key.section))
      .members.push_back({key.key, {}, config::text_node("?")});
  const std::vector<DeclaredKey> declared = mc::declared_keys(root);
  const auto now = std::ranges::find_if(
      declared, [&](const DeclaredKey& d) { return d.section == key.section && d.key == key.key; });
  if (now != declared.end() && now->kind != Kind::unknown) return *now;
  DeclaredKey list = key;  // read item by item: core/physics says of each what it is
  list.kind = Kind::list;
  list.expected = fmt::format("a list of {}", key.key);
  return list;
}

/// The keys of one section. `path`: as it is told, "filter[]".
std::vector<StudyKey> keys_of(const WholeStudy& study, const std::string& section,
                              const std::string& path) {
  std::vector<StudyKey> keys;
  for (const DeclaredKey& asked : study.declared) {
    if (asked.section != section) continue;
    const DeclaredKey d = asked.kind == Kind::unknown ? declared_when_given(study, asked) : asked;
    StudyKey key{.key = d.key,
                 .path = path.empty() ? d.key : path + "." + d.key,
                 .kind = d.kind,
                 .expected = d.expected,
                 .option = d.option,
                 .choices = d.choices,
                 .required = d.required,
                 .keys = {}};
    if (key.kind == Kind::section || key.kind == Kind::sections)
      key.keys = keys_of(study, path_of(study.way_into(d)),
                         key.path + (key.kind == Kind::sections ? "[]" : ""));
    keys.push_back(std::move(key));
  }
  return keys;
}

/// What two kinds of studies know together; required is what both require.
void merge(std::vector<StudyKey>& all, std::vector<StudyKey> more) {
  for (StudyKey& key : more) {
    const auto same = std::ranges::find(all, key.key, &StudyKey::key);
    if (same == all.end()) {
      all.push_back(std::move(key));
      continue;
    }
    same->required = same->required && key.required;
    merge(same->keys, std::move(key.keys));
  }
}

}  // namespace

std::vector<StudyKey> study_keys() {
  std::vector<StudyKey> all;
  for (const std::string_view text : studies)
    merge(all, keys_of(WholeStudy(config::parse_document(text, "study")), "", ""));
  return all;
}

}  // namespace drift::cli
