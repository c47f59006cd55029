#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/report/noise/noise.hpp"
#include "analysis/report/page/table.hpp"
#include "analysis/report/strapdown/report.hpp"

namespace drift::report {
namespace {

using nlohmann::json;
using strapdown::Score;
using strapdown::Trial;

json to_json(const std::optional<Score>& score, const char* unit, double z) {
  if (!score) return nullptr;
  return {{"unit", unit},
          {"count", score->count},
          {"in_sample", score->in_sample},
          {"held_out", score->held_out},
          {"held_out_95", {score->low, score->high}},
          {"held_out_median", score->median},
          {"z", z}};
}

json to_json(const std::vector<Trial>& trials) {
  json list = json::array();
  for (const Trial& t : trials) {
    json one{{"model", t.name},
             {"equation", t.equation},
             {"against", t.against},
             {"parameters", t.parameters},
             {"verdict", std::string(strapdown::name_of(t.verdict))},
             {"reason", t.reason}};
    if (t.gravity) one["gravity"] = to_json(t.gravity, "m/s^2", t.z_dwell);
    if (t.dwell) one["dwells"] = to_json(t.dwell, "deg/s", t.z_dwell);
    if (t.rotation) one["rotations"] = to_json(t.rotation, "deg", t.z_rotation);
    list.push_back(std::move(one));
  }
  return list;
}

json dwells_json(const strapdown::StrapdownResult& r) {
  json list = json::array();
  for (const auto& d : r.search.dwells)
    list.push_back({{"start_s", d.start},
                    {"end_s", d.end},
                    {"gyro_noise_deg_per_s", d.gyro_noise.norm() / unit::deg_per_s.to_si},
                    {"acc_noise_g", d.acc_noise.norm()}});
  return {{"count", r.search.dwells.size()},
          {"static_min_s", r.options.static_min},
          {"gyro_floor_deg_per_s", r.search.gyro_floor / unit::deg_per_s.to_si},
          {"gyro_threshold_deg_per_s", r.search.gyro_threshold / unit::deg_per_s.to_si},
          {"acc_floor_g", r.search.acc_floor},
          {"acc_threshold_g", r.search.acc_threshold},
          {"list", std::move(list)}};
}

}  // namespace

json to_json(const strapdown::StrapdownResult& r) {
  json parameters = json::array(), unobservable = json::array(), accepted = json::array();
  for (const auto& p : r.parameters)
    parameters.push_back({{"key", p.key},
                          {"value", p.value},
                          {"sigma", p.sigma},
                          {"unit", p.unit},
                          {"note", p.note}});
  for (const auto& u : r.unobservable)
    unobservable.push_back({{"what", u.what}, {"reason", u.reason}});
  for (const auto& f : r.accepted)
    accepted.push_back({{"equation", key_of(f.model.equation)},
                        {"model", f.name},
                        {"rotation_held_out_deg", f.rotation.held_out}});
  json contest = nullptr;
  for (const auto& c : r.contest)
    contest = {
        {"eq5_held_out_deg", c.eq5.held_out}, {"eq6_held_out_deg", c.eq6.held_out}, {"z", c.z}};
  return {{"schema", 1},
          {"kind", "strapdown"},
          {"recording", r.source},
          {"dwells", dwells_json(r)},
          {"rotations", {{"count", r.rotations}, {"omitted", r.rotations_omitted}}},
          {"folds", r.options.folds},
          {"repeats", r.options.repeats},
          {"seed", r.options.seed},
          {"accelerometers", to_json(r.accelerometer_trials)},
          {"gyros", to_json(r.gyro_trials)},
          {"accepted", std::move(accepted)},
          {"equations", std::move(contest)},
          {"noise", to_json(r.noise, r.options.gravity)},
          {"parameters", std::move(parameters)},
          {"unobservable", std::move(unobservable)}};
}

std::string estimates_csv(const strapdown::StrapdownResult& r) {
  std::string out = "parameter,unit,estimate,sigma,note\n";
  for (const auto& p : r.parameters)
    out += fmt::format("{},{},{},{},{}\n", csv_of(p.key), csv_of(p.unit), p.value, p.sigma,
                       csv_of(p.note));
  return out;
}

}  // namespace drift::report
