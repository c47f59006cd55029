// How a section reads the value of a key, by what it is read into.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "core/config/nearest.hpp"
#include "core/config/section.hpp"

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

}  // namespace

bool Section::read(const Option& option, double& value) {
  const Node* node = take_number(option);
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
    take_number(option);
    return false;
  }
  double given = 0.0;
  if (!read(option, given)) return false;
  value = given;
  return true;
}

bool Section::read(const Option& option, Vec3& value) {
  const Node* node = take(option.key, Kind::vector, expected_vector);
  if (node == nullptr) {
    report_->assumed(full(option.key), list_text({value.data(), 3}, option.unit), origin_);
    return false;
  }
  if (!node->is(Node::Kind::array) || node->items.size() != 3) {
    wrong(*node, option.key, expected_vector, "Give one value per axis x, y, z");
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
  const Node* node = take(option.key, Kind::matrix, expected_matrix);
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
    wrong(*node, option.key, expected_matrix, "Write [[a, b, c], [d, e, f], [g, h, i]]");
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
  const Node* node = take(option.key, Kind::truth_value, expected_truth_value);
  if (node == nullptr) {
    report_->assumed(full(option.key), value ? "true" : "false", origin_);
    return false;
  }
  if (!node->is(Node::Kind::boolean)) {
    wrong(*node, option.key, expected_truth_value, "Write true or false without quotes");
    return false;
  }
  value = node->boolean;
  report_->given(full(option.key), to_toml(*node), node->at);
  return true;
}

bool Section::read(const Option& option, std::string& value) {
  const Node* node = take(option.key, Kind::text, expected_text());
  if (node == nullptr) {
    report_->assumed(full(option.key), value, origin_);
    return false;
  }
  const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  if (!node->is(Node::Kind::string) || node->text.size() > longest_text ||
      std::any_of(node->text.begin(), node->text.end(), control)) {
    wrong(*node, option.key, expected_text(),
          node->is(Node::Kind::string) ? "Shorten it to one line" : "Put it in quotes");
    return false;
  }
  value = node->text;
  report_->given(full(option.key), value, node->at);
  return true;
}

bool Section::read_whole(const Option& option, std::uint64_t& value) {
  const Node* node = take(option.key);
  if (report().keeps_declared())
    report().declare(declared_whole(path_, std::string(option.key), option));
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
    wrong(*node, option.key, expected_whole(option),
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
  choices(option.key, names);
  const Node* node = take(option.key);
  if (node == nullptr) return std::nullopt;
  if (node->is(Node::Kind::string))
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == node->text) {
        report_->given(full(option.key), node->text, node->at);
        return i;
      }
  const std::string expected =
      expected_choice(std::vector<std::string>(names.begin(), names.end()));
  wrong(*node, option.key, expected,
        node->is(Node::Kind::string) ? suggestion(node->text, names) : "Put one of them in quotes");
  return std::nullopt;
}

}  // namespace drift::config
