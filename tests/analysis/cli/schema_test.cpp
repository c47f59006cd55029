// `driftscope schema` against the study files that are shipped, and against mistakes.
#include <nlohmann/json.hpp>
#include <regex>

#include "core/config/load.hpp"
#include "tests/support/program.hpp"

namespace drift::schema_test {
namespace {

using config::Node;
using nlohmann::json;
using namespace drift::test;

json json_of(const Node& node) {
  switch (node.kind) {
    case Node::Kind::table: {
      json object = json::object();
      for (const auto& member : node.members) object[member.key] = json_of(member.value);
      return object;
    }
    case Node::Kind::array: {
      json list = json::array();
      for (const Node& item : node.items) list.push_back(json_of(item));
      return list;
    }
    case Node::Kind::integer:
      return node.integer;
    case Node::Kind::real:
      return node.real;
    case Node::Kind::boolean:
      return node.boolean;
    default:
      return node.text;
  }
}

bool is_type(const json& value, const std::string& type) {
  return type == "object"    ? value.is_object()
         : type == "array"   ? value.is_array()
         : type == "string"  ? value.is_string()
         : type == "boolean" ? value.is_boolean()
         : type == "integer" ? value.is_number_integer()
                             : type == "number" && value.is_number();
}

/// The rules of JSON schema that the program uses; a rule it does not know fails the test.
struct Validator {
  json schema;

  std::string wrong(const json& value, const json& rule, const std::string& at) const {
    for (const auto& [word, says] : rule.items())
      if (const std::string why = broken(value, rule, word, says, at); !why.empty()) return why;
    return "";
  }

  std::string broken(const json& value, const json& rule, const std::string& word, const json& says,
                     const std::string& at) const {
    const std::string here = at + ": " + value.dump() + " against " + word + " ";
    if (word == "type") return is_type(value, says) ? "" : here + says.dump();
    if (word == "enum")
      return std::find(says.begin(), says.end(), value) != says.end() ? "" : here + says.dump();
    if (word == "pattern")
      return !value.is_string() || std::regex_search(value.get<std::string>(),
                                                     std::regex(says.get<std::string>()))
                 ? ""
                 : here;
    if (word == "minimum") return !value.is_number() || value >= says ? "" : here;
    if (word == "maximum") return !value.is_number() || value <= says ? "" : here;
    if (word == "minItems" || word == "minProperties") return value.size() >= says ? "" : here;
    if (word == "maxItems" || word == "maxProperties") return value.size() <= says ? "" : here;
    if (word == "anyOf") {
      for (const json& one : says)
        if (wrong(value, one, at).empty()) return "";
      return here;
    }
    if (word == "$ref")
      return wrong(value, schema.at(json::json_pointer(says.get<std::string>().substr(1))), at);
    if (word == "items" && value.is_array()) {
      for (std::size_t i = 0; i < value.size(); ++i)
        if (auto why = wrong(value[i], says, at + "[" + std::to_string(i) + "]"); !why.empty())
          return why;
      return "";
    }
    if (word == "required") {
      for (const json& key : says)
        if (!value.contains(key.get<std::string>())) return here + key.dump();
      return "";
    }
    if (word == "additionalProperties" || word == "properties")
      return word == "properties" ? members_wrong(value, rule, at) : "";
    if (word == "propertyNames" && value.is_object()) {
      for (const auto& [key, inner] : value.items())
        if (auto why = wrong(json(key), says, at); !why.empty()) return why;
      return "";
    }
    const bool words_only = word == "description" || word == "examples" || word == "title" ||
                            word == "$schema" || word == "$defs" || word == "items" ||
                            word == "propertyNames";
    return words_only ? "" : "unknown rule " + word;
  }

  std::string members_wrong(const json& value, const json& rule, const std::string& at) const {
    if (!value.is_object()) return "";
    for (const auto& [key, inner] : value.items()) {
      if (!rule.at("properties").contains(key)) {
        const json others = rule.value("additionalProperties", json(true));
        if (others == json(false)) return at + ": unknown key " + key;
        if (others.is_object())
          if (auto why = wrong(inner, others, at + "." + key); !why.empty()) return why;
        continue;
      }
      if (auto why = wrong(inner, rule.at("properties").at(key), at + "." + key); !why.empty())
        return why;
    }
    return "";
  }

