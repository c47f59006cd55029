#include "mc/study/published_config.hpp"

#include <fmt/format.h>

namespace drift::mc {
namespace {

using config::Node;
using config::Option;
using config::Section;

/// A list of quantities in the unit of a parameter, SI.
std::vector<double> read_list(Section& table, std::string_view key, const ParamSpec& spec) {
  std::vector<double> values;
  const std::string expected = "a list of " + config::expected_quantity(spec.unit);
  const Node* node = table.take(key, Section::Kind::list, expected);
  if (node == nullptr) return values;
  const std::string name = table.full(key);
  if (!node->is(Node::Kind::array)) {
    table.report().error(node->at,
                         fmt::format("'{}' is {} (expected {}). Write {} = [\"1 {}\", ...]", name,
                                     describe(*node), expected, key, spec.unit.symbol.view()));
    return values;
  }
  for (const Node& item : node->items)
    if (const auto q =
            read_quantity(table.report(), item, name, Option{.key = key, .unit = spec.unit}))
      values.push_back(q->si());
  table.report().given(name, to_toml(*node), node->at);
  return values;
}

}  // namespace

std::vector<Published> read_published(Section& root) {
  std::vector<Published> all;
  for (Section& section : root.sections("published")) {
    Published p;
    section.take("name", Section::Kind::text, config::expected_text());
    if (section.require("name", "name = \"Table 1 of the paper\""))
      section.read(Option{.key = "name", .doc = "of the source"}, p.name);
    section.read(Option{.key = "filter", .doc = "it is compared with"}, p.filter);
    for (std::size_t i = 0; i < TermLibrary::specs.size(); ++i) {
      const ParamSpec& spec = TermLibrary::specs[i];
      Section table = section.section(spec.key.view());
      if (!table.present()) continue;
      Published::Value value{i, read_list(table, "values", spec), read_list(table, "sigmas", spec)};
      if (!value.sigmas.empty() && value.sigmas.size() != value.values.size())
        root.report().error(
            table.at(),
            fmt::format("'{}' has {} values and {} sigmas (expected as many of "
                        "each). Give one sigma for each value, or none",
                        section.full(spec.key.view()), value.values.size(), value.sigmas.size()));
      table.finish();
      p.values.push_back(std::move(value));
    }
    section.finish();
    all.push_back(std::move(p));
  }
  return all;
}

}  // namespace drift::mc
