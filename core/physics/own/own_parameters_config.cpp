#include "core/physics/own/own_parameters_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "core/physics/expression/parse.hpp"
#include "core/physics/own/own_inputs.hpp"
#include "core/physics/own/own_term.hpp"

namespace drift {
namespace {

using config::Option;
using config::Section;

constexpr std::string_view expected_parameters =
    "a table such as { A = { unit = \"deg/h\", prior = 0.01 }, P = { unit = \"min\", value = 37 } "
    "}";

/// Plain numbers of a value, a distribution or a list get the unit of the parameter.
config::Node with_unit(config::Node node, const Unit& unit) {
  if (unit.symbol.view() == "1") return node;
  if (node.is(config::Node::Kind::integer) || node.is(config::Node::Kind::real)) {
    config::Node text = config::text_node(fmt::format("{} {}", to_toml(node), unit.symbol.view()));
    text.at = node.at;
    return text;
  }
  for (auto& member : node.members) member.value = with_unit(std::move(member.value), unit);
  for (auto& item : node.items) item = with_unit(std::move(item), unit);
  return node;
}

Unit read_own_unit(Section& section) {
  std::string text = "1";
  section.read(Option{.key = "unit", .doc = "of the parameter; without one a plain number"}, text);
  if (const auto unit = parse_unit(text)) return *unit;
  section.report().error(
      section.take("unit")->at,
      fmt::format("'{}' = \"{}\" is no unit that the program knows (expected a unit such as "
                  "\"deg/h\", \"deg/h/g\", \"ug\", \"arcsec\", \"min\"). Correct it",
                  section.full("unit"), text));
  return unit::one;
}

/// A number: the 1 sigma of something around `mean`. A table: a whole distribution, which goes with
/// no value.
std::optional<Prior> read_own_prior(Section& section, const Unit& unit,
                                    std::optional<double> value) {
  const config::Node* node =
      section.take("prior", Section::Kind::unknown, "1 sigma, in the unit of the parameter");
  if (node == nullptr) return std::nullopt;
  // A plain number is a sigma, whatever the zero of its scale.
  const bool sigma = node->is(config::Node::Kind::string) && config::quantity_in(node->text);
  const Option option{.key = "prior", .unit = unit, .difference = sigma};
  const auto given =
      read_prior(section.report(), with_unit(*node, unit), section.full("prior"), option);
  if (!given) return std::nullopt;
  const auto wrong = [&](const char* what, const char* expected, const char* fix) {
    section.report().error(node->at, fmt::format("'{}' {} (expected {}). {}", section.full("prior"),
                                                 what, expected, fix));
    return std::nullopt;
  };
  if (given->kind == Prior::Kind::fixed) {
    if (given->a > 0.0) return normal(value.value_or(0.0), given->a);
    return wrong("is not positive", "the 1 sigma of the parameter",
                 "For a parameter that is known give a value and no prior");
  }
  if (value)
    return wrong("is a distribution beside a value", "with a value, its 1 sigma alone",
                 "Remove the value, or give 1 sigma");
  return given;
}

std::optional<double> read_own_value(Section& section, const Unit& unit) {
  const config::Node* node =
      section.take("value", Section::Kind::unknown, "a number, in the unit of the parameter");
  if (node == nullptr) return std::nullopt;
  const auto q = read_quantity(section.report(), with_unit(*node, unit), section.full("value"),
                               Option{.key = "value", .unit = unit});
  return q ? std::optional(q->in(unit)) : std::nullopt;
}

Grid read_own_grid(Section& section, const Unit& unit) {
  Grid grid;
  const std::string expected = fmt::format("a list of 2 to {} values", Grid::capacity);
  const config::Node* node = section.take("grid", Section::Kind::list, expected);
  if (node == nullptr) return grid;
  if (!node->is(config::Node::Kind::array) || node->items.size() < 2 ||
      node->items.size() > Grid::capacity) {
    section.report().error(node->at, fmt::format("'{}' is {} (expected {}). Write grid = [20, 40, "
                                                 "80], in the unit of the parameter",
                                                 section.full("grid"), describe(*node), expected));
    return grid;
  }
  for (const config::Node& item : node->items)
    if (const auto q = read_quantity(section.report(), with_unit(item, unit), section.full("grid"),
                                     Option{.key = "grid", .unit = unit}))
      grid.values[grid.size++] = q->in(unit);
  std::sort(grid.values.begin(), grid.values.begin() + static_cast<std::ptrdiff_t>(grid.size));
  return grid;
}

/// Where nobody says over which values something that is not well known is to be profiled.
Grid grid_about(double value, double sigma) {
  return {value - 2.0 * sigma, value - sigma, value, value + sigma, value + 2.0 * sigma};
}

ParamSpec read_own_parameter(Section section, const std::string& key) {
  ParamSpec spec;
  spec.key = spec.group = Name(key);
  spec.enters = "the equation";
  spec.unit = read_own_unit(section);
  const auto value = read_own_value(section, spec.unit);
  const auto prior = read_own_prior(section, spec.unit, value);
  spec.grid = read_own_grid(section, spec.unit);
  const bool has_prior = section.has("prior"), has_value = section.has("value");
  if (!has_prior && !has_value)
    section.report().error(
        section.at(),
        fmt::format("'{}' has neither prior nor value (expected prior = 1 sigma of an amplitude, "
                    "or value = what a setting is). Add one",
                    section.full("prior")));
  if (has_prior && !has_value && spec.grid.size > 0)
    section.report().error(section.take("grid")->at,
                           fmt::format("'{}' belongs to an amplitude, which is estimated (expected "
                                       "a grid beside a value only). Remove it",
                                       section.full("grid")));
  spec.kind = has_value ? ParamKind::nonlinear : ParamKind::linear;
  spec.prior = prior.value_or(has_value ? fixed(value.value_or(1.0)) : normal(0.0, 1.0));
  if (has_value && prior && spec.grid.size == 0) spec.grid = grid_about(prior->a, prior->b);
  for (const char* given : {"prior", "value", "grid"})
    if (const config::Node* node = section.take(given))
      section.report().given(section.full(given), to_toml(*node), node->at);
  section.finish();
  return spec;
}

/// What is wrong with the name of a parameter, and what was expected; nothing if it is right.
std::optional<std::pair<std::string, std::string>> wrong_name(const std::string& name) {
  if (!is_name(name)) return {{"is no name", "letters, figures and _, a letter first"}};
  const bool is_input =
      std::ranges::any_of(own_inputs, [&](const OwnInput& in) { return in.name.view() == name; });
  const auto reserved = reserved_equation_names();
  if (is_input || std::ranges::find(reserved, name) != reserved.end())
    return {{is_input ? "is what an equation sees of the platform" : "is a word of the equations",
             "another name"}};
  return {};
}

}  // namespace

bool is_name(std::string_view word) {
  const auto letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  return !word.empty() && letter(word.front()) &&
         std::ranges::all_of(word, [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

OwnParameters read_own_parameters(Section& term, const std::string& term_key) {
  OwnParameters out;
  const config::Node* node =
      term.take("parameters", Section::Kind::table, std::string(expected_parameters));
  if (!term.require("parameters", expected_parameters)) return out;
  const std::string path = term.full("parameters");
  if (node->is(config::Node::Kind::table) && node->members.empty())
    term.report().error(node->at,
                        fmt::format("'{}' is empty (expected {}). A term is sized and switched by "
                                    "its parameters: give one",
                                    path, expected_parameters));
  if (!node->is(config::Node::Kind::table)) {
    term.report().error(node->at, fmt::format("'{}' is {} (expected {}). Write it so", path,
                                              describe(*node), expected_parameters));
    return out;
  }
  // In the order of their names, so that a file written anew in another order is the same study.
  std::vector<config::Member> members = node->members;
  std::ranges::sort(members, {}, &config::Member::key);
  for (const config::Member& member : members) {
    const std::string key = fmt::format("{}_{}", term_key, member.key);
    std::string what, expected;
    if (auto wrong = wrong_name(member.key))
      std::tie(what, expected) = *wrong;
    else if (key.size() > Name::capacity)
      what = fmt::format("makes the name '{}', which is too long", key),
      expected = fmt::format("at most {} characters with that of the term", Name::capacity);
    else if (out.specs.size() == most_own_parameters)
      what = "is one too many",
      expected = fmt::format("at most {} parameters of a term", most_own_parameters);
    if (!what.empty()) {
      term.report().error(member.at, fmt::format("'{}.{}' {} (expected {}). Rename or remove it",
                                                 path, member.key, what, expected));
      continue;
    }
    Section section(term.report(), &member.value, member.at, path + "." + member.key);
    if (!member.value.is(config::Node::Kind::table)) continue;  // which the section has said
    out.names.push_back(member.key);
    out.specs.push_back(read_own_parameter(section, key));
  }
  return out;
}

}  // namespace drift
