#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/report/study/sections.hpp"
#include "core/base/check.hpp"

namespace drift::report {
namespace {

Json of(const stats::Rate& rate) {
  return {{"value", rate.value()},
          {"low", rate.low()},
          {"high", rate.high()},
          {"hits", rate.hits},
          {"of", rate.of}};
}

Json of(const mc::Estimated& e, double unit) {
  return {{"value", e.value / unit}, {"low", e.low / unit}, {"high", e.high / unit}};
}

Json of(const mc::ChiSquareSum& sum) {
  return {{"mean", sum.mean()},
          {"expected_low", sum.low()},
          {"expected_high", sum.high()},
          {"inside", sum.holds()},
          {"runs_in_band", of(sum.in_band)},
          {"runs_by_chi_square_bin", sum.place.counts()}};
}

Json of(const mc::RateCourse& course) {
  Json all = Json::array();
  for (const stats::Rate& rate : course.steps()) all.push_back(of(rate));
  return all;
}

Json of(const mc::StartStatistics& s) {
  return {{"nis", of(s.nis)},
          {"nees_observed", of(s.nees)},
          {"nees_all", of(s.nees_all)},
          {"white", of(s.white)},
          {"healthy", of(s.healthy)},
          {"wrong", of(s.wrong)},
          {"silent_failure_rate", of(s.silent)},
          {"silent_failure_rate_by_runs", of(s.silent_course)},
          {"diverged", of(s.diverged)}};
}

Json parameter(const mc::FilterStatistics& f, std::size_t k) {
  const mc::ErrorStatistics& e = f.errors()[k];
  const mc::ParameterHealth& h = f.health()[k];
  const std::size_t param = f.columns().layout.params[k];
  const double unit = unit_of(param);
  Json coverage = Json::array();
  for (const stats::Rate& rate : e.coverage()) coverage.push_back(of(rate));
  return {{"key", parameter_key(param)},
          {"unit", parameter_unit(param)},
          {"runs", e.runs()},
          {"prior_sigma", e.prior_sigma() / unit},
          {"bias", of(e.bias(), unit)},
          {"rmse", of(e.rmse(), unit)},
          {"sigma", e.mean_sigma() / unit},
          {"rmse_over_prior", of(e.rmse(), e.prior_sigma())},
          {"learning_ratio", e.learning()},
          {"deception_ratio", of(e.deception(), 1.0)},
          {"coverage", coverage},
          {"errors_by_normal_bin", e.magnitudes().counts()},
          {"start_consistency", h.start_ratio()},
          {"depends_on_start", of(h.start_depends)},
          {"claims_to_know", of(h.claims)},
          {"wrong", of(h.wrong)},
          {"silent_failure_rate", of(h.silent)}};
}

Json of(const mc::LeftOut& l) {
  return {{"equation", l.equation},
          {"terms", missing_in(l)},
          {"held", keys_of(l.held)},
          {"smaller", smaller_in(l)},
          {"excluded", keys_of(l.excluded)}};
}

Json failures(const mc::FailureStatistics& f) {
  Json deciles = Json::array();
  for (const auto& d : f.deciles()) {
    if (d.chi2 == 0.0) continue;
    Json rates = Json::array();
    for (const stats::Rate& rate : d.rate) rates.push_back(rate.value());
    deciles.push_back(
        {{"key", parameter_key(d.param)}, {"chi2_of_9", d.chi2}, {"rate_by_decile", rates}});
  }
  Json by_status = Json::object();
  for (const auto& [status, count] : f.by_status())
    by_status[std::to_string(static_cast<int>(status))] = count;
  return {{"lost", of(f.lost())},
          {"headline_refused", f.too_many()},
          {"by_status", by_status},
          {"first_failed", f.first_failed()},
          {"by_parameter", deciles}};
}

Json of_point(const StudyResults& results, std::size_t p) {
  const mc::StudyPoint& point = results.points[p];
  Json values = Json::object();
  for (const auto& [key, value] : point.values) values[key] = value;
  Json one = {{"id", point.id},
              {"label", point.label},
              {"name", name_of(results, p)},
              {"values", values},
              {"truth", key_of(point.study.truth.coupling)},
              {"runs", results.statistics[p].runs()},
              {"failures", failures(results.statistics[p].failures())},
              {"filters", Json::array()}};
  for (std::size_t f = 0; f < results.statistics[p].filters().size(); ++f) {
    const mc::FilterStatistics& filter = results.statistics[p].filters()[f];
    Json pair = {{"name", filter.columns().name},
                 {"coupling", key_of(filter.columns().coupling)},
                 {"matched", matched(results, {p, f})},
                 {"left_out", of(left_out(results, {p, f}))},
                 {"starts", Json::array()},
                 {"parameters", Json::array()}};
    for (const auto& s : filter.starts()) pair["starts"].push_back(of(s));
    for (std::size_t k = 0; k < filter.errors().size(); ++k)
      pair["parameters"].push_back(parameter(filter, k));
    one["filters"].push_back(std::move(pair));
  }
  return one;
}

/// The text of a value that stands `depth` levels down: strings have no line ends of their own.
std::string dumped_at(const Json& value, std::size_t depth) {
  std::string text = dumped(value);
  text.pop_back();  // the last line end
  std::string out;
  for (const char c : text) {
    out += c;
    if (c == '\n') out.append(depth, ' ');
  }
  return out;
}

}  // namespace

std::string study_json(const StudyResults& results, const std::vector<Section>& sections) {
  Json out = {{"schema", 1},
              {"title", results.study.title},
              {"runs", all_runs(results)},
              {"runs_planned",
               std::max(all_runs(results), results.asked * std::uint64_t{results.points.size()})},
              {"finished", results.unfinished.empty()},
              {"headlines", headlines(results)},
              {"points", Json::array()}};
  out["provenance"] = Json::object();
  for (const auto& [key, value] : results.provenance) out["provenance"][key] = value;
  add_tables(out, sections);
  const std::string text = dumped(out), none = "\n \"points\": []";
  const std::size_t at = text.find(none), after = at + none.size() - 1;
  DRIFT_DEMAND(at != std::string::npos);
  // A point as a tree takes ten times its text: one at a time.
  std::string all = text.substr(0, after);
  for (std::size_t p = 0; p < results.points.size(); ++p)
    all += (p > 0 ? ",\n  " : "\n  ") + dumped_at(of_point(results, p), 2);
  return all + "\n " + text.substr(after);
}

}  // namespace drift::report
