#include "mc/export/export_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "core/stats/normal.hpp"
#include "mc/export/export_text.hpp"
#include "mc/statistics/point_statistics.hpp"

namespace drift::mc {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const double z95 = stats::normal_half_width(0.95);

void add_once(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

/// An RMSE over the prior sigma with its interval.
std::vector<double> rmse(const ErrorStatistics& e) {
  const Estimated r = e.rmse_normal(z95);
  const bool known = e.runs() >= 2;
  return {r.value / e.prior_sigma(), known ? std::max(0.0, r.low / e.prior_sigma()) : nan,
          known ? r.high / e.prior_sigma() : nan};
}

/// Places in order of what was learnt, 1 for the parameter best known compared with its prior.
std::vector<double> ranks(const FilterStatistics& f) {
  std::vector<double> out;
  for (const ErrorStatistics& e : f.errors())
    out.push_back(1.0 + static_cast<double>(std::count_if(f.errors().begin(), f.errors().end(),
                                                          [&](const ErrorStatistics& other) {
                                                            return other.learning() < e.learning();
                                                          })));
  return out;
}

std::vector<std::string> parameters() {
  std::vector<std::string> keys;
  for (const ParamSpec& spec : TermLibrary::specs) keys.emplace_back(plain_name(spec.key.view()));
  return keys;
}

}  // namespace

struct StatisticsTables::Tables {
  std::vector<PointStatistics> points;
  std::vector<std::uint64_t> told;  ///< runs of the last row of `convergence`
  std::vector<std::string> labels, filters;
  ExportTable convergence;

  ExportTable table(const char* name, std::vector<ExportColumn> columns) const {
    columns.insert(columns.begin(), {{"point", "1", "study point", labels},
                                     {"filter", "1", "filter of the study", filters}});
    return {name, "row", std::move(columns)};
  }
  static ExportColumn parameter_column() {
    return {"parameter", "1", "estimated parameter", parameters()};
  }

