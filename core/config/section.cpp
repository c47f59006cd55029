#include "core/config/section.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "core/config/nearest.hpp"

namespace drift::config {
namespace {

/// Rows and entries of a Vec3 or Mat3 in the order of the file.
std::string list_text(std::span<const double> si, const Unit& unit) {
  std::vector<std::string> parts;
  for (const double v : si) parts.push_back(quantity_text(v / unit.to_si, unit));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

std::string given_text(const Node& node) {
  return node.is(Node::Kind::string) ? node.text : to_toml(node);
}

/// Among which keys the meant one is looked for: those still free, unless one that stands in the
/// file already is closer by a whole slip (--set of a misspelt key).
const std::vector<std::string_view>& likelier(std::string_view typed,
                                              const std::vector<std::string_view>& free,
                                              const std::vector<std::string_view>& all) {
  const auto best_free = nearest(typed, free), best = nearest(typed, all);
  if (best_free.empty()) return all;
  return typing_distance(typed, best.front()) + 0.95 < typing_distance(typed, best_free.front())
             ? all
             : free;
}

/// A name as a part of a dotted key that --set takes: in quotes where it has dots of its own.
std::string key_part(const std::string& name) {
  if (name.find('.') == std::string::npos) return name;
  const char quote = name.find('"') == std::string::npos ? '"' : '\'';
  return quote + name + quote;
}

/// Stands for a section that is no table, so that its keys are not reported as missing on top.
const Node no_table{};

}  // namespace

Section::Section(Report& report, const Node* table, Place at, std::string path)
    : report_(&report), table_(table), at_(std::move(at)), path_(std::move(path)) {
  if (table_ != nullptr && !table_->is(Node::Kind::table)) {
    report.error(table_->at, fmt::format("'{}' is {} (expected a section [{}] or a table). Write a "
                                         "table of keys and values",
                                         path_, describe(*table_), path_));
    table_ = &no_table;
  }
}

std::string Section::full(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

bool Section::has(std::string_view key) const {
  return table_ != nullptr && table_->find(key) != nullptr;
}

const Node* Section::take(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  return table_ == nullptr ? nullptr : table_->find(key);
}

void Section::wrong(const Node& node, std::string_view key, const std::string& expected,
                    const std::string& fix) {
  report_->error(node.at, fmt::format("'{}' is {} (expected {}). {}", full(key), describe(node),
                                      expected, fix));
}

bool Section::read(const Option& option, double& value) {
  const Node* node = take(option.key);
  if (node == nullptr) {
    report_->assumed(full(option.key), quantity_text(value / option.unit.to_si, option.unit),
                     origin_);
    return false;
  }
  const auto q = read_quantity(*report_, *node, full(option.key), option);
  if (!q) return false;
  value = q->si();
  report_->given(full(option.key), given_text(*node), node->at);
  return true;
}

bool Section::read(const Option& option, std::optional<double>& value) {
  if (!has(option.key)) {
    take(option.key);
    return false;
  }
  double given = 0.0;
  if (!read(option, given)) return false;
  value = given;
  return true;
}

bool Section::read(const Option& option, Vec3& value) {
  const Node* node = take(option.key);
  if (node == nullptr) {
    report_->assumed(full(option.key), list_text({value.data(), 3}, option.unit), origin_);
    return false;
  }
  if (!node->is(Node::Kind::array) || node->items.size() != 3) {
    wrong(*node, option.key, "a list of three values", "Give one value per axis x, y, z");
    return false;
  }
  Vec3 given;
  bool right = true;
  for (int i = 0; i < 3; ++i) {
    const auto q = read_quantity(*report_, node->items[i], full(option.key), option);
    right = right && q;
    if (q) given[i] = q->si();
  }
  if (!right) return false;
  value = given;
  report_->given(full(option.key), to_toml(*node), node->at);
  return true;
}

bool Section::read(const Option& option, Mat3& value) {
  const Node* node = take(option.key);
  if (node == nullptr) {
    const Mat3 rows = value.transpose();
    report_->assumed(full(option.key), list_text({rows.data(), 9}, option.unit), origin_);
    return false;
  }
  const auto is_row = [](const Node& row) {
    return row.is(Node::Kind::array) && row.items.size() == 3;
  };
  if (!node->is(Node::Kind::array) || node->items.size() != 3 ||
      !std::all_of(node->items.begin(), node->items.end(), is_row)) {
    wrong(*node, option.key, "three rows of three values",
          "Write [[a, b, c], [d, e, f], [g, h, i]]");
    return false;
  }
  Mat3 given;
  bool right = true;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const auto q = read_quantity(*report_, node->items[i].items[k], full(option.key), option);
      right = right && q;
      if (q) given(i, k) = q->si();
    }
  if (!right) return false;
  value = given;
  report_->given(full(option.key), to_toml(*node), node->at);
  return true;
}

bool Section::read(const Option& option, bool& value) {
  const Node* node = take(option.key);
  if (node == nullptr) {
    report_->assumed(full(option.key), value ? "true" : "false", origin_);
    return false;
  }
  if (!node->is(Node::Kind::boolean)) {
    wrong(*node, option.key, "true or false", "Write true or false without quotes");
    return false;
  }
  value = node->boolean;
  report_->given(full(option.key), to_toml(*node), node->at);
  return true;
}

bool Section::read(const Option& option, std::string& value) {
  constexpr std::size_t longest = 200;
  const Node* node = take(option.key);
  if (node == nullptr) {
    report_->assumed(full(option.key), value, origin_);
    return false;
  }
  const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  if (!node->is(Node::Kind::string) || node->text.size() > longest ||
      std::any_of(node->text.begin(), node->text.end(), control)) {
    wrong(*node, option.key, fmt::format("a text of one line, at most {} bytes", longest),
          node->is(Node::Kind::string) ? "Shorten it to one line" : "Put it in quotes");
    return false;
  }
  value = node->text;
  report_->given(full(option.key), value, node->at);
  return true;
}

bool Section::read_whole(const Option& option, std::uint64_t& value) {
  const Node* node = take(option.key);
  if (node == nullptr) {
    report_->assumed(full(option.key), fmt::format("{}", value), origin_);
    return false;
  }
  std::uint64_t given = 0;
  bool right = node->is(Node::Kind::integer) && node->integer >= 0;
  if (right) {
    given = static_cast<std::uint64_t>(node->integer);
  } else if (node->is(Node::Kind::string) && node->text.starts_with("0x")) {
    const char* end = node->text.data() + node->text.size();
    const auto [stop, error] = std::from_chars(node->text.data() + 2, end, given, 16);
    right = error == std::errc() && stop == end;
  }
  // The largest 64-bit number is no double: a maximum that great bounds nothing.
  const double largest = 0x1p64;
  if (!right || !(static_cast<double>(given) >= option.min) ||
      !(static_cast<double>(given) <= std::min(option.max, largest))) {
    wrong(*node, option.key,
          option.max >= largest
              ? std::string("a whole number from 0 to 2^64-1, beyond 2^63-1 as \"0x...\"")
              : fmt::format("a whole number from {:.0f} to {:.0f}", option.min, option.max),
          node->is(Node::Kind::integer) ? "Choose one in that range"
          : node->is(Node::Kind::real)  ? "Write it without point and exponent"
                                        : "Write a whole number without quotes");
    return false;
  }
  value = given;
  report_->given(full(option.key), given_text(*node), node->at);
  return true;
}

bool Section::read(const Option& option, std::uint64_t& value) {
  return read_whole(option, value);
}

bool Section::read(const Option& option, int& value) {
  auto wide = static_cast<std::uint64_t>(value);
  const bool given = read_whole(option, wide);
  value = static_cast<int>(wide);
  return given;
}

std::optional<std::size_t> Section::choose(const Option& option,
                                           std::span<const std::string_view> names) {
  const Node* node = take(option.key);
  if (node == nullptr) return std::nullopt;
  if (node->is(Node::Kind::string))
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == node->text) {
        report_->given(full(option.key), node->text, node->at);
        return i;
      }
  const std::string expected = fmt::format("one of \"{}\"", fmt::join(names, "\", \""));
  wrong(*node, option.key, expected,
        node->is(Node::Kind::string) ? suggestion(node->text, names) : "Put one of them in quotes");
  return std::nullopt;
}

bool Section::require(std::string_view key, std::string_view example) {
  take(key);  // known, present or not
  if (has(key) || table_ == &no_table) return true;
  report_->error(at_, fmt::format("'{}' is missing (expected {}). Add it{}", full(key), example,
                                  path_.empty() ? "" : fmt::format(" to [{}]", path_)));
  return false;
}

Section Section::section(std::string_view key) {
  const Node* node = take(key);
  return Section(*report_, node, node == nullptr ? at_ : node->at, full(key));
}

std::vector<Section> Section::sections(std::string_view key) {
  std::vector<Section> all;
  const Node* node = take(key);
  if (node == nullptr) return all;
  if (!node->is(Node::Kind::array)) {
    wrong(*node, key, fmt::format("a list of sections, each headed [[{}]]", full(key)),
          fmt::format("Write [[{}]] with double brackets", full(key)));
    return all;
  }
  for (const auto& item : node->items) {
    const Node* name = item.find("name");
    const std::string called = name != nullptr && name->is(Node::Kind::string)
                                   ? name->text
                                   : fmt::format("{}", all.size());
    all.emplace_back(*report_, &item, item.at, fmt::format("{}.{}", full(key), key_part(called)));
  }
  return all;
}

void Section::finish() {
  if (table_ == nullptr) return;
  std::vector<std::string_view> free;  // a key that stands in the file already is hardly meant
  for (const auto& key : known_)
    if (table_->find(key) == nullptr) free.push_back(key);
  const std::vector<std::string_view> all(known_.begin(), known_.end());
  for (const auto& member : table_->members) {
    if (std::find(known_.begin(), known_.end(), member.key) != known_.end()) continue;
    const auto& candidates = likelier(member.key, free, all);
    report_->error(member.at,
                   fmt::format("unknown key '{}' (expected one of {}). {}", full(member.key),
                               fmt::join(all, ", "),
                               suggestion(member.key, candidates, "Remove it or correct it")));
  }
}

}  // namespace drift::config