  std::string wrong(const std::string& toml) const {
    return wrong(json_of(config::parse_document(toml, "study")), schema, "");
  }
};

Validator the_schema() {
  const Answer answer = driftscope("schema");
  EXPECT_EQ(answer.code, 0) << answer.err;
  return {json::parse(answer.out)};
}

TEST(Schema, EveryConfigurationThatIsShippedIsValid) {
  const Validator schema = the_schema();
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(DRIFT_SOURCE_DIR) + "/configs"))
    if (entry.path().extension() == ".toml") {
      EXPECT_EQ(schema.wrong(text_of(entry.path().string())), "") << entry.path();
    }
}

TEST(Schema, RefusesWhatTheProgramRefuses) {
  const Validator schema = the_schema();
  const ScratchFolder folder;
  const std::string good = text_of(std::string(DRIFT_SOURCE_DIR) + "/configs/study.toml");
  for (const std::string mistake :
       {"[readuot]", "[environment]\ntemprature = \"20 degC\"", "[environment]\ntemperature = 20",
        "[environment]\ntemperature = \"20\"", "[monte_carlo.stop]\nquantity = 3",
        "[mounting]\ngyro_x = [1]", "[[filter]]\nname = \"more\"\ncoupling = \"eq7\"",
        "[[filter]]\nname = \"more\"\ncoupling = \"servo\"",
        "[[filter]]\nname = \"more\"\ncoupling = \"eq5\"\nterms = [\"no_such_term\"]",
        "[[filter]]\nname = \"more\"\ncoupling = \"eq5\"\nstarts = 0",
        "[[filter]]\nname = \"more\"\ncoupling = \"eq5\"\nparameters = { eta_q = \"1 arcsec\" }",
        "[[filter]]\nname = \"more\""}) {
    const std::string text = good + "\n" + mistake + "\n";
    EXPECT_NE(schema.wrong(text), "") << mistake;
    EXPECT_NE(driftscope("check " + folder.write("s.toml", text)).code, 0) << mistake;
  }
}

TEST(Schema, KnowsTermsThatAStudyBrings) {
  const Validator schema = the_schema();
  const std::string good = text_of(std::string(DRIFT_SOURCE_DIR) + "/configs/study.toml") +
                           "\n[[filter]]\nname = \"own\"\ncoupling = \"eq5\"\nterms = "
                           "[\"g_drift.x\", \"rumble\"]\nstarts = [ { rumble_A = \"1 deg/h\" } ]\n"
                           "parameters = { rumble_A = \"0.1 deg/h\" }\n",
                    term = "[[term]]\nkey = \"rumble\"\nacts_on = \"drift.x\"\nequation = \"A\"\n";
  EXPECT_NE(schema.wrong(good), "") << "nobody brings it";
  EXPECT_EQ(schema.wrong(good + term + "parameters = { A = { unit = \"deg/h\", prior = 1 } }\n"),
            "");
  EXPECT_NE(schema.wrong(good + term + "parameters = { A = { units = \"deg/h\" } }\n"), "");
  EXPECT_NE(schema.wrong(good + "[[term]]\nkey = \"rumble\"\nacts_on = \"drift.w\"\n"), "");
}

TEST(Schema, NamesUnitRangeAndChoices) {
  const json schema = the_schema().schema;
  const json plan = schema.at("properties").at("plan").at("properties");
  EXPECT_NE(plan.at("dwell").at("description").get<std::string>().find("0.001 min to 100000 min"),
            std::string::npos)
      << plan.at("dwell");
  EXPECT_EQ(plan.at("dwell").at("examples").at(0), "1 min");
  EXPECT_TRUE(plan.contains("static_min"));  // of the other kind of test
  EXPECT_EQ(plan.at("kind").at("enum"), json({"platform", "strapdown"}));
  EXPECT_EQ(schema.at("$schema"), "https://json-schema.org/draft/2020-12/schema");
  EXPECT_EQ(schema.at("required"), json({"schema"}));
}

TEST(Schema, SaysThatStartsMayBeListed) {
  const Validator schema = the_schema();
  const std::string filter = "schema = 1\n[[filter]]\nname = \"a\"\ncoupling = \"eq5\"\nstarts = ";
  EXPECT_EQ(schema.wrong(filter + "3\n"), "");
  EXPECT_EQ(schema.wrong(filter + "[{}, { D_F_x = \"0.1 deg/h\" }]\n"), "");
  EXPECT_NE(schema.wrong(filter + "[3]\n"), "");
  const json starts = schema.schema.at(
      json::json_pointer("/properties/filter/items/properties/starts/description"));
  EXPECT_EQ(starts,
            "filter[].starts: a whole number from 1 to 1000, or a list of tables: what each start "
            "has other than the prior means");
}

}  // namespace
}  // namespace drift::schema_test