  void tell_convergence(std::size_t p) {
    told[p] = points[p].runs();
    for (const FilterStatistics& f : points[p].filters())
      for (std::size_t k = 0; k < f.errors().size(); ++k) {
        const ErrorStatistics& e = f.errors()[k];
        const stats::Rate& silent = f.health()[k].silent;
        const auto r = rmse(e);
        convergence.add({static_cast<double>(p), place(f),
                         static_cast<double>(f.columns().layout.params[k]),
                         static_cast<double>(told[p]), r[0], r[1], r[2], e.coverage()[1].value(),
                         silent.value(), silent.low(), silent.high()});
      }
  }
  double place(const FilterStatistics& f) const {
    return static_cast<double>(
        std::find(filters.begin(), filters.end(), plain_name(f.columns().name)) - filters.begin());
  }
  ExportTable statistics() const;
  ExportTable of_filters() const;
};

ExportTable StatisticsTables::Tables::statistics() const {
  ExportTable t =
      table("statistics",
            {parameter_column(),
             {"runs", "1", "runs with an estimate"},
             {"prior_sigma_si", "1", "prior sigma in SI units of the parameter"},
             {"rmse", "1", "root mean square error over the prior sigma"},
             {"rmse_low", "1", "lower end of its 95 % interval"},
             {"rmse_high", "1", "upper end"},
             {"bias", "1", "mean error over the prior sigma"},
             {"bias_low", "1", "lower end of its 95 % interval"},
             {"bias_high", "1", "upper end"},
             {"learning_ratio", "1", "root mean square reported sigma over the prior sigma"},
             {"rank", "1", "order of learning_ratio within the filter, 1 the best known"},
             {"deception_ratio", "1", "RMSE over root mean square reported sigma, 1 if honest"},
             {"coverage_1", "1", "share of errors below 1 sigma"},
             {"coverage_2", "1", "share of errors below 2 sigma"},
             {"coverage_3", "1", "share of errors below 3 sigma"},
             {"claims_to_know", "1", "share of runs that claim to know it"},
             {"wrong", "1", "share that claims to know it and is more than 5 sigma off"},
             {"silent_failure_rate", "1", "share that is wrong with healthy statistics"},
             {"silent_failure_rate_low", "1", "lower end of its 95 % interval"},
             {"silent_failure_rate_high", "1", "upper end"},
             {"start_consistency", "1", "spread between starts over reported sigma"}});
  for (std::size_t p = 0; p < points.size(); ++p)
    for (const FilterStatistics& f : points[p].filters()) {
      const auto rank = ranks(f);
      for (std::size_t k = 0; k < f.errors().size(); ++k) {
        const ErrorStatistics& e = f.errors()[k];
        const ParameterHealth& h = f.health()[k];
        const double prior = e.prior_sigma();
        const auto r = rmse(e);
        const Estimated bias = e.bias();
        t.add({static_cast<double>(p),
               place(f),
               static_cast<double>(f.columns().layout.params[k]),
               static_cast<double>(e.runs()),
               prior,
               r[0],
               r[1],
               r[2],
               bias.value / prior,
               bias.low / prior,
               bias.high / prior,
               e.learning(),
               rank[k],
               e.deception().value,
               e.coverage()[0].value(),
               e.coverage()[1].value(),
               e.coverage()[2].value(),
               h.claims.value(),
               h.wrong.value(),
               h.silent.value(),
               h.silent.low(),
               h.silent.high(),
               h.start_ratio()});
      }
    }
  return t;
}

ExportTable StatisticsTables::Tables::of_filters() const {
  ExportTable t = table(
      "filters", {{"start", "1", "number of the initial estimate"},
                  {"nis", "1", "normalised innovations squared per degree of freedom, 1 if honest"},
                  {"nis_low", "1", "lower end of the 95 % band of an honest filter"},
                  {"nis_high", "1", "upper end"},
                  {"nis_runs_in_band", "1", "share of runs inside their own 95 % band"},
                  {"nees", "1", "normalised error squared per observed direction, 1 if honest"},
                  {"nees_low", "1", "lower end of the 95 % band of an honest filter"},
                  {"nees_high", "1", "upper end"},
                  {"nees_all", "1", "the same of all directions"},
                  {"white", "1", "share of runs whose innovations are white"},
                  {"healthy", "1", "share of runs whose NIS is in its band"},
                  {"wrong", "1", "share of runs with a parameter more than 5 sigma off"},
                  {"silent_failure_rate", "1", "share of runs that are wrong and healthy"},
                  {"silent_failure_rate_low", "1", "lower end of its 95 % interval"},
                  {"silent_failure_rate_high", "1", "upper end"},
                  {"diverged", "1", "share of runs without an estimate"}});
  for (std::size_t p = 0; p < points.size(); ++p)
    for (const FilterStatistics& f : points[p].filters())
      for (std::size_t i = 0; i < f.starts().size(); ++i) {
        const StartStatistics& s = f.starts()[i];
        t.add({static_cast<double>(p), place(f), static_cast<double>(i), s.nis.mean(), s.nis.low(),
               s.nis.high(), s.nis.in_band.value(), s.nees.mean(), s.nees.low(), s.nees.high(),
               s.nees_all.mean(), s.white.value(), s.healthy.value(), s.wrong.value(),
               s.silent.value(), s.silent.low(), s.silent.high(), s.diverged.value()});
      }
  return t;
}

StatisticsTables::StatisticsTables(const std::vector<StudyPoint>& points)
    : tables_(std::make_unique<Tables>()) {
  Tables& t = *tables_;
  for (std::size_t p = 0; p < points.size(); ++p) {
    t.points.emplace_back(points[p].study, 0);
    t.labels.push_back(points[p].label.empty() ? fmt::format("point_{}", p)
                                               : plain_name(points[p].label));
    for (const FilterStatistics& f : t.points.back().filters())
      add_once(t.filters, plain_name(f.columns().name));
  }
  t.told.assign(points.size(), 0);
  t.convergence = t.table(
      "convergence", {Tables::parameter_column(),
                      {"runs", "1", "runs so far"},
                      {"rmse", "1", "root mean square error over the prior sigma"},
                      {"rmse_low", "1", "lower end of its 95 % interval"},
                      {"rmse_high", "1", "upper end"},
                      {"coverage_2", "1", "share of errors below 2 sigma"},
                      {"silent_failure_rate", "1", "share that is wrong with healthy statistics"},
                      {"silent_failure_rate_low", "1", "lower end of its 95 % interval"},
                      {"silent_failure_rate_high", "1", "upper end"}});
}

StatisticsTables::~StatisticsTables() = default;

void StatisticsTables::add(const Block& block) {
  Tables& t = *tables_;
  t.points[block.point].add(block);
  const std::uint64_t told = t.told[block.point];
  if (told == 0 || t.points[block.point].runs() >= 2 * told) t.tell_convergence(block.point);
}

std::vector<ExportTable> StatisticsTables::finish() {
  Tables& t = *tables_;
  for (std::size_t p = 0; p < t.points.size(); ++p)
    if (t.points[p].runs() > t.told[p]) t.tell_convergence(p);
  return {t.statistics(), t.of_filters(), std::move(t.convergence)};
}

void FailuresTable::add(const StoredBlock& block) {
  for (const Failure& f : block.failures) {
    const auto [cause, fresh] = numbers_.emplace(f.cause, causes_.size());
    if (fresh) causes_.push_back(f.cause);
    rows_.push_back({static_cast<double>(block.block.point), static_cast<double>(f.run),
                     static_cast<double>(f.status), f.t, static_cast<double>(cause->second)});
  }
}

ExportTable FailuresTable::finish() {
  std::vector<std::string> statuses, lines, names;
  for (int i = 0; i < num_statuses; ++i) statuses.emplace_back(name(static_cast<RunStatus>(i)));
  for (const std::string& cause : causes_) {
    lines.push_back(cause);
    std::replace(lines.back().begin(), lines.back().end(), '\n', ' ');
    names.push_back(plain_name(cause));
  }
  ExportTable t{"failures",
                "row",
                {{"point", "1", "study point"},
                 {"run", "1", "run number"},
                 {"status", "1", "how it ended", statuses},
                 {"t_failed", "s", "time in the test at which it failed"},
                 {"cause", "1", "number of the line of attribute causes", names}},
                {{"causes", fmt::format("{}", fmt::join(lines, "\n"))}}};
  for (const auto& row : rows_) t.add(row);
  return t;
}

}  // namespace drift::mc
