#include "mc/export/export_hdf5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include "core/base/atomic_file.hpp"
#include "core/base/nan.hpp"
#include "core/base/seal.hpp"
#include "core/recording/hdf5_handle.hpp"
#include "mc/export/export_table.hpp"
#include "mc/export/export_text.hpp"
#include "mc/export/hdf5_output.hpp"
#include "mc/export/swept_coordinates.hpp"

namespace drift::mc {
namespace {

using Type = Hdf5Output::Type;

/// A group of the table's name with a dataset per column over one dimension.
void write_table(Hdf5Output& file, const ExportTable& table) {
  const std::string group = "/" + table.name;
  file.make_group(group);
  for (const auto& [key, text] : table.facts) file.set_text(group, key, text);
  const std::size_t scale = file.make_scale(group + "/" + table.row, table.rows());
  for (const ExportColumn& c : table.columns) {
    const std::string path = group + "/" + c.name;
    const std::size_t set =
        file.make_dataset(path, c.meanings.empty() ? Type::f64 : Type::i32, {table.rows()});
    file.append(set, c.values);
    file.set_text(path, "units", c.units);
    file.set_text(path, "long_name", c.about);
    if (!c.meanings.empty()) file.set_flags(path, c.meanings);
    if (!c.words.empty()) file.set_text(path, "words", fmt::format("{}", fmt::join(c.words, "\n")));
    file.attach(set, scale, 0);
  }
}

/// Names as datasets can have them, each once.
std::vector<std::string> dataset_names(const std::vector<std::string>& wanted) {
  return plain_names(wanted, {"point", "run", "status", "row", "column"});
}
std::vector<std::string> dataset_names(const std::vector<Column>& columns) {
  std::vector<std::string> wanted;
  for (const Column& c : columns) wanted.push_back(c.name);
  return dataset_names(wanted);
}

/// What was swept, a study point per row: numbers in their unit, words by their places.
ExportTable swept_table(const std::vector<StudyPoint>& points) {
  ExportTable t{"points", "row", {}};
  const std::vector<SweptCoordinate> all = swept_coordinates(points);
  std::vector<std::string> keys;
  for (const SweptCoordinate& c : all) keys.push_back(c.key);
  const std::vector<std::string> names = dataset_names(keys);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const SweptCoordinate& c = all[k];
    if (!c.numbers.empty()) {
      t.columns.push_back({.name = names[k],
                           .units = std::string(c.unit.symbol.view()),
                           .about = c.key,
                           .values = c.numbers});
      continue;
    }
    ExportColumn words{.name = names[k], .about = c.key};
    std::vector<std::string> seen;
    for (const std::string& word : c.words) {
      const auto at = std::ranges::find(seen, word);
      words.values.push_back(static_cast<double>(at - seen.begin()));
      if (at == seen.end()) seen.push_back(word);
    }
    words.meanings = plain_names(seen);
    words.words = std::move(seen);
    t.columns.push_back(std::move(words));
  }
  return t;
}

/// Points that have the same columns, and what is written of them.
class RunsGroup {
 public:
  RunsGroup(Hdf5Output& file, const std::string& suffix, const std::vector<Column>& columns,
            hsize_t rows, std::vector<std::size_t> points, const std::vector<std::string>& labels)
      : file_(file),
        group_("/runs" + suffix),
        summary_("/summary" + suffix),
        columns_(columns),
        points_(std::move(points)),
        names_(dataset_names(columns)),
        values_(columns.size() + first_column),
        statistics_(points_.size() * columns.size()) {
    file_.make_group(group_);
    file_.make_group(summary_);
    for (const std::size_t p : points_) own_labels_.push_back(labels[p]);
    const std::size_t scale = file_.make_scale(group_ + "/row", rows);
    add_set("point", Type::i32, rows);
    add_set("run", Type::i64, rows);
    add_set("status", Type::i8, rows);
    std::vector<std::string> statuses;
    for (int i = 0; i < num_statuses; ++i) statuses.emplace_back(name(static_cast<RunStatus>(i)));
    file_.set_flags(group_ + "/point", labels);
    file_.set_flags(group_ + "/status", statuses);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      add_set(names_[c], Type::f64, rows);
      file_.set_text(group_ + "/" + names_[c], "units", std::string(columns[c].unit.symbol.view()));
      file_.set_text(group_ + "/" + names_[c], "long_name", columns[c].name);
    }
    for (const std::size_t set : sets_) file_.attach(set, scale, 0);
  }

  void add(const Block& b) {
    const std::size_t n = columns_.size();
    for (std::size_t r = 0; r < b.status.size(); ++r) {
      values_[0].push_back(static_cast<double>(b.point));
      values_[1].push_back(static_cast<double>(b.first + r));
      values_[2].push_back(static_cast<double>(b.status[r]));
      for (std::size_t c = 0; c < n; ++c)
        values_[first_column + c].push_back(in_column_unit(b.rows[r * n + c], columns_[c]));
    }
    const auto at = static_cast<std::size_t>(std::find(points_.begin(), points_.end(), b.point) -
                                             points_.begin());
    for (std::size_t c = 0; c < n; ++c) statistics_[at * n + c].add(b, c, n);
    constexpr std::size_t most_values = 1 << 21;  // 16 MB at a time
    if (values_[0].size() * (n + 1) > most_values) flush();
  }

