#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mc/store/stored_block.hpp"
#include "mc/study/sweep.hpp"

namespace drift::mc {

/// A column of a small table for export; where `meanings` are given its values are places in that
/// list. Of meanings that are no plain names `words` has them as they are written.
struct ExportColumn {
  std::string name, units = "1", about;
  std::vector<std::string> meanings = {}, words = {};
  std::vector<double> values = {};
};

/// A small table for export, all columns of one length.
struct ExportTable {
  std::string name, row;  ///< of the table, of what a row is
  std::vector<ExportColumn> columns;
  std::vector<std::pair<std::string, std::string>> facts = {};  ///< text beside it

  std::size_t rows() const { return columns.front().values.size(); }
  void add(const std::vector<double>& row_values) {
    for (std::size_t c = 0; c < columns.size(); ++c) columns[c].values.push_back(row_values[c]);
  }
};

/// Gathers what the runs of a study say of its filters, block by block in order:
///   statistics   point, filter, parameter: RMSE, bias and sigma over the prior sigma, rank by what
///   was
///                learnt, coverage of 1, 2, 3 sigma, silent failures, dependence on the start
///   filters      point, filter, start: NIS and NEES per degree of freedom with their 95 % bands,
///   shares of
///                runs that are healthy, wrong, silently wrong, diverged
///   convergence  the same of RMSE, coverage and silent failures after 64, 128, 256, ... runs and
///   at the end
/// Intervals are of 95 % and those of summary.json: of an RMSE and of a bias after Student,
/// of a rate after Wilson.
class StatisticsTables {
 public:
  explicit StatisticsTables(const std::vector<StudyPoint>& points);
  ~StatisticsTables();
  void add(const Block& block);
  /// The three, in this order.
  std::vector<ExportTable> finish();

 private:
  struct Tables;
  std::unique_ptr<Tables> tables_;
};

/// Gathers failed runs: point, run, status, time, cause. The causes themselves are the fact
/// "causes", a line each; the column `cause` is the number of the line.
class FailuresTable {
 public:
  void add(const StoredBlock& block);
  ExportTable finish();

 private:
  std::map<std::string, std::size_t> numbers_;  ///< of causes
  std::vector<std::string> causes_;
  std::vector<std::vector<double>> rows_;
};

}  // namespace drift::mc
