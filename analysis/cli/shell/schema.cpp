#include "analysis/cli/shell/schema.hpp"

#include <limits>

#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/shell/study_keys.hpp"
#include "core/physics/parameters_config.hpp"

namespace drift::cli {
namespace {

using Json = nlohmann::ordered_json;
using Kind = StudyKey::Kind;

Json reference(std::string_view definition) {
  return {{"$ref", fmt::format("#/$defs/{}", definition)}};
}

/// What `terms` may list: terms, terms of one axis, parameters, groups of them.
Json term_names() {
  Json names = Json::array();
  for (const auto key : term_keys()) names.push_back(key);
  for (const auto key : term_keys())
    for (const char axis : {'x', 'y', 'z'})
      if (const auto name = fmt::format("{}.{}", key, axis); params_named(name).any())
        names.push_back(name);
  for (const auto key : parameter_keys()) names.push_back(key);
  return names;
}

/// A table whose keys are parameters and groups of them; a study may bring others.
Json parameters(std::string_view value) {
  Json properties = Json::object();
  for (const auto key : parameter_keys()) properties[std::string(key)] = reference(value);
  return {
      {"type", "object"}, {"properties", properties}, {"additionalProperties", reference(value)}};
}

/// Parameters of a study's own term.
Json own_parameters() {
  const Json any = Json::object();
  const Json list = {{"type", "array"}, {"minItems", 2}, {"maxItems", Grid::capacity}};
  const Json one = {
      {"type", "object"},
      {"properties",
       {{"unit", {{"type", "string"}}}, {"prior", any}, {"value", any}, {"grid", list}}},
      {"additionalProperties", false}};
  return {{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", one}};
}

/// A study that brings no terms names those of the library.
Json own_terms_or_known_names() {
  const Json names = {{"propertyNames", reference("parameter_names")}};
  Json model = {{"terms", {{"items", reference("term_names")}}}, {"parameters", names}};
  const Json truth = {{"properties", model}};
  model["starts"] = {{"items", names}};
  const Json filter = {{"items", {{"properties", model}}}};
  return {{{"required", {"term"}}}, {{"properties", {{"truth", truth}, {"filter", filter}}}}};
}

Json definitions() {
  // A number, then a unit; which units fit is the program's to say.
  const std::string number = R"(^[ \t]*[+]?-?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][+-]?[0-9]+)?)";
  Json defs;
  defs["quantity"] = {{"type", "string"},
                      {"pattern", number + R"(([ \t]+[^ \t].*|[^ \t0-9.].*)$)"}};
  defs["number"] = {{"anyOf", {{{"type", "number"}}, {{"type", "string"}, {"pattern", number}}}}};
  const Json pair = {
      {"type", "array"}, {"items", reference("number")}, {"minItems", 2}, {"maxItems", 2}};
  const Json spread = {{"type", "object"},
                       {"properties", {{"normal", pair}, {"uniform", pair}}},
                       {"additionalProperties", false},
                       {"minProperties", 1},
                       {"maxProperties", 1}};
  defs["prior"] = {{"description",
                    "a value, { normal = [mean, sigma] } or { uniform = [low, high] "
                    "}, in the unit that `driftscope terms` shows"},
                   {"anyOf", {reference("number"), spread}}};
  defs["term_names"] = {{"enum", term_names()}};
  defs["parameter_names"] = {{"enum", parameter_keys()}};
  const Json own_name = {{"type", "string"}, {"pattern", "^[A-Za-z_][A-Za-z0-9_]*$"}};
  defs["terms"] = {{"type", "array"}, {"items", {{"anyOf", {reference("term_names"), own_name}}}}};
  defs["parameters"] = parameters("prior");
  defs["start"] = parameters("number");
  return defs;
}

Json whole(const StudyKey& key) {
  Json number = {{"type", "integer"}, {"minimum", key.option.min}};
  if (!config::unbounded_whole(key.option)) number["maximum"] = key.option.max;
  return {{"anyOf", {number, {{"type", "string"}, {"pattern", "^0x[0-9a-fA-F]+$"}}}}};
}

Json three_of(const Json& items) {
  return {{"type", "array"}, {"items", items}, {"minItems", 3}, {"maxItems", 3}};
}

Json section_of(const std::vector<StudyKey>& keys);

Json rule_of(const StudyKey& key) {
  switch (key.kind) {
    case Kind::section:
      return section_of(key.keys);
    case Kind::sections: {
      Json items = section_of(key.keys);
      // Results from elsewhere name parameters, those of own terms too.
      if (key.key == "published") items["additionalProperties"] = {{"type", "object"}};
      return {{"type", "array"}, {"items", items}};
    }
    case Kind::table:
      if (key.path == "term[].parameters") return own_parameters();
      if (key.key == "parameters") return reference("parameters");
      if (key.key == "sweep")
        return {{"type", "object"}, {"additionalProperties", {{"type", "array"}, {"minItems", 1}}}};
      return {{"type", "object"}};
    case Kind::list:
      if (key.key == "terms") return reference("terms");
      return {{"type", "array"}};
    case Kind::list_or_table:
      return Json::object();
    case Kind::text_or_list: {
      const Json text = {{"type", "string"}};
      return {{"anyOf", {text, {{"type", "array"}, {"items", text}, {"minItems", 1}}}}};
    }
    case Kind::choice:
      return {{"enum", key.choices}};
    case Kind::truth_value:
      return {{"type", "boolean"}};
    case Kind::whole:
      if (key.key == "starts")
        return {{"anyOf", {whole(key), {{"type", "array"}, {"items", reference("start")}}}}};
      return whole(key);
    case Kind::number:
      return reference("number");
    case Kind::quantity:
      return reference("quantity");
    case Kind::vector:
      return three_of(reference("number"));
    case Kind::matrix:
      return three_of(three_of(reference("number")));
    case Kind::text:
    case Kind::unknown:
      break;
  }
  return {{"type", "string"}};
}

Json described(const StudyKey& key) {
  Json rule = rule_of(key);
  if (key.kind == Kind::section) {
    rule["description"] = fmt::format("section [{}]", key.path);
    return rule;
  }
  const bool number = key.kind == Kind::quantity || key.kind == Kind::number,
             has_range = number && key.option.max < std::numeric_limits<double>::max(),
             has_words = number && !key.option.doc.empty();
  const bool also_listed = key.kind == Kind::whole && key.key == "starts";
  rule["description"] = fmt::format(
      "{}: {}{}{}{}{}{}", key.path, key.expected, has_range ? ", " : "",
      has_range ? config::range_text(key.option) : "", has_words ? ": " : "",
      has_words ? key.option.doc : "",
      also_listed ? ", or a list of tables: what each start has other than the prior means" : "");
  if (key.kind == Kind::quantity)
    rule["examples"] = Json::array({fmt::format("1 {}", key.option.unit.symbol.view())});
  return rule;
}

Json section_of(const std::vector<StudyKey>& keys) {
  Json properties = Json::object(), required = Json::array();
  for (const StudyKey& key : keys) {
    properties[key.key] = described(key);
    if (key.required) required.push_back(key.key);
  }
  Json section = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) section["required"] = required;
  return section;
}

void add_settable(const std::vector<StudyKey>& keys, std::vector<std::string>& out) {
  for (const StudyKey& key : keys) {
    if (key.kind == Kind::section)
      add_settable(key.keys, out);
    else if (key.key == "parameters")
      for (const auto parameter : parameter_keys())
        out.push_back(fmt::format("{}.{}", key.path, parameter));
    else if (key.kind != Kind::sections && key.kind != Kind::table)
      out.push_back(key.path);
  }
}

}  // namespace

Json study_schema() {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", "driftscope study file"}};
  schema.update(section_of(study_keys()));
  schema["anyOf"] = own_terms_or_known_names();
  schema["$defs"] = definitions();
  return schema;
}

std::vector<std::string> settable_keys() {
  std::vector<std::string> keys;
  add_settable(study_keys(), keys);
  return keys;
}

Command schema_command() {
  struct Arguments {};
  return {"schema", group::program, "JSON schema of the study file, for editors",
          "driftscope schema > driftscope.schema.json",
          with_arguments<Arguments>([](CLI::App&, Arguments&) {},
                                    [](const Arguments&) {
                                      show("{}\n", study_schema().dump(2));
                                      return ExitCode::ok;
                                    })};
}

}  // namespace drift::cli
