// The only file that sees the TOML library.
#define TOML_ASSERT(condition) static_cast<void>(0)  // "[ {" would abort a debug build
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>
#include <tuple>

#include "core/base/check.hpp"
#include "core/config/load.hpp"

namespace drift::config {
namespace {

constexpr int deepest = 32;  // tables and arrays inside each other

[[noreturn]] void refuse(const std::string& name, const Place& at, const std::string& text) {
  throw InputError(ExitCode::config, fmt::format("{}:{}:{}: {}", name, at.line, at.column, text));
}

Place place(const toml::source_region& source) {
  return {static_cast<int>(source.begin.line), static_cast<int>(source.begin.column), {}};
}

/// Dotted keys nest without limit in the library, whose recursion would then overflow the stack.
/// Counts the dots since the last thing that is not part of a key.
void check_dotted_keys(std::string_view text, const std::string& name) {
  char quote = '\0';
  bool comment = false;
  int dots = 0, line = 1, column = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    ++column;
    if (c == '\n') {
      quote = '\0';
      comment = false;
      dots = column = 0;
      ++line;
    } else if (comment) {
      continue;
    } else if (quote != '\0') {
      if (quote == '"' && c == '\\')
        ++i, ++column;
      else if (c == quote)
        quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      comment = true;
    } else if (c == '=' || c == ',' || c == '{' || c == '}' || c == '[' || c == ']') {
      dots = 0;
    } else if (c == '.' && ++dots > deepest) {
      refuse(name, {line, column, {}},
             fmt::format("a key of more than {} parts (expected e.g. truth.parameters.eta_x). "
                         "Check the key",
                         deepest));
    }
  }
}

class Converter {
 public:
  explicit Converter(std::string name) : name_(std::move(name)) {}

  Node convert(const toml::node& from, int depth) const {
    Node to;
    to.at = place(from.source());
    if (depth > deepest)
      refuse(name_, to.at,
             fmt::format("nested deeper than {} levels (expected a study file). Check the brackets",
                         deepest));
    from.visit([&](const auto& value) { fill(to, value, depth); });
    return to;
  }

 private:
  void fill(Node& to, const toml::table& from, int depth) const {
    to.kind = Node::Kind::table;
    for (const auto& [key, value] : from)
      to.members.push_back(
          {std::string(key.str()), place(key.source()), convert(value, depth + 1)});
    // The library sorts by name; readers and messages want the order of the file.
    std::stable_sort(to.members.begin(), to.members.end(), [](const Member& a, const Member& b) {
      return std::tie(a.at.line, a.at.column) < std::tie(b.at.line, b.at.column);
    });
  }
  void fill(Node& to, const toml::array& from, int depth) const {
    to.kind = Node::Kind::array;
    for (const auto& item : from) to.items.push_back(convert(item, depth + 1));
  }
  void fill(Node& to, const toml::value<std::string>& from, int) const {
    to.kind = Node::Kind::string;
    to.text = *from;
  }
  void fill(Node& to, const toml::value<std::int64_t>& from, int) const {
    to.kind = Node::Kind::integer;
    to.integer = *from;
  }
  void fill(Node& to, const toml::value<double>& from, int) const {
    to.kind = Node::Kind::real;
    to.real = *from;
  }
  void fill(Node& to, const toml::value<bool>& from, int) const {
    to.kind = Node::Kind::boolean;
    to.boolean = *from;
  }
  template <class T>
  void fill(Node& to, const toml::value<T>& from, int) const {
    to.kind = Node::Kind::date;
    std::ostringstream text;
    text << *from;
    to.text = text.str();
  }

  std::string name_;
};

void mark(Node& node, const std::string& set_key) {
  node.at.set_key = set_key;
  for (auto& item : node.items) mark(item, set_key);
  for (auto& member : node.members) {
    member.at.set_key = set_key;
    mark(member.value, set_key);
  }
}

}  // namespace

Node parse_document(std::string_view text, const std::string& name) {
  check_dotted_keys(text, name);
  toml::table table;
  try {
    table = toml::parse(text);
  } catch (const toml::parse_error& error) {
    const bool again = error.description().find("redefine") != std::string_view::npos;
    refuse(name, place(error.source()),
           fmt::format("not valid TOML: {} (expected {}). {}", error.description(),
                       again ? "every key and section once"
                             : "lines such as key = \"60 min\" under [section] headers",
                       again ? "Remove one of the two" : "Correct the line"));
  }
  return Converter(name).convert(table, 0);
}

Node parse_value(std::string_view text, const std::string& set_key) {
  const auto first = text.find_first_not_of(" \t");
  const auto last = text.find_last_not_of(" \t");
  text = first == std::string_view::npos ? "" : text.substr(first, last - first + 1);
  Node value = text_node(std::string(text));
  try {
    // A line break could smuggle in a second key.
    if (text.find_first_of("\r\n") == std::string_view::npos) {
      const std::string line = fmt::format("v = {}", text);
      check_dotted_keys(line, "--set");
      const toml::table table = toml::parse(line);
      value = Converter("--set").convert(*table.get("v"), 0);
    }
  } catch (const toml::parse_error& error) {
    if (!text.empty() && std::string_view("[{\"'").find(text.front()) != std::string_view::npos)
      throw InputError(
          ExitCode::config,
          fmt::format("--set {}: not a valid TOML value: {} (expected e.g. \"20 arcsec\", 0.5, or "
                      "{{ normal = [\"0 arcsec\", \"20 arcsec\"] }}). Correct '{}'",
                      set_key, error.description(), text));
  }
  mark(value, set_key);
  return value;
}

}  // namespace drift::config
