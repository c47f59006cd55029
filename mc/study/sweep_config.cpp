#include "mc/study/sweep_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/config/override.hpp"
#include "core/config/quantity.hpp"
#include "core/config/section.hpp"

namespace drift::mc {
namespace {

using config::Node;
using config::Report;

/// The keys that a value under a key sets: those of the members of tables, else the key itself.
void add_keys(const std::string& key, const Node& value, std::vector<std::string>& keys) {
  if (!value.is(Node::Kind::table) || config::is_distribution(value)) {
    if (std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
    return;
  }
  for (const config::Member& m : value.members) add_keys(key + "." + m.key, m.value, keys);
}

/// Whether one key is the other or holds it.
bool meet(std::string_view a, std::string_view b) {
  if (a.size() > b.size()) std::swap(a, b);
  return b.starts_with(a) && (b.size() == a.size() || b[a.size()] == '.');
}

/// A key that two lines set: one of the two would be without effect.
void refuse_keys_set_twice(Report& report, const Node& sweep, const Node& root) {
  for (std::size_t k = 1; k < sweep.members.size(); ++k)
    for (std::size_t n = 0; n < k; ++n)
      for (const std::string& key : keys_set_by(sweep.members[k], root)) {
        const auto other = keys_set_by(sweep.members[n], root);
        if (std::ranges::none_of(other, [&](const std::string& o) { return meet(key, o); }))
          continue;
        report.error(
            sweep.members[k].at,
            fmt::format("'sweep.\"{}\"' sets {}, and so does 'sweep.\"{}\"' (expected each "
                        "key in one line: one value would be without effect). Remove it "
                        "from one of them",
                        sweep.members[k].key, key, sweep.members[n].key));
        break;
      }
}

/// Whether two values, written as TOML, are one: "20 min" is "1200 s".
bool same(std::string_view a, std::string_view b) {
  const auto quantity = [](std::string_view text) {
    if (text.size() >= 2 && text.front() == '"') text = text.substr(1, text.size() - 2);
    return config::quantity_in(text);
  };
  if (a == b) return true;
  const auto x = quantity(a), y = quantity(b);
  constexpr double rounding = 1e-12;  // of a conversion
  return x && y && x->unit.same_dimension(y->unit) &&
         std::abs(x->si() - y->si()) <= rounding * std::abs(x->si());
}

}  // namespace

std::vector<std::string> keys_set_by(const config::Member& line, const Node& root) {
  std::vector<std::string> keys;
  const std::string key = config::numbered(root, line.key);
  for (const Node& value : line.value.items) add_keys(key, value, keys);
  return keys;
}

std::vector<SweepAxis> read_sweep(Report& report, const Node& root) {
  constexpr std::size_t most_values = 10000;
  constexpr double most_points = 1e6;
  std::vector<SweepAxis> axes;
  const Node* sweep = root.find("sweep");
  if (sweep == nullptr) return axes;
  double points = 1.0;
  config::Section section(report, sweep, sweep->at, "sweep");
  for (const auto& member : sweep->members) {
    const Node& values = member.value;
    if (!values.is(Node::Kind::array) || values.items.empty() ||
        values.items.size() > most_values) {
      report.error(
          values.at,
          fmt::format("'sweep.\"{}\"' is {} (expected a list of 1 to {} values). Write \"{}\" = "
                      "[a, b, c], the dotted key in quotes",
                      member.key, describe(values), most_values, member.key));
      continue;
    }
    SweepAxis axis{member.key, {}};
    for (const auto& value : values.items) {
      std::string text = to_toml(value);
      const auto twin =
          std::ranges::find_if(axis.values, [&](const auto& other) { return same(other, text); });
      if (twin != axis.values.end())
        report.error(
            value.at,
            fmt::format("'sweep.\"{}\"' has {} {} (expected every value once: both would be "
                        "one study point). Remove one",
                        member.key, text, *twin == text ? "twice" : "and " + *twin));
      else
        axis.values.push_back(std::move(text));
    }
    points *= static_cast<double>(axis.values.size());
    report.given(fmt::format("sweep.\"{}\"", member.key), to_toml(values), member.at);
    axes.push_back(std::move(axis));
  }
  refuse_keys_set_twice(report, *sweep, root);
  if (points > most_points)
    report.error(sweep->at,
                 fmt::format("[sweep] makes {:.0f} study points (expected at most {:.0f}). "
                             "Shorten a list",
                             points, most_points));
  return axes;
}

bool sweeps(const Node& root, std::string_view key) {
  const Node* sweep = root.find("sweep");
  return sweep != nullptr && std::ranges::any_of(sweep->members, [&](const config::Member& line) {
           const auto keys = keys_set_by(line, root);
           return std::ranges::find(keys, key) != keys.end();
         });
}

void apply_sweep_value(Node& root, const std::string& key, const std::string& value) {
  config::apply_overlay(root, key, value);
  Node* truth = root.find("truth");
  const Node* coupling = truth != nullptr ? truth->find("coupling") : nullptr;
  if (coupling == nullptr || (key != "truth.coupling" && key != "truth")) return;
  const auto drop = [](Node& table, std::string_view name) {
    std::erase_if(table.members, [&](const config::Member& m) { return m.key == name; });
  };
  const std::string name = coupling->text;
  if (name != "servo") drop(*truth, "servo");
  if (name != "compensated") drop(*truth, "loop");
  if (Node* parameters = truth->find("parameters"); parameters && name != "lambda")
    drop(*parameters, "lambda");
}

}  // namespace drift::mc
