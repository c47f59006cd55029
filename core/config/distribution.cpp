#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/config/nearest.hpp"
#include "core/config/quantity.hpp"

namespace drift::config {
namespace {

constexpr std::array<std::string_view, 2> kinds = {"normal", "uniform"};

std::string expected_prior(const Unit& unit) {
  const std::string_view symbol = unit.symbol.view() == "1" ? "" : unit.symbol.view();
  const auto value = [&](int n) {
    return symbol.empty() ? fmt::format("{}", n) : fmt::format("\"{} {}\"", n, symbol);
  };
  return fmt::format("{}, {{ normal = [{}, {}] }} or {{ uniform = [{}, {}] }}", value(1), value(0),
                     value(1), value(-1), value(1));
}

/// "normal(0, 3) deg/h", as check prints it, as the table that a file has; empty if it is none.
std::optional<Node> written_out(const Node& node) {
  if (!node.is(Node::Kind::string)) return std::nullopt;
  const std::string_view text = node.text;
  const auto open = text.find('('), comma = text.find(','), close = text.rfind(')');
  if (close == std::string_view::npos || !(open < comma && comma < close)) return std::nullopt;
  const auto kind = std::find(kinds.begin(), kinds.end(), text.substr(0, open));
  if (kind == kinds.end()) return std::nullopt;
  const auto bound = [&](std::string_view number) {
    Node value = text_node(fmt::format("{}{}", number, text.substr(close + 1)));
    value.at = node.at;
    return value;
  };
  Node table, bounds = list_node({bound(text.substr(open + 1, comma - open - 1)),
                                  bound(text.substr(comma + 1, close - comma - 1))});
  table.at = bounds.at = node.at;
  table.members.push_back({std::string(*kind), node.at, std::move(bounds)});
  return table;
}

}  // namespace

bool is_distribution(const Node& node) {
  return node.is(Node::Kind::table) && node.members.size() == 1 &&
         std::ranges::find(kinds, node.members.front().key) != kinds.end();
}

std::optional<Prior> read_prior(Report& report, const Node& node, std::string_view key,
                                const Option& option) {
  if (const auto table = written_out(node)) return read_prior(report, *table, key, option);
  if (!node.is(Node::Kind::table)) {
    const auto value = read_quantity(report, node, key, option);
    if (!value) return std::nullopt;
    return fixed(value->in(option.unit));
  }
  const auto wrong = [&](const Place& at, const std::string& what, const std::string& fix) {
    report.error(
        at, fmt::format("'{}' {} (expected {}). {}", key, what, expected_prior(option.unit), fix));
    return std::nullopt;
  };
  if (node.members.size() != 1)
    return wrong(node.at,
                 fmt::format("has {} entries where one distribution is meant", node.members.size()),
                 "Name one distribution");
  const Member& kind = node.members.front();
  if (std::find(kinds.begin(), kinds.end(), kind.key) == kinds.end())
    return wrong(kind.at, fmt::format("has the unknown distribution '{}'", kind.key),
                 suggestion(kind.key, kinds));
  const bool is_normal = kind.key == kinds[0];
  if (!kind.value.is(Node::Kind::array) || kind.value.items.size() != 2)
    return wrong(kind.value.at, fmt::format("has a {} that is {}", kind.key, describe(kind.value)),
                 is_normal ? "Give mean and 1 sigma" : "Give the lower and the upper bound");
  const auto a = read_quantity(report, kind.value.items[0], key, option);
  Option second = option;
  second.difference = option.difference || is_normal;  // a sigma
  const auto b = read_quantity(report, kind.value.items[1], key, second);
  if (!a || !b) return std::nullopt;
  if (is_normal && !(b->value > 0.0))
    return wrong(
        kind.value.items[1].at,
        fmt::format("has the 1 sigma {}, which is not positive", to_toml(kind.value.items[1])),
        "Write the plain value if it is exactly known");
  const double low = a->in(option.unit), high = b->in(option.unit);
  if (!is_normal && !(low < high))
    return wrong(kind.value.items[1].at,
                 fmt::format("has the upper bound {}, which is not above the lower bound {}",
                             to_toml(kind.value.items[1]), to_toml(kind.value.items[0])),
                 "Give the lower bound first");
  return is_normal ? normal(low, high) : uniform(low, high);
}

std::string prior_text(const Prior& prior, const Unit& unit) {
  const std::string symbol =
      unit.symbol.view() == "1" ? "" : fmt::format(" {}", unit.symbol.view());
  switch (prior.kind) {
    case Prior::Kind::normal:
      return fmt::format("normal({:.12g}, {:.12g}){}", prior.a, prior.b, symbol);
    case Prior::Kind::uniform:
      return fmt::format("uniform({:.12g}, {:.12g}){}", prior.a, prior.b, symbol);
    case Prior::Kind::fixed:
      break;
  }
  return quantity_text(prior.a, unit);
}

}  // namespace drift::config
