#include <fmt/format.h>

#include <algorithm>

#include "core/config/node.hpp"

namespace drift::config {
namespace {

std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20 || byte == 0x7f) {
      out += fmt::format("\\u{:04X}", byte);
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string key_text(std::string_view key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
  return bare ? std::string(key) : in_quotes(key);
}

/// TOML wants a real number to look like one: 5 would read back as an integer.
std::string real_text(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".einf") == std::string::npos) text += ".0";
  return text;
}

bool is_section(const Node& value) {
  return value.is(Node::Kind::table);
}

/// [[name]] needs an array of tables that is not empty.
bool is_section_list(const Node& value) {
  return value.is(Node::Kind::array) && !value.items.empty() &&
         std::all_of(value.items.begin(), value.items.end(), is_section);
}

/// Whether a plain key comes behind a section or a list of them.
bool has_plain_last(const Node& table) {
  bool seen = false;
  for (const Member& m : table.members) {
    const bool section = is_section(m.value) || is_section_list(m.value);
    if (seen && !section) return true;
    seen = seen || section;
  }
  return false;
}

void write_table(const Node& table, const std::string& path, int depth, std::string& out) {
  constexpr int deepest_header = 2;  // below that tables are written in line
  // The order of [sweep] numbers the points of a study, and no plain key can stand below a header.
  const bool in_line = path == "sweep" && has_plain_last(table);
  const auto apart = [&](const Node& v) {
    return !in_line && depth < deepest_header && (is_section(v) || is_section_list(v));
  };
  for (const auto& member : table.members)
    if (!apart(member.value))
      out += fmt::format("{} = {}\n", key_text(member.key), to_toml(member.value));
  for (const auto& member : table.members) {
    if (!apart(member.value)) continue;
    const std::string name = path + (path.empty() ? "" : ".") + key_text(member.key);
    if (is_section(member.value)) {
      out += fmt::format("\n[{}]\n", name);
      write_table(member.value, name, depth + 1, out);
    } else {
      for (const auto& item : member.value.items) {
        out += fmt::format("\n[[{}]]\n", name);
        write_table(item, name, depth + 1, out);
      }
    }
  }
}

std::string shortened(std::string text) {
  constexpr std::size_t longest = 60;
  if (text.size() <= longest) return text;
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;  // whole UTF-8
  return text.substr(0, end) + "...";
}

}  // namespace

std::string to_toml(const Node& value) {
  switch (value.kind) {
    case Node::Kind::string:
      return in_quotes(value.text);
    case Node::Kind::integer:
      return fmt::format("{}", value.integer);
    case Node::Kind::real:
      return real_text(value.real);
    case Node::Kind::boolean:
      return value.boolean ? "true" : "false";
    case Node::Kind::date:
      return value.text;
    case Node::Kind::array: {
      std::string out;
      for (const auto& item : value.items) out += (out.empty() ? "" : ", ") + to_toml(item);
      return "[" + out + "]";
    }
    case Node::Kind::table: {
      std::string out;
      for (const auto& member : value.members)
        out += fmt::format("{}{} = {}", out.empty() ? "" : ", ", key_text(member.key),
                           to_toml(member.value));
      return out.empty() ? "{}" : "{ " + out + " }";
    }
  }
  return {};
}

std::string to_document(const Node& root) {
  std::string out;
  write_table(root, "", 0, out);
  return out;
}

std::string describe(const Node& value) {
  switch (value.kind) {
    case Node::Kind::string:
      return "the string " + shortened(to_toml(value));
    case Node::Kind::integer:
    case Node::Kind::real:
      return "the number " + to_toml(value);
    case Node::Kind::boolean:
      return "the truth value " + to_toml(value);
    case Node::Kind::date:
      return "the date or time " + to_toml(value);
    case Node::Kind::array:
      return "the list " + shortened(to_toml(value));
    case Node::Kind::table:
      return "a section or table";
  }
  return {};
}

}  // namespace drift::config
