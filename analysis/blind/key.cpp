#include "analysis/blind/key.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/base/check.hpp"
#include "core/base/json_number.hpp"
#include "core/base/sha256.hpp"

namespace drift::blind {
namespace {

using Json = nlohmann::ordered_json;

Json of(const HiddenEffect& e) {
  Json params = Json::array();
  for (const HiddenParameter& p : e.parameters)
    params.push_back({{"key", p.key}, {"value", json_number(p.value)}, {"unit", p.unit}});
  return {{"term", e.term},
          {"axis", e.axis},
          {"words", e.words},
          {"parameters", params},
          {"size", json_number(e.size)},
          {"absorbed", json_number(e.absorbed)},
          {"position", e.position},
          {"start_s", e.start_s},
          {"end_s", e.end_s},
          {"equation", e.equation},
          {"nearest", e.nearest},
          {"nearest_cosine", json_number(e.nearest_cosine)}};
}

HiddenEffect effect_of(const Json& j) {
  HiddenEffect e;
  e.term = j.at("term");
  e.axis = j.at("axis");
  e.words = j.at("words");
  for (const Json& p : j.at("parameters"))
    e.parameters.push_back({p.at("key"), number_of(p.at("value")), p.at("unit")});
  e.size = number_of(j.at("size"));
  e.absorbed = number_of(j.at("absorbed"));
  e.position = whole_of<int>(j.at("position"));
  e.start_s = j.at("start_s");
  e.end_s = j.at("end_s");
  e.equation = j.at("equation");
  e.nearest = j.value("nearest", "");  // keys of before 2026-11-21 do not say
  if (j.contains("nearest_cosine")) e.nearest_cosine = number_of(j.at("nearest_cosine"));
  return e;
}

Json of(const Certificate& c) {
  return {{"chi2_per_dof", json_number(c.chi2_per_dof)},
          {"band", {c.band_low, c.band_high}},
          {"concealed", c.concealed},
          {"largest_bias_sigma", json_number(c.largest_bias)},
          {"biased", c.biased}};
}

Certificate certificate_of(const Json& j) {
  Certificate c;
  c.chi2_per_dof = number_of(j.at("chi2_per_dof"));
  c.band_low = j.at("band").at(0);
  c.band_high = j.at("band").at(1);
  c.concealed = j.at("concealed");
  c.largest_bias = number_of(j.at("largest_bias_sigma"));
  c.biased = j.at("biased");
  return c;
}

Json of(const KeyEntry& k) {
  Json effects = Json::array();
  for (const HiddenEffect& e : k.effects) effects.push_back(of(e));
  return {{"trial", k.plan.number},
          {"stratum", key_of(k.plan.stratum)},
          {"index", k.plan.index},
          {"plan", k.plan.plan},
          {"mode", key_of(k.plan.mode)},
          {"truth_coupling", key_of(k.plan.coupling)},
          {"nominal_coupling", k.nominal},
          {"wanted_size", k.plan.size},
          {"total_size", json_number(k.total_size)},
          {"cosine", json_number(k.cosine)},
          {"effects", effects},
          {"certificate", of(k.certificate)}};
}

/// The value that a table has under a name of the file; out_of_range if it has none.
template <class Table>
auto named(const Table& table, const Json& name) {
  const auto value = value_in(table, name.get<std::string>());
  if (!value) throw std::out_of_range(fmt::format("{} is unknown", name.dump()));
  return *value;
}

KeyEntry entry_of(const Json& j) {
  KeyEntry k;
  k.plan.number = whole_of<std::size_t>(j.at("trial"));
  k.plan.stratum = named(strata, j.at("stratum"));
  k.plan.index = whole_of<std::size_t>(j.at("index"));
  k.plan.plan = j.at("plan");
  k.plan.mode = named(command_laws, j.at("mode"));
  k.plan.coupling = named(couplings, j.at("truth_coupling"));
  k.nominal = j.at("nominal_coupling");
  k.plan.size = j.at("wanted_size");
  k.total_size = number_of(j.at("total_size"));
  k.cosine = number_of(j.at("cosine"));
  for (const Json& e : j.at("effects")) k.effects.push_back(effect_of(e));
  k.certificate = certificate_of(j.at("certificate"));
  return k;
}

}  // namespace

std::string salt_of(std::uint64_t seed) {
  return sha256_hex(fmt::format("driftscope blind key, seed {}", seed));
}

std::string to_json(const Key& key) {
  Json entries = Json::array();
  for (const KeyEntry& k : key.entries) entries.push_back(of(k));
  return Json{{"schema", 1}, {"salt", key.salt}, {"trials", entries}}.dump(1) + "\n";
}

Key read_key(const std::string& json) {
  try {
    const Json j = Json::parse(json);
    Key key{j.at("salt"), {}};
    for (const Json& e : j.at("trials")) key.entries.push_back(entry_of(e));
    return key;
  } catch (const std::exception& e) {
    throw InputError(ExitCode::self_check,
                     fmt::format("key.json: is no key ({}). Make the trials again in an "
                                 "empty folder",
                                 e.what()));
  }
}

}  // namespace drift::blind
