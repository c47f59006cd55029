#include "mc/export/export_netcdf.hpp"

#include <algorithm>
#include <iterator>
#include <set>

#include "core/base/atomic_file.hpp"
#include "core/base/check.hpp"
#include "core/base/nan.hpp"
#include "core/base/seal.hpp"
#include "mc/export/export_table.hpp"
#include "mc/export/export_text.hpp"
#include "mc/export/named_axes.hpp"

namespace drift::mc {
namespace {

/// What the file holds besides the dimensions and what was swept: groups of tables in their order,
/// and arrays, those of a run beside the stored_fields.
namespace in_file {
constexpr const char* tables[] = {"statistics", "filters"};
constexpr const char *estimate = "estimate", *sigma = "sigma", *truth = "truth", *status = "status",
                     *prior_mean = "prior_mean", *prior_sigma = "prior_sigma";

std::set<std::string> names() {
  std::set<std::string> all{estimate, sigma, truth, status, prior_mean, prior_sigma};
  all.insert(std::begin(tables), std::end(tables));
  for (const StoredField& field : stored_fields) all.insert(field.in_netcdf);
  return all;
}
}  // namespace in_file

/// The arrays over runs, filled run after run; runs that are missing are NaN.
class RunArrays {
 public:
  RunArrays(Hdf5Output& file, NamedGroup& group, const NamedAxes& axes, std::uint64_t runs)
      : file_(file), axes_(axes), runs_(runs), fits_(axes.filters.size() * axes.starts) {
    const auto of_parameter = axes.with_point({"run", "filter", "start", "parameter"}),
               of_fit = axes.with_point({"run", "filter", "start"});
    const std::size_t parameters = axes.params.size();
    add(group.make(in_file::estimate, of_parameter,
                   {unit_of_parameter, "estimate at the end of the test"}),
        fits_ * parameters);
    add(group.make(in_file::sigma, of_parameter,
                   {unit_of_parameter, "its reported standard deviation"}),
        fits_ * parameters);
    add(group.make(in_file::truth, axes.with_point({"run", "parameter"}),
                   {unit_of_parameter, "true value at the end of the test"}),
        parameters);
    for (const StoredField& field : stored_fields)
      add(group.make(field.in_netcdf, of_fit, {"1", field.about}), fits_);
    add(group.make(in_file::status, axes.with_point({"run"}),
                   {"1", "how the run ended; -1 where it was not made"}, Hdf5Output::Type::i8),
        1);
    std::vector<std::string> statuses;
    for (int i = 0; i < num_statuses; ++i) statuses.emplace_back(name(static_cast<RunStatus>(i)));
    file_.set_flags(group.path_of(in_file::status), statuses);
  }

  void add(const Block& b) {
    pad(b.point * runs_ + b.first);
    const std::size_t n = axes_.columns[b.point].count;
    for (std::size_t r = 0; r < b.status.size(); ++r)
      put({b.rows.data() + r * n, n}, axes_.columns[b.point], b.status[r]);
    done_ += b.status.size();
    flush();
  }

  void finish() { pad(axes_.points.size() * runs_); }

 private:
  enum Place : std::size_t { estimate, sigma, truth, first_field };
  struct Array {
    std::size_t dataset, of_a_run;
    std::vector<double> values = {};  ///< not yet written
  };

  void add(std::size_t dataset, std::size_t of_a_run) { arrays_.push_back({dataset, of_a_run}); }

  void widen() {
    for (Array& a : arrays_) a.values.resize(a.values.size() + a.of_a_run, nan_value);
    arrays_.back().values.back() = -1.0;
  }

  /// Fills the places up to a run with nothing.
  void pad(std::uint64_t until) {
    constexpr std::uint64_t most = 1024;
    while (done_ < until) {
      for (std::uint64_t k = std::min(most, until - done_); k > 0; --k, ++done_) widen();
      flush();
    }
  }

  void put(std::span<const double> row, const StudyColumns& columns, RunStatus status) {
    widen();
    const auto last = [&](std::size_t array) {
      return arrays_[array].values.end() - static_cast<std::ptrdiff_t>(arrays_[array].of_a_run);
    };
    const auto in_unit = [](double si, std::size_t param) {
      return si / TermLibrary::specs[param].unit.to_si;
    };
    for (std::size_t k = 0; k < columns.truth.size(); ++k) {
      const std::size_t p = columns.truth[k];
      *(last(truth) + static_cast<std::ptrdiff_t>(axes_.parameter(p))) = in_unit(row[k], p);
    }
    for (const StudyColumns::Filter& f : columns.filters)
      for (std::size_t s = 0; s < f.starts; ++s) {
        const std::size_t fit = axes_.filter(f.name) * axes_.starts + s;
        for (std::size_t k = 0; k < f.layout.size(); ++k) {
          const std::size_t p = f.layout.params[k];
          const auto at =
              static_cast<std::ptrdiff_t>(fit * axes_.params.size() + axes_.parameter(p));
          *(last(estimate) + at) = in_unit(row[f.estimate(s, k)], p);
          *(last(sigma) + at) = in_unit(row[f.sigma(s, k)], p);
        }
        for (const StoredField& field : stored_fields)
          *(last(std::size_t{first_field} + field.value) + static_cast<std::ptrdiff_t>(fit)) =
              row[f.at(s, field.value)];
      }
    arrays_.back().values.back() = static_cast<double>(status);
  }

