#include "analysis/cli/shell/study_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include "core/base/check.hpp"
#include "core/config/load.hpp"
#include "mc/study/study.hpp"

namespace drift::cli {
namespace {

using config::Node;
using Kind = StudyKey::Kind;

constexpr std::string_view nobodys = "key_that_nobody_knows";

/// One study of each kind of test: some keys mean nothing in the other.
constexpr std::string_view studies[] = {
    "schema = 1\n[site]\nlatitude = \"45 deg\"\n[plan]\npreset = \"six\"\n",
    "schema = 1\n[plan]\nkind = \"strapdown\"\n"};

std::vector<std::string> messages_of(const Node& root) {
  try {
    mc::read_study_tree(root, "probe");
  } catch (const InputError& error) {
    return error.messages();
  }
  return {};
}

/// What stands between two texts in the first message that has both; nothing if none has.
std::optional<std::string> between(const std::vector<std::string>& messages,
                                   const std::string& before, std::string_view after) {
  for (const std::string& message : messages) {
    const auto at = message.find(before);
    if (at == std::string::npos) continue;
    const auto start = at + before.size(), end = message.find(after, start);
    if (end != std::string::npos) return message.substr(start, end - start);
  }
  return std::nullopt;
}

std::vector<std::string> parted(std::string_view text, std::string_view mark) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const auto end = std::min(text.find(mark, at), text.size());
    parts.emplace_back(text.substr(at, end - at));
    at = end + mark.size();
  }
  return parts;
}

/// A table of the tree, by keys and, in lists, their first element; made where it is not there.
Node& table_at(Node& root, const std::vector<std::string>& way) {
  Node* at = &root;
  for (const std::string& step : way) {
    if (step == "[]") {
      if (!at->is(Node::Kind::array)) *at = config::list_node({Node{}});
      at = &at->items.front();
    } else {
      if (at->find(step) == nullptr) at->members.push_back({step, {}, Node{}});
      at = at->find(step);
    }
  }
  return *at;
}

void put(Node& table, std::string_view key, Node value) {
  if (Node* there = table.find(key))
    *there = std::move(value);
  else
    table.members.push_back({std::string(key), {}, std::move(value)});
}

/// What the reader says of a study with this value at a key.
std::vector<std::string> told_of(Node root, const std::vector<std::string>& way,
                                 std::string_view key, Node value) {
  put(table_at(root, way), key, std::move(value));
  return messages_of(root);
}

std::vector<std::string> told_without(Node root, const std::vector<std::string>& way,
                                      std::string_view key) {
  std::erase_if(table_at(root, way).members,
                [&](const config::Member& member) { return member.key == key; });
  return messages_of(root);
}

Node date_node() {
  Node node;
  node.kind = Node::Kind::date;
  node.text = "2000-01-01";
  return node;
}

/// What an expectation in words asks for.
Kind kind_of(std::string_view expected) {
  constexpr std::pair<std::string_view, Kind> beginnings[] = {
      {"a section [", Kind::section},
      {"a list of sections", Kind::sections},
      {"a table", Kind::table},
      {"a list of three values", Kind::vector},
      {"three rows of three values", Kind::matrix},
      {"a list of", Kind::list},
      {"one of \"", Kind::choice},
      {"true or false", Kind::truth_value},
      {"a whole number", Kind::whole},
      {"a number without unit", Kind::number},
      {"a number with a unit", Kind::quantity}};
  for (const auto& [beginning, kind] : beginnings)
    if (expected.starts_with(beginning)) return kind;
  return Kind::text;
}

/// The range that the reader names when a number is beyond all measure.
std::string range_of(const Node& root, const std::vector<std::string>& way, const StudyKey& key) {
  const Node value = key.kind == Kind::quantity
                         ? config::text_node(fmt::format("1e300 {}", key.unit))
                         : config::real_node(1e300);
  const auto told = told_of(root, way, key.key, value);
  return between(told, key.key + "' = " + config::to_toml(value) + " is out of range (expected ",
                 "). ")
      .value_or("");
}

std::vector<StudyKey> keys_of(const Node& root, const std::vector<std::string>& way,
                              const std::string& path);

/// Asks the reader about one key; nothing if it has no meaning in this study.
std::optional<StudyKey> ask(const Node& root, const std::vector<std::string>& way,
                            const std::string& path, const std::string& name) {
  StudyKey key;
  key.key = name;
  key.path = path.empty() ? name : path + "." + name;
  const auto expected = between(told_of(root, way, name, date_node()),
                                name + "' is the date or time 2000-01-01 (expected ", "). ");
  if (!expected) return std::nullopt;
  key.expected = *expected;
  key.kind = kind_of(key.expected);
  if (key.kind == Kind::choice)  // one of "a", "b"
    key.choices =
        parted(std::string_view(key.expected).substr(8, key.expected.size() - 9), "\", \"");
  if (key.kind == Kind::text)  // some texts are names that the reader lists
    if (const auto names = between(told_of(root, way, name, config::text_node("?")),
                                   name + "' = \"?\" is no preset (expected one of \"", "\"). ")) {
      key.kind = Kind::choice;
      key.choices = parted(*names, "\", \"");
    }
  if (key.kind == Kind::quantity)
    key.unit = between({key.expected}, "such as \"1 ", "\"").value_or("");
  if (key.kind == Kind::quantity || key.kind == Kind::number) key.range = range_of(root, way, key);
  key.required =
      between(told_without(root, way, name), name + "' is missing (expected", ")").has_value();
  auto inner = way;
  inner.push_back(name);
  if (key.kind == Kind::section) key.keys = keys_of(root, inner, key.path);
  if (key.kind == Kind::sections) {
    inner.emplace_back("[]");
    key.keys = keys_of(root, inner, key.path + "[]");
  }
  if (key.kind == Kind::section && key.keys.empty()) key.kind = Kind::table;
  return key;
}

/// The keys of one section; none where any key may stand.
std::vector<StudyKey> keys_of(const Node& root, const std::vector<std::string>& way,
                              const std::string& path) {
  Node probe = root;
  table_at(probe, way);
  const auto told = told_of(probe, way, nobodys, config::text_node("?"));
  const auto known = between(told, std::string(nobodys) + "' (expected one of ", "). ");
  std::vector<StudyKey> keys;
  if (!known) return keys;
  for (const std::string& name : parted(*known, ", "))
    if (auto key = ask(probe, way, path, name)) keys.push_back(std::move(*key));
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
    merge(all, keys_of(config::parse_document(text, "probe"), {}, ""));
  return all;
}

}  // namespace drift::cli
