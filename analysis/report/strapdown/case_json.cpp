#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report/identify/latitude_words.hpp"
#include "analysis/report/noise/noise.hpp"
#include "analysis/report/strapdown/case_report.hpp"
#include "analysis/report/strapdown/case_words.hpp"

namespace drift::report {

using nlohmann::json;
using strapdown::CaseFit;
using strapdown::CaseIdentification;
using strapdown::Score;

namespace {

json to_json(const Score& score, const char* unit) {
  return {{"unit", unit},
          {"count", score.count},
          {"in_sample", score.in_sample},
          {"held_out", score.held_out},
          {"held_out_95", {score.low, score.high}},
          {"held_out_median", score.median}};
}

json to_json(const CaseFit& fit) {
  json parameters = json::array(), unobservable = json::array();
  for (const auto& p : fit.parameters)
    parameters.push_back({{"key", p.key},
                          {"value", p.value},
                          {"sigma", p.sigma},
                          {"unit", p.unit},
                          {"note", p.note}});
  for (const auto& u : fit.unobservable)
    unobservable.push_back({{"what", u.what}, {"reason", u.reason}});
  json out{{"name", fit.name},
           {"equation", key_of(fit.equation)},
           {"chi2_per_dof", fit.fit.estimate.statistic_per_dof()},
           {"converged", fit.fit.estimate.status == EstimateStatus::ok},
           {"parameters", std::move(parameters)},
           {"unobservable", std::move(unobservable)}};
  json instruments = json::array();
  for (const auto& one : fit.instruments)
    instruments.push_back({{"instrument", instrument_name(one.of)},
                           {"chi2_per_dof", one.per_dof()},
                           {"dof", one.dof},
                           {"chance", one.chance()},
                           {"too_large", too_large(one, fit.instruments)},
                           {"sigmas_too_small_by", one.factor()}});
  out["instruments"] = std::move(instruments);
  if (fit.up.count > 0) out["rotations"] = to_json(fit.up, "deg");
  if (fit.gyro.count > 0) out["dwells"] = to_json(fit.gyro, "deg/h");
  if (fit.gravity.count > 0) out["gravity"] = to_json(fit.gravity, "g");
  return out;
}

/// A list; of a unit whose gyros do not see the Earth, what was asked of a dwell is beside it.
json dwells_json(const CaseIdentification& id) {
  const auto& search = id.study.search;
  json list = json::array();
  for (std::size_t d = 0; d < search.dwells.size(); ++d) {
    const auto& dwell = search.dwells[d];
    list.push_back({{"start_s", dwell.start},
                    {"end_s", dwell.end},
                    {"gyro_noise_deg_per_s", dwell.gyro_noise.norm() / unit::deg_per_s.to_si},
                    {"acc_noise_g", dwell.acc_noise.norm()},
                    {"at_rest", static_cast<bool>(id.study.test.still[d])}});
  }
  if (id.study.compass.sees_earth) return list;
  return {{"count", search.dwells.size()},
          {"gyro_floor_deg_per_s", search.gyro_floor / unit::deg_per_s.to_si},
          {"gyro_threshold_deg_per_s", search.gyro_threshold / unit::deg_per_s.to_si},
          {"acc_floor_g", search.acc_floor},
          {"acc_threshold_g", search.acc_threshold},
          {"list", std::move(list)}};
}

/// Of an axis of the case in the first dwell, clockwise from North as seen from above.
json azimuth_json(const CaseIdentification& id) {
  const strapdown::AxisHeading heading = first_heading(id);
  return {{"axis", std::string(1, "xyz"[heading.axis])},
          {"from_north_to_east_deg", heading.azimuth / unit::deg.to_si},
          {"sigma_deg", id.study.compass.sigma / unit::deg.to_si},
          {"at_s", id.study.search.dwells.front().start}};
}

}  // namespace

json to_json(const CaseIdentification& id, double gravity) {
  json fits = json::array(), accepted = json::array();
  for (const CaseFit& fit : id.fits) {
    fits.push_back(to_json(fit));
    accepted.push_back({{"equation", key_of(fit.equation)},
                        {"model", fit.name},
                        {"rotation_held_out_deg", fit.up.held_out}});
  }
  const bool earth = id.study.compass.sees_earth;
  json out{
      {"schema", 1},
      {"kind", "strapdown"},
      {"recording", id.study.source},
      {"remarks", id.study.all_remarks()},
      {"dwells", dwells_json(id)},
      {"rotations",
       {{"count", id.study.test.ways.size()}, {"omitted", id.study.test.ways_with_gap}}},
      {"earth_seen", earth},
      {"azimuth_sigma_deg", earth ? json(id.study.compass.sigma / unit::deg.to_si) : json(nullptr)},
      {"azimuth", earth ? azimuth_json(id) : json(nullptr)},
      {"latitude_doubt", latitude_json(id.latitude)},
      {"folds", id.division.folds},
      {"repeats", id.division.repeats},
      {"seed", id.seed},
      {"accepted", std::move(accepted)},
      {"equations", nullptr},
      {"noise", to_json(id.study.noise, gravity)},
      {"parameters", fits.front()["parameters"]},
      {"unobservable", fits.front()["unobservable"]},
      {"filters", std::move(fits)}};
  if (std::isfinite(id.eq5_gain)) {
    json contest{{"z", id.eq5_gain}};
    for (const CaseFit& fit : id.fits)
      contest[fmt::format("{}_held_out_deg", key_of(fit.equation))] = fit.up.held_out;
    out["equations"] = std::move(contest);
  }
  return out;
}

}  // namespace drift::report
