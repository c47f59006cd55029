#include "mc/export/export_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "mc/export/export_text.hpp"
#include "mc/statistics/point_statistics.hpp"

namespace drift::mc {
namespace {

void add_once(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
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

/// A number of a row, with the head of its column.
struct Number {
  const char *name, *about;
  double value;
  const char* units = "1";
};

std::vector<Number> rmse_of(const ErrorStatistics& e) {
  const Estimated r = e.rmse();
  const double unit = e.prior_sigma();
  return {{"rmse", "root mean square error over the prior sigma", r.value / unit},
          {"rmse_low", "lower end of its 95 % interval", r.low / unit},
          {"rmse_high", "upper end", r.high / unit}};
}

std::vector<Number> silent_of(const stats::Rate& silent, const char* about) {
  return {{"silent_failure_rate", about, silent.value()},
          {"silent_failure_rate_low", "lower end of its 95 % interval", silent.low()},
          {"silent_failure_rate_high", "upper end", silent.high()}};
}

std::vector<Number> joined(std::initializer_list<std::vector<Number>> parts) {
  std::vector<Number> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

const ErrorStatistics nothing(1.0);  // for the heads of columns
constexpr const char* wrong_in_silence = "share that is wrong with healthy statistics";

/// What is told of a parameter at the end; errors over its prior sigma.
std::vector<Number> numbers_of(const ErrorStatistics& e, const ParameterHealth& h, double rank) {
  const Estimated bias = e.bias();
  const double unit = e.prior_sigma();
  return joined(
      {{{"runs", "runs with an estimate", static_cast<double>(e.runs())},
        {"prior_sigma_si", "prior sigma in SI units of the parameter", unit,
         "SI unit of the parameter"}},
       rmse_of(e),
       {{"bias", "mean error over the prior sigma", bias.value / unit},
        {"bias_low", "lower end of its 95 % interval, Student's t", bias.low / unit},
        {"bias_high", "upper end", bias.high / unit},
        {"learning_ratio", "root mean square reported sigma over the prior sigma", e.learning()},
        {"rank", "order of learning_ratio within the filter, 1 the best known", rank},
        {"deception_ratio", "RMSE over root mean square reported sigma, 1 if honest",
         e.deception().value},
        {"coverage_1", "share of errors below 1 sigma", e.coverage()[0].value()},
        {"coverage_2", "share of errors below 2 sigma", e.coverage()[1].value()},
        {"coverage_3", "share of errors below 3 sigma", e.coverage()[2].value()},
        {"claims_to_know", "share of runs that claim to know it", h.claims.value()},
        {"wrong", "share that claims to know it and is more than 5 sigma off", h.wrong.value()}},
       silent_of(h.silent, wrong_in_silence),
       {{"start_consistency", "spread between starts over reported sigma", h.start_ratio()}}});
}

/// What is told of it on the way.
std::vector<Number> numbers_so_far(const ErrorStatistics& e, const ParameterHealth& h,
                                   std::uint64_t runs) {
  return joined({{{"runs", "runs so far", static_cast<double>(runs)}},
                 rmse_of(e),
                 {{"coverage_2", "share of errors below 2 sigma", e.coverage()[1].value()}},
                 silent_of(h.silent, wrong_in_silence)});
}

/// What is told of a filter, started in one way.
std::vector<Number> numbers_of(const StartStatistics& s) {
  return joined(
      {{{"nis", "normalised innovations squared per degree of freedom, 1 if honest", s.nis.mean()},
        {"nis_expected_low", "lower end of the 95 % band of an honest filter", s.nis.low()},
        {"nis_expected_high", "upper end", s.nis.high()},
        {"nis_runs_in_band", "share of runs inside their own 95 % band", s.nis.in_band.value()},
        {"nees", "normalised error squared per observed direction, 1 if honest", s.nees.mean()},
        {"nees_expected_low", "lower end of the 95 % band of an honest filter", s.nees.low()},
        {"nees_expected_high", "upper end", s.nees.high()},
        {"nees_all", "the same of all directions", s.nees_all.mean()},
        {"white", "share of runs whose innovations are white", s.white.value()},
        {"healthy", "share of runs whose NIS is in its band", s.healthy.value()},
        {"wrong",
         "share of runs that diverged, or with a parameter that the filter claims to know more "
         "than 5 sigma off",
         s.wrong.value()}},
       silent_of(s.silent, "share of runs that are wrong and healthy"),
       {{"diverged", "share of runs without an estimate", s.diverged.value()}}});
}

}  // namespace

struct StatisticsTables::Tables {
  std::vector<PointStatistics> points;
  std::vector<std::uint64_t> told;  ///< runs of the last row of `convergence`
  std::vector<std::string> labels, filters;
  ExportTable convergence;

  /// A table whose rows are keys and numbers like these.
  ExportTable table(const char* name, ExportColumn key, const std::vector<Number>& like) const {
    std::vector<ExportColumn> columns{{"point", "1", "study point", labels},
                                      {"filter", "1", "filter of the study", plain_names(filters)},
                                      std::move(key)};
    for (const Number& n : like) columns.push_back({n.name, n.units, n.about});
    return {name, "row", std::move(columns)};
  }
  static void add(ExportTable& to, std::size_t point, double filter, double key,
                  const std::vector<Number>& numbers) {
    std::vector<double> row{static_cast<double>(point), filter, key};
    for (const Number& n : numbers) row.push_back(n.value);
    to.add(row);
  }
  static ExportColumn parameter_column() {
    return {"parameter", "1", "estimated parameter", parameters()};
  }

  void tell_convergence(std::size_t p) {
    told[p] = points[p].runs();
    for (const FilterStatistics& f : points[p].filters())
      for (std::size_t k = 0; k < f.errors().size(); ++k)
        add(convergence, p, place(f), number(f, k),
            numbers_so_far(f.errors()[k], f.health()[k], told[p]));
  }
  static double number(const FilterStatistics& f, std::size_t k) {
    return static_cast<double>(f.columns().layout.params[k]);
  }
  double place(const FilterStatistics& f) const {
    return static_cast<double>(std::find(filters.begin(), filters.end(), f.columns().name) -
                               filters.begin());
  }
  ExportTable statistics() const;
  ExportTable of_filters() const;
};

ExportTable StatisticsTables::Tables::statistics() const {
  ExportTable t = table("statistics", parameter_column(), numbers_of(nothing, {}, 0.0));
  for (std::size_t p = 0; p < points.size(); ++p)
    for (const FilterStatistics& f : points[p].filters()) {
      const auto rank = ranks(f);
      for (std::size_t k = 0; k < f.errors().size(); ++k)
        add(t, p, place(f), number(f, k), numbers_of(f.errors()[k], f.health()[k], rank[k]));
    }
  return t;
}

ExportTable StatisticsTables::Tables::of_filters() const {
  ExportTable t =
      table("filters", {"start", "1", "initial estimate, from 1"}, numbers_of(StartStatistics{}));
  for (std::size_t p = 0; p < points.size(); ++p)
    for (const FilterStatistics& f : points[p].filters())
      for (std::size_t i = 0; i < f.starts().size(); ++i)
        add(t, p, place(f), static_cast<double>(i + 1), numbers_of(f.starts()[i]));
  return t;
}

StatisticsTables::StatisticsTables(const std::vector<StudyPoint>& points)
    : tables_(std::make_unique<Tables>()) {
  Tables& t = *tables_;
  for (std::size_t p = 0; p < points.size(); ++p) {
    t.points.emplace_back(points[p].study);
    t.labels.push_back(points[p].label.empty() ? fmt::format("point_{}", p) : points[p].label);
    for (const FilterStatistics& f : t.points.back().filters())
      add_once(t.filters, f.columns().name);
  }
  t.labels = plain_names(t.labels);
  t.told.assign(points.size(), 0);
  t.convergence =
      t.table("convergence", Tables::parameter_column(), numbers_so_far(nothing, {}, 0));
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
    names.push_back(cause);
  }
  names = plain_names(names);
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