  void flush() {
    for (Array& a : arrays_) {
      file_.append(a.dataset, a.values);
      a.values.clear();
    }
  }

  Hdf5Output& file_;
  const NamedAxes& axes_;
  std::uint64_t runs_;
  std::size_t fits_;  ///< filters times starts
  std::uint64_t done_ = 0;
  std::vector<Array> arrays_;
};

/// What a filter believed of each parameter beforehand.
void write_priors(NamedGroup& group, const NamedAxes& axes) {
  std::vector<double> mean(axes.points.size() * axes.filters.size() * axes.params.size(),
                           nan_value),
      sigma = mean;
  for (std::size_t p = 0; p < axes.points.size(); ++p)
    for (const StudyColumns::Filter& f : axes.columns[p].filters)
      for (std::size_t k = 0; k < f.layout.size(); ++k) {
        const std::size_t param = f.layout.params[k];
        const std::size_t at =
            (p * axes.filters.size() + axes.filter(f.name)) * axes.params.size() +
            axes.parameter(param);
        mean[at] = f.layout.mean[k] / TermLibrary::specs[param].unit.to_si;
        sigma[at] = f.layout.sigma[k] / TermLibrary::specs[param].unit.to_si;
      }
  const auto dimensions = axes.with_point({"filter", "parameter"});
  group.put(in_file::prior_mean, dimensions,
            {unit_of_parameter, "mean that the filter begins with"}, mean);
  group.put(in_file::prior_sigma, dimensions,
            {unit_of_parameter, "1 sigma that the filter begins with"}, sigma);
}

/// A table whose rows are keyed by point, filter and a third column, as arrays over them.
enum class Third { start, parameter };

void write_statistics(Hdf5Output& file, const NamedAxes& axes, const ExportTable& table,
                      Third third) {
  const bool of_start = third == Third::start;
  NamedGroup group(file, "/" + table.name);
  axes.make_dimensions(group);
  const std::size_t along = of_start ? axes.starts : axes.params.size();
  std::vector<std::size_t> place;  // of each row
  for (std::size_t r = 0; r < table.rows(); ++r) {
    const auto key = [&](std::size_t column) {
      return static_cast<std::size_t>(table.columns[column].values[r]);
    };
    const std::size_t k = of_start ? key(2) - 1 : axes.parameter(key(2));
    place.push_back((key(0) * axes.filters.size() + key(1)) * along + k);
  }
  const auto dimensions = axes.with_point({"filter", of_start ? "start" : "parameter"});
  for (std::size_t c = 3; c < table.columns.size(); ++c) {
    const ExportColumn& column = table.columns[c];
    std::vector<double> values(axes.points.size() * axes.filters.size() * along, nan_value);
    for (std::size_t r = 0; r < table.rows(); ++r) values[place[r]] = column.values[r];
    group.put(column.name, dimensions, {column.units, column.about}, values);
  }
}

const ExportTable& table_named(const std::vector<ExportTable>& tables, std::string_view name) {
  const auto at = std::ranges::find(tables, name, &ExportTable::name);
  DRIFT_DEMAND(at != tables.end());
  return *at;
}

void write_named(StudyReader& reader, const StopRules& rules, const std::string& path,
                 const std::vector<StudyPoint>& points) {
  const NamedAxes axes(points, in_file::names());
  std::uint64_t runs = 0;
  reader.each_result(rules, [&](const StoredBlock& b) {
    runs = std::max(runs, b.block.first + b.block.status.size());
  });
  Hdf5Output file(path);
  for (const auto& [key, value] : provenance_of(reader)) file.set_text("/", key, value);
  NamedGroup root(file, "");
  axes.make_dimensions(root);
  root.number_along("run", runs, 0, "number of the run");
  write_priors(root, axes);
  RunArrays arrays(file, root, axes, runs);
  StatisticsTables statistics(points);
  reader.each_result(rules, [&](const StoredBlock& b) {
    arrays.add(b.block);
    statistics.add(b.block);
  });
  arrays.finish();
  const std::vector<ExportTable> tables = statistics.finish();
  write_statistics(file, axes, table_named(tables, in_file::tables[0]), Third::parameter);
  write_statistics(file, axes, table_named(tables, in_file::tables[1]), Third::start);
  file.complete();
}

}  // namespace

void export_netcdf(StudyReader& reader, const StopRules& rules, const std::string& path,
                   const std::vector<StudyPoint>& points) {
  AtomicFile target(path);
  try {
    write_named(reader, rules, target.temporary(), points);
  } catch (const Hdf5Output::Refused&) {
    throw_cannot_write(path, "HDF5 cannot complete the file, or it does not read back as written");
  }
  append_seal(target.temporary(), path);  // HDF5 leaves what follows its end alone
  target.commit();
}

}  // namespace drift::mc
