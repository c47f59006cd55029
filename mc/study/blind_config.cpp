#include "mc/study/blind_config.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <span>

#include "core/config/nearest.hpp"

namespace drift::mc {
namespace {

using config::Node;
using config::Option;
using config::Section;

/// A list of names, each one of `known`; the numbers of them there. Empty if absent or wrong.
std::vector<std::size_t> read_names(Section& section, std::string_view key,
                                    std::span<const std::string_view> known) {
  const std::string expected = fmt::format("a list of {}", fmt::join(known, ", "));
  const Node* node = section.take(key, Section::Kind::list, expected);
  if (node == nullptr) return {};
  const std::string name = section.full(key);
  if (!node->is(Node::Kind::array) || node->items.empty()) {
    section.report().error(node->at,
                           fmt::format("'{}' is {} (expected {}). Write {} = [\"{}\"]", name,
                                       describe(*node), expected, key, known.front()));
    return {};
  }
  std::vector<std::size_t> chosen;
  for (const Node& item : node->items) {
    const auto at = item.is(Node::Kind::string) ? std::ranges::find(known, item.text) : known.end();
    if (at == known.end()) {
      section.report().error(item.at, fmt::format("'{}' holds {} (expected {}). Use one of them",
                                                  name, describe(item), fmt::join(known, ", ")));
      return {};
    }
    chosen.push_back(static_cast<std::size_t>(at - known.begin()));
  }
  section.report().given(name, to_toml(*node), node->at);
  return chosen;
}

/// A list of values of a table; `out` as it was if absent or wrong.
template <class E, class Row, std::size_t N>
void read_list(Section& section, std::string_view key, const Row (&table)[N], std::vector<E>& out) {
  std::vector<std::string_view> names;
  for (const Row& row : table) names.push_back(row.name);
  const auto chosen = read_names(section, key, names);
  if (!chosen.empty()) out.clear();
  for (const std::size_t k : chosen) out.push_back(table[k].value);
}

/// A number of a list.
std::optional<double> number(Section& section, const Node& node, const std::string& name) {
  const auto q = read_quantity(section.report(), node, name,
                               Option{"sizes", unit::one, 0.1, 1e4, "size in sigma"});
  if (!q) return std::nullopt;
  return q->si();
}

void read_sizes(Section& section, BlindSpec& spec) {
  const std::string expected = "a list of sizes, or { uniform = [low, high] }";
  const Node* node = section.take("sizes", Section::Kind::list_or_table, expected);
  const std::string name = section.full("sizes");
  if (node == nullptr) {
    section.report().assumed(name,
                             fmt::format("{{ uniform = [{}, {}] }}", spec.smallest, spec.largest));
    return;
  }
  const auto wrong = [&] {
    section.report().error(
        node->at, fmt::format("'{}' is {} (expected {}). Write sizes = [4, 6, 8, 12]", name,
                              describe(*node), expected));
  };
  const Node* range = node->is(Node::Kind::table) ? node->find("uniform") : nullptr;
  const Node* list = node->is(Node::Kind::array) ? node : range;
  if (list == nullptr || !list->is(Node::Kind::array) || list->items.empty() ||
      (range != nullptr && (range->items.size() != 2 || node->members.size() != 1)))
    return wrong();
  std::vector<double> values;
  for (const Node& item : list->items) {
    const auto v = number(section, item, name);
    if (!v) return;
    values.push_back(*v);
  }
  if (range != nullptr) {
    if (!(values[0] < values[1])) return wrong();
    spec.smallest = values[0];
    spec.largest = values[1];
  } else {
    spec.sizes = values;
  }
  section.report().given(name, to_toml(*node), node->at);
}

template <class Field>
void visit_options(BlindShares& o, Field&& field) {
  field(Option{"null", unit::one, 0.0, 1e6, "nothing is hidden"}, o.null);
  field(Option{"wrong_noise", unit::one, 0.0, 1e6, "noise not as declared"}, o.wrong_noise);
  field(Option{"single", unit::one, 0.0, 1e6, "one effect of the library"}, o.single);
  field(Option{"pair", unit::one, 0.0, 1e6, "two effects at once"}, o.pair);
  field(Option{"outside", unit::one, 0.0, 1e6, "an effect outside the library"}, o.outside);
  field(Option{"local", unit::one, 0.0, 1e6, "in one position and window"}, o.local);
}

BlindShares read_shares(Section section) {
  BlindShares shares;
  visit_options(shares, [&](const Option& option, double& value) { section.read(option, value); });
  if (section.present() && !(shares.sum() > 0.0))
    section.report().error(section.at(),
                           "[blind.shares] are all 0 (expected a weight for at least one). Give "
                           "null = 1");
  section.finish();
  return shares;
}

BlindFurther read_further(Section section) {
  BlindFurther further;
  const auto read = [&](const char* key, const char* doc, std::uint64_t& value) {
    section.read(Option{key, unit::one, 0.0, 1e6, doc}, value);
  };
  read("other_equation", "trials whose nominal equation is the wrong one", further.other_equation);
  read("noisy_single", "trials of one effect, noise not as declared", further.noisy_single);
  read("noisy_covariate", "trials of one effect whose covariate was recorded with noise",
       further.noisy_covariate);
  section.finish();
  return further;
}

/// What a truth may be here; its nominal model is settled.
constexpr CouplingFacts truths[] = {facts(Coupling::eq5), facts(Coupling::eq6),
                                    facts(Coupling::servo)};

}  // namespace

BlindSpec read_blind(Section section) {
  BlindSpec spec;
  section.read(Option{"trials", unit::one, 1.0, 1e6, "recordings"}, spec.trials);
  if (const auto chosen = read_names(section, "plans", preset_names); !chosen.empty()) {
    spec.plans.clear();
    for (const std::size_t k : chosen) spec.plans.emplace_back(preset_names[k]);
  }
  read_list(section, "modes", command_laws, spec.modes);
  read_list(section, "couplings", truths, spec.couplings);
  read_sizes(section, spec);
  section.read(Option{"pair_size", unit::one, 0.1, 1e4, "of each of two [sigma]"}, spec.pair_size);
  section.read(Option{"pair_cosine", unit::one, 0.0, 1.0, "largest of two projected signatures"},
               spec.pair_cosine);
  section.read(Option{"outside_size", unit::one, 0.1, 1e4, "[sigma]"}, spec.outside_size);
  section.read(Option{"most_prior_sigmas", unit::one, 0.01, 1e6, "of an effect"},
               spec.most_prior_sigmas);
  spec.shares = read_shares(section.section("shares"));
  spec.further = read_further(section.section("further"));
  section.finish();
  return spec;
}

}  // namespace drift::mc
