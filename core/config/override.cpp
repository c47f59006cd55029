#include "core/config/override.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <vector>

#include "core/base/check.hpp"
#include "core/config/load.hpp"
#include "core/config/nearest.hpp"
#include "core/config/quantity.hpp"

namespace drift::config {
namespace {

[[noreturn]] void refuse(const std::string& key, const std::string& text) {
  throw InputError(ExitCode::config, fmt::format("--set {}: {}", key, text));
}

std::vector<std::string> split(const std::string& key) {
  constexpr std::size_t most_parts = 16;
  std::vector<std::string> parts(1);
  char quote = '\0';
  bool was_quoted = false;
  for (const char c : key) {
    if (quote != '\0') {
      if (c == quote)
        quote = '\0';
      else
        parts.back() += c;
    } else if ((c == '"' || c == '\'') && parts.back().empty()) {
      quote = c;
      was_quoted = true;
    } else if (c == '.') {
      if (parts.back().empty() && !was_quoted) break;
      parts.emplace_back();
      was_quoted = false;
    } else {
      parts.back() += c;
    }
  }
  if (quote != '\0') refuse(key, "a quote is left open (expected a dotted key). Close it");
  if (parts.back().empty() && !was_quoted)
    refuse(key,
           "a part of the key is empty (expected a dotted key such as plan.dwell). Write "
           "--set section.key=value");
  if (parts.size() > most_parts)
    refuse(key,
           "the key has too many parts (expected a dotted key such as plan.dwell). Check the key");
  return parts;
}

/// What an element of a list is called: its `name`, of a [[term]] its `key`; null if it has none.
const Node* name_of(const Node& item) {
  for (const char* key : {"name", "key"})
    if (const Node* name = item.find(key); name != nullptr && name->is(Node::Kind::string))
      return name;
  return nullptr;
}

/// The element of a list that a part of a key names, or counts.
std::optional<std::size_t> index_in(const Node& list, const std::string& part) {
  for (std::size_t k = 0; k < list.items.size(); ++k)
    if (const Node* name = name_of(list.items[k]); name != nullptr && name->text == part) return k;
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
  if (error != std::errc() || end != part.data() + part.size()) return std::nullopt;
  return index;
}

Node& element(Node& list, const std::string& part, const std::string& key) {
  const auto index = index_in(list, part);
  if (!index) {
    std::vector<std::string_view> names;
    for (const Node& item : list.items)
      if (const Node* name = name_of(item); name != nullptr) names.push_back(name->text);
    refuse(key,
           fmt::format("there is no element named '{}' (expected a name, or a number from 0 to "
                       "{}). {}",
                       part, list.items.size() - 1, suggestion(part, names, "Count from 0")));
  }
  if (*index >= list.items.size())
    refuse(key, fmt::format("there is no element {} (expected 0 to {}). Count from 0", part,
                            list.items.size() - 1));
  return list.items[*index];
}

/// The node that a key leads to; what is missing on the way is made, as tables.
Node& node_of(Node& root, const std::string& key) {
  const auto parts = split(key);
  Node* at = &root;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (at->is(Node::Kind::array) && !at->items.empty()) {
      at = &element(*at, parts[i], key);
      continue;
    }
    if (!at->is(Node::Kind::table))
      refuse(key,
             fmt::format("'{}' is {}, which has no '{}' (expected the key of a section). Check "
                         "the key",
                         parts[i - 1], describe(*at), parts[i]));
    Node* next = at->find(parts[i]);
    if (next == nullptr) {
      Place place;
      place.set_key = key;
      Node table;
      table.at = place;
      at->members.push_back({parts[i], place, table});
      next = &at->members.back().value;
    }
    at = next;
  }
  return *at;
}

/// The list that a key leads to; null if the tree has none there.
Node* list_of(Node& root, const std::string& key) {
  Node* at = &root;
  for (const std::string& part : split(key)) {
    at =
        at->is(Node::Kind::array) && !at->items.empty() ? &element(*at, part, key) : at->find(part);
    if (at == nullptr) return nullptr;
  }
  return at;
}

void lay_over(Node& into, Node from) {
  const auto is_section = [](const Node& n) {
    return n.is(Node::Kind::table) && !is_distribution(n);
  };
  if (!is_section(into) || !is_section(from)) {
    into = std::move(from);
    return;
  }
  for (Member& m : from.members)
    if (Node* there = into.find(m.key))
      lay_over(*there, std::move(m.value));
    else
      into.members.push_back(std::move(m));
}

}  // namespace

void apply_override(Node& root, const std::string& key, std::string_view value) {
  node_of(root, key) = parse_value(value, key);
}

void apply_overlay(Node& root, const std::string& key, std::string_view value) {
  lay_over(node_of(root, key), parse_value(value, key));
}

std::string numbered(const Node& root, const std::string& key) {
  std::vector<std::string> parts;
  try {
    parts = split(key);
  } catch (const InputError&) {
    return key;
  }
  std::string path;
  const Node* at = &root;
  for (std::string& part : parts) {
    const Node* next = nullptr;
    if (at != nullptr && at->is(Node::Kind::array)) {
      const auto index = index_in(*at, part);
      if (index && *index < at->items.size()) {
        part = std::to_string(*index);
        next = &at->items[*index];
      }
    } else if (at != nullptr) {
      next = at->find(part);
    }
    path += (path.empty() ? "" : ".") + part;
    at = next;
  }
  return path;
}

void apply_addition(Node& root, const std::string& key, std::string_view value) {
  Node* list = list_of(root, key);
  if (list == nullptr)
    refuse(key, fmt::format("nothing stands there that could be added to (expected a list in the "
                            "study file). Write the whole list: --set '{}=[\"a\", \"b\"]'",
                            key));
  if (!list->is(Node::Kind::array))
    refuse(key, fmt::format("{} cannot be added to (expected a list). Replace it with --set {}=...",
                            describe(*list), key));
  Node more = parse_value(value, key);
  if (!more.is(Node::Kind::array)) more = list_node({std::move(more)});
  list->items.insert(list->items.end(), more.items.begin(), more.items.end());
  list->at.added_to = true;
}

}  // namespace drift::config
