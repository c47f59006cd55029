#include "mc/export/export_hdf5.hpp"

#include <hdf5_hl.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include "core/base/atomic_file.hpp"
#include "core/base/check.hpp"
#include "core/recording/hdf5_handle.hpp"
#include "mc/export/export_table.hpp"
#include "mc/export/export_text.hpp"

namespace drift::mc {
namespace {

/// What HDF5 refuses, mostly for want of space on the disk.
class Refused : public std::exception {};

void check(bool good) {
  if (!good) throw Refused();
}

Hdf5Handle checked(Hdf5Handle handle) {
  check(static_cast<bool>(handle));
  return handle;
}

void set_text(hid_t object, const std::string& name, const std::string& text) {
  const Hdf5Handle type = checked({H5Tcopy(H5T_C_S1), H5Tclose});
  const Hdf5Handle space = checked({H5Screate(H5S_SCALAR), H5Sclose});
  check(H5Tset_size(type.get(), text.size() + 1) >= 0 &&
        H5Tset_cset(type.get(), H5T_CSET_UTF8) >= 0);
  const Hdf5Handle attribute =
      checked({H5Acreate2(object, name.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
               H5Aclose});
  check(H5Awrite(attribute.get(), type.get(), text.c_str()) >= 0);
}

/// CF: which number of the dataset means what.
void set_flags(hid_t dataset, const std::vector<std::string>& meanings) {
  std::vector<int> values(meanings.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<int>(i);
  const hsize_t n = values.size();
  const Hdf5Handle space = checked({H5Screate_simple(1, &n, nullptr), H5Sclose});
  const Hdf5Handle attribute = checked(
      {H5Acreate2(dataset, "flag_values", H5T_STD_I32LE, space.get(), H5P_DEFAULT, H5P_DEFAULT),
       H5Aclose});
  check(H5Awrite(attribute.get(), H5T_NATIVE_INT, values.data()) >= 0);
  set_text(dataset, "flag_meanings", fmt::format("{}", fmt::join(meanings, " ")));
}

Hdf5Handle make_dataset(hid_t group, const std::string& name, hid_t type,
                        const std::vector<hsize_t>& shape) {
  const Hdf5Handle space =
      checked({H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose});
  const Hdf5Handle plan = checked({H5Pcreate(H5P_DATASET_CREATE), H5Pclose});
  check(H5Pset_obj_track_times(plan.get(), false) >= 0);  // the same results give the same bytes
  return checked(
      {H5Dcreate2(group, name.c_str(), type, space.get(), H5P_DEFAULT, plan.get(), H5P_DEFAULT),
       H5Dclose});
}

/// 0, 1, 2, ...: the scale of a dimension.
Hdf5Handle make_scale(hid_t group, const char* name, hsize_t size) {
  Hdf5Handle scale = make_dataset(group, name, H5T_STD_I64LE, {size});
  std::vector<long long> numbers(size);
  for (std::size_t i = 0; i < size; ++i) numbers[i] = static_cast<long long>(i);
  check(size == 0 || H5Dwrite(scale.get(), H5T_NATIVE_LLONG, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                              numbers.data()) >= 0);
  check(H5DSset_scale(scale.get(), name) >= 0);
  return scale;
}

template <class T>
void write_part(hid_t dataset, hid_t type, hsize_t from, const std::vector<T>& values) {
  const hsize_t n = values.size();
  if (n == 0) return;
  const Hdf5Handle memory = checked({H5Screate_simple(1, &n, nullptr), H5Sclose});
  const Hdf5Handle space = checked({H5Dget_space(dataset), H5Sclose});
  check(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, &from, nullptr, &n, nullptr) >= 0 &&
        H5Dwrite(dataset, type, memory.get(), space.get(), H5P_DEFAULT, values.data()) >= 0);
}

/// A group of the table's name with a dataset per column over one dimension.
void write_table(hid_t file, const ExportTable& table) {
  const Hdf5Handle group = checked(
      {H5Gcreate2(file, table.name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose});
  for (const auto& [key, text] : table.facts) set_text(group.get(), key, text);
  const Hdf5Handle scale = make_scale(group.get(), table.row.c_str(), table.rows());
  for (const ExportColumn& c : table.columns) {
    const Hdf5Handle set = make_dataset(
        group.get(), c.name, c.meanings.empty() ? H5T_IEEE_F64LE : H5T_STD_I32LE, {table.rows()});
    write_part(set.get(), H5T_NATIVE_DOUBLE, 0, c.values);  // HDF5 converts
    set_text(set.get(), "units", c.units);
    set_text(set.get(), "long_name", c.about);
    if (!c.meanings.empty()) set_flags(set.get(), c.meanings);
    check(H5DSattach_scale(set.get(), scale.get(), 0) >= 0);
  }
}

/// Names as datasets can have them, each once.
std::vector<std::string> dataset_names(const std::vector<Column>& columns) {
  std::set<std::string> taken{"point", "run", "status", "row", "column"};
  std::vector<std::string> names;
  for (const Column& c : columns) {
    std::string name = plain_name(c.name);
    for (int i = 2; !taken.insert(name).second; ++i)
      name = fmt::format("{}_{}", plain_name(c.name), i);
    names.push_back(name);
  }
  return names;
}

/// Points that have the same columns, and what is written of them.
class RunsGroup {
 public:
  RunsGroup(hid_t file, const std::string& suffix, const std::vector<Column>& columns, hsize_t rows,
            std::vector<std::size_t> points, const std::vector<std::string>& labels)
      : columns_(columns),
        points_(std::move(points)),
        names_(dataset_names(columns)),
        group_(checked(
            {H5Gcreate2(file, ("runs" + suffix).c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
             H5Gclose})),
        summary_(checked(
            {H5Gcreate2(file, ("summary" + suffix).c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
             H5Gclose})),
        point_set_(make_dataset(group_.get(), "point", H5T_STD_I32LE, {rows})),
        run_set_(make_dataset(group_.get(), "run", H5T_STD_I64LE, {rows})),
        status_set_(make_dataset(group_.get(), "status", H5T_STD_I8LE, {rows})),
        values_(columns.size()),
        statistics_(points_.size() * columns.size()) {
    const Hdf5Handle scale = make_scale(group_.get(), "row", rows);
    set_flags(point_set_.get(), labels);
    std::vector<std::string> statuses;
    for (int i = 0; i < num_statuses; ++i) statuses.emplace_back(name(static_cast<RunStatus>(i)));
    set_flags(status_set_.get(), statuses);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      sets_.push_back(make_dataset(group_.get(), names_[c], H5T_IEEE_F64LE, {rows}));
      set_text(sets_[c].get(), "units", std::string(columns[c].unit.symbol.view()));
      set_text(sets_[c].get(), "long_name", columns[c].name);
    }
    for (auto* set : {&point_set_, &run_set_, &status_set_})
      check(H5DSattach_scale(set->get(), scale.get(), 0) >= 0);
    for (auto& set : sets_) check(H5DSattach_scale(set.get(), scale.get(), 0) >= 0);
    labels_ = labels;
  }

  void add(const Block& b) {
    const std::size_t n = columns_.size();
    for (std::size_t r = 0; r < b.status.size(); ++r) {
      point_.push_back(static_cast<int>(b.point));
      run_.push_back(static_cast<long long>(b.first + r));
      status_.push_back(static_cast<signed char>(b.status[r]));
      for (std::size_t c = 0; c < n; ++c)
        values_[c].push_back(in_column_unit(b.rows[r * n + c], columns_[c]));
    }
    const auto at = static_cast<std::size_t>(std::find(points_.begin(), points_.end(), b.point) -
                                             points_.begin());
    for (std::size_t c = 0; c < n; ++c) statistics_[at * n + c].add(b, c, n);
    constexpr std::size_t most_values = 1 << 21;  // 16 MB at a time
    if (point_.size() * (n + 1) > most_values) flush();
  }

  void finish() {
    flush();
    const std::size_t n = columns_.size();
    const Hdf5Handle point = make_scale(summary_.get(), "point", points_.size());
    const Hdf5Handle column = make_scale(summary_.get(), "column", n);
    std::vector<std::string> own;
    for (const std::size_t p : points_) own.push_back(labels_[p]);
    set_flags(point.get(), own);
    set_flags(column.get(), names_);
    const auto put = [&](const char* what, auto&& value) {
      std::vector<double> numbers;
      for (std::size_t i = 0; i < statistics_.size(); ++i)
        numbers.push_back(value(statistics_[i], columns_[i % n].unit.to_si));
      const Hdf5Handle set =
          make_dataset(summary_.get(), what, H5T_IEEE_F64LE, {points_.size(), n});
      check(numbers.empty() || H5Dwrite(set.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                                        numbers.data()) >= 0);
      check(H5DSattach_scale(set.get(), point.get(), 0) >= 0 &&
            H5DSattach_scale(set.get(), column.get(), 1) >= 0);
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    put("n", [](const Statistics& s, double) { return static_cast<double>(s.moments.n); });
    put("mean",
        [](const Statistics& s, double u) { return s.moments.n > 0 ? s.moments.mean / u : nan; });
    put("sd", [](const Statistics& s, double u) {
      return s.moments.n > 1 ? std::sqrt(s.moments.m2 / static_cast<double>(s.moments.n - 1)) / u
                             : nan;
    });
    put("min", [](const Statistics& s, double u) { return s.moments.n > 0 ? s.min / u : nan; });
    put("max", [](const Statistics& s, double u) { return s.moments.n > 0 ? s.max / u : nan; });
  }

 private:
  struct Statistics {
    Moments moments;
    double min = std::numeric_limits<double>::infinity(), max = -min;
    void add(const Block& b, std::size_t c, std::size_t n) {
      moments.merge(mc::moments(b, c, n));
      for (std::size_t r = 0; r < b.status.size(); ++r)
        if (const double v = b.rows[r * n + c]; b.status[r] == RunStatus::ok && std::isfinite(v))
          min = std::min(min, v), max = std::max(max, v);
    }
  };

  void flush() {
    write_part(point_set_.get(), H5T_NATIVE_INT, written_, point_);
    write_part(run_set_.get(), H5T_NATIVE_LLONG, written_, run_);
    write_part(status_set_.get(), H5T_NATIVE_SCHAR, written_, status_);
    for (std::size_t c = 0; c < columns_.size(); ++c)
      write_part(sets_[c].get(), H5T_NATIVE_DOUBLE, written_, values_[c]);
    written_ += point_.size();
    point_.clear(), run_.clear(), status_.clear();
    for (auto& v : values_) v.clear();
  }

  std::vector<Column> columns_;
  std::vector<std::size_t> points_;
  std::vector<std::string> names_, labels_;
  Hdf5Handle group_, summary_, point_set_, run_set_, status_set_;
  std::vector<Hdf5Handle> sets_;
  std::vector<int> point_;
  std::vector<long long> run_;
  std::vector<signed char> status_;
  std::vector<std::vector<double>> values_;
  std::vector<Statistics> statistics_;
  hsize_t written_ = 0;
};

bool same_columns(const std::vector<Column>& a, const std::vector<Column>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Column& x, const Column& y) {
    return x.name == y.name && x.unit.symbol == y.unit.symbol;
  });
}

std::vector<std::string> write(StudyReader& reader, const StopRules& rules, const std::string& path,
                               const std::vector<StudyPoint>& study_points) {
  // A file that a full disk cannot take stays open within HDF5, whose handler at exit writes it
  // once more and crashes. All that matters is flushed and closed below, and checked.
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const auto& points = reader.manifest().points;
  std::vector<std::vector<std::size_t>> sets;  // points by their columns
  std::vector<std::size_t> set_of(points.size());
  std::vector<std::string> labels;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto known = std::find_if(sets.begin(), sets.end(), [&](const auto& s) {
      return same_columns(points[s.front()].columns, points[p].columns);
    });
    set_of[p] = static_cast<std::size_t>(known - sets.begin());
    if (known == sets.end()) sets.emplace_back();
    sets[set_of[p]].push_back(p);
    labels.push_back(points[p].label.empty() ? fmt::format("point_{}", p)
                                             : plain_name(points[p].label));
  }
  std::vector<hsize_t> rows(sets.size(), 0);
  reader.each_result(
      rules, [&](const StoredBlock& b) { rows[set_of[b.block.point]] += b.block.status.size(); });

  const Hdf5Handle create = checked({H5Pcreate(H5P_FILE_CREATE), H5Pclose});
  const Hdf5Handle access = checked({H5Pcreate(H5P_FILE_ACCESS), H5Pclose});
  check(H5Pset_obj_track_times(create.get(), false) >= 0);
  // The older format has no attributes above 64 kB, which a long study file is.
  check(H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_LATEST) >= 0);
  Hdf5Handle file =
      checked({H5Fcreate(path.c_str(), H5F_ACC_TRUNC, create.get(), access.get()), H5Fclose});
  for (const auto& [key, value] : provenance_of(reader)) set_text(file.get(), key, value);
  std::vector<std::string> names;
  StatisticsTables statistics(study_points);
  FailuresTable failures;
  {
    std::vector<RunsGroup> groups;
    for (std::size_t s = 0; s < sets.size(); ++s) {
      const std::string suffix = sets.size() == 1 ? "" : fmt::format("_{}", s + 1);
      groups.emplace_back(file.get(), suffix, points[sets[s].front()].columns, rows[s], sets[s],
                          labels);
      names.insert(names.end(), {"runs" + suffix, "summary" + suffix});
    }
    reader.each_result(rules, [&](const StoredBlock& b) {
      groups[set_of[b.block.point]].add(b.block);
      failures.add(b);
      if (!study_points.empty()) statistics.add(b.block);
    });
    for (RunsGroup& group : groups) group.finish();
  }
  std::vector<ExportTable> tables{failures.finish()};
  if (tables.front().rows() == 0) tables.clear();
  if (!study_points.empty()) std::ranges::move(statistics.finish(), std::back_inserter(tables));
  for (const ExportTable& table : tables) {
    write_table(file.get(), table);
    names.push_back(table.name);
  }
  check(H5Fflush(file.get(), H5F_SCOPE_GLOBAL) >= 0 && file.close());
  return names;
}

}  // namespace

std::vector<std::string> export_hdf5(StudyReader& reader, const StopRules& rules,
                                     const std::string& path,
                                     const std::vector<StudyPoint>& points) {
  AtomicFile target(path);
  std::vector<std::string> groups;
  try {
    groups = write(reader, rules, target.temporary(), points);
  } catch (const Refused&) {
    throw_cannot_write(path, "HDF5 cannot complete the file");
  }
  target.commit();
  return groups;
}

std::string study_hash_of_hdf5(const std::string& path) {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  if (H5Fis_hdf5(path.c_str()) <= 0) return {};
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file || H5Aexists(file.get(), "study_hash") <= 0) return {};
  const Hdf5Handle attribute(H5Aopen(file.get(), "study_hash", H5P_DEFAULT), H5Aclose);
  if (!attribute) return {};
  const Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose);
  constexpr std::size_t longest = 200;
  if (!type || H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) != 0 ||
      H5Tget_size(type.get()) > longest)
    return {};
  std::string text(H5Tget_size(type.get()), '\0');
  if (H5Aread(attribute.get(), type.get(), text.data()) < 0) return {};
  return text.c_str();
}

}  // namespace drift::mc
