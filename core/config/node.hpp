#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drift::config {

/// Where a value or key was written: line and column of the file, or the key of a `--set`.
struct Place {
  int line = 1;
  int column = 1;
  std::string set_key;    ///< not empty: it came from --set of this key
  bool added_to = false;  ///< of a list: --set added to what stands there
};

struct Member;

/// A value of a configuration file, independent of the library that parsed it. Tables keep the
/// order of the file.
struct Node {
  enum class Kind { table, array, string, integer, real, boolean, date };
  Kind kind = Kind::table;
  Place at;
  std::string text;  ///< of a string; of a date as written
  std::int64_t integer = 0;
  double real = 0.0;
  bool boolean = false;
  std::vector<Member> members;  ///< of a table
  std::vector<Node> items;      ///< of an array

  bool is(Kind k) const { return kind == k; }
  const Node* find(std::string_view key) const;
  Node* find(std::string_view key);
};

/// One key of a table and its value.
struct Member {
  std::string key;
  Place at;
  Node value;
};

inline const Node* Node::find(std::string_view key) const {
  for (const auto& member : members)
    if (member.key == key) return &member.value;
  return nullptr;
}
inline Node* Node::find(std::string_view key) {
  for (auto& member : members)
    if (member.key == key) return &member.value;
  return nullptr;
}

/// Values that no file holds yet.
inline Node text_node(std::string text) {
  Node node;
  node.kind = Node::Kind::string;
  node.text = std::move(text);
  return node;
}
inline Node real_node(double value) {
  Node node;
  node.kind = Node::Kind::real;
  node.real = value;
  return node;
}
inline Node list_node(std::vector<Node> items) {
  Node node;
  node.kind = Node::Kind::array;
  node.items = std::move(items);
  return node;
}

/// The value as TOML, on one line: `"112 arcsec"`, `{ normal = ["1 deg", "2 deg"] }`.
std::string to_toml(const Node& value);

/// A whole table as a TOML document, sections after values; it reads back to the same tree.
std::string to_document(const Node& root);

/// What a value is, for messages: `the string "abc"`, `the number 3`, `a section`.
std::string describe(const Node& value);

}  // namespace drift::config