  void finish() {
    flush();
    const std::size_t point = file_.make_scale(summary_ + "/point", points_.size());
    const std::size_t column = file_.make_scale(summary_ + "/column", columns_.size());
    file_.set_flags(summary_ + "/point", own_labels_);
    file_.set_flags(summary_ + "/column", names_);
    const auto put = [&](const char* what, auto&& value) {
      std::vector<double> numbers;
      for (std::size_t i = 0; i < statistics_.size(); ++i)
        numbers.push_back(value(statistics_[i], columns_[i % columns_.size()].unit.to_si));
      const std::size_t set = file_.make_dataset(fmt::format("{}/{}", summary_, what), Type::f64,
                                                 {points_.size(), columns_.size()});
      file_.append(set, numbers);
      file_.attach(set, point, 0);
      file_.attach(set, column, 1);
    };
    put("n", [](const Statistics& s, double) { return static_cast<double>(s.moments.n); });
    put("mean", [](const Statistics& s, double u) {
      return s.moments.n > 0 ? s.moments.mean / u : nan_value;
    });
    put("sd", [](const Statistics& s, double u) {
      return s.moments.n > 1 ? std::sqrt(s.moments.m2 / static_cast<double>(s.moments.n - 1)) / u
                             : nan_value;
    });
    put("min",
        [](const Statistics& s, double u) { return s.moments.n > 0 ? s.min / u : nan_value; });
    put("max",
        [](const Statistics& s, double u) { return s.moments.n > 0 ? s.max / u : nan_value; });
  }

 private:
  struct Statistics {
    Moments moments;
    double min = std::numeric_limits<double>::infinity(), max = -min;
    /// Where one filter diverges, what the others found counts: its own numbers are missing.
    void add(const Block& b, std::size_t c, std::size_t n) {
      for (std::size_t r = 0; r < b.status.size(); ++r) {
        const double v = b.rows[r * n + c];
        const RunStatus s = b.status[r];
        if (s != RunStatus::ok && s != RunStatus::filter_diverged) continue;
        if (!std::isfinite(v)) continue;
        moments.add(v);
        min = std::min(min, v), max = std::max(max, v);
      }
    }
  };

  void add_set(const std::string& name, Type type, hsize_t rows) {
    sets_.push_back(file_.make_dataset(group_ + "/" + name, type, {rows}));
  }

  void flush() {
    for (std::size_t i = 0; i < sets_.size(); ++i) {
      file_.append(sets_[i], values_[i]);
      values_[i].clear();
    }
  }

  static constexpr std::size_t first_column = 3;  ///< behind point, run and status

  Hdf5Output& file_;
  std::string group_, summary_;
  std::vector<Column> columns_;
  std::vector<std::size_t> points_;
  std::vector<std::string> names_, own_labels_;
  std::vector<std::size_t> sets_;            ///< numbers of the datasets of group_
  std::vector<std::vector<double>> values_;  ///< of each, not yet written
  std::vector<Statistics> statistics_;
};

bool same_columns(const std::vector<Column>& a, const std::vector<Column>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Column& x, const Column& y) {
    return x.name == y.name && x.unit.symbol == y.unit.symbol;
  });
}

std::vector<std::string> write(StudyReader& reader, const StopRules& rules, const std::string& path,
                               const std::vector<StudyPoint>& study_points) {
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
    labels.push_back(points[p].label.empty() ? fmt::format("point_{}", p) : points[p].label);
  }
  labels = plain_names(labels);
  std::vector<hsize_t> rows(sets.size(), 0);
  reader.each_result(
      rules, [&](const StoredBlock& b) { rows[set_of[b.block.point]] += b.block.status.size(); });

  Hdf5Output file(path);
  for (const auto& [key, value] : provenance_of(reader)) file.set_text("/", key, value);
  std::vector<std::string> names;
  StatisticsTables statistics(study_points);
  FailuresTable failures;
  {
    std::vector<RunsGroup> groups;
    for (std::size_t s = 0; s < sets.size(); ++s) {
      const std::string suffix = sets.size() == 1 ? "" : fmt::format("_{}", s + 1);
      groups.emplace_back(file, suffix, points[sets[s].front()].columns, rows[s], sets[s], labels);
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
  if (points.size() > 1 && !study_points.empty()) tables.push_back(swept_table(study_points));
  if (!study_points.empty()) std::ranges::move(statistics.finish(), std::back_inserter(tables));
  for (const ExportTable& table : tables) {
    write_table(file, table);
    names.push_back(table.name);
  }
  file.complete();
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
  } catch (const Hdf5Output::Refused&) {
    throw_cannot_write(path, "HDF5 cannot complete the file, or it does not read back as written");
  }
  append_seal(target.temporary(), path);  // HDF5 leaves what follows its end alone
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
