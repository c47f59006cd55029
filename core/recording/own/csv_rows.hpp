#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/recording/line_reader.hpp"
#include "core/recording/own/clock.hpp"
#include "core/recording/own/columns.hpp"
#include "core/recording/own/csv_cells.hpp"
#include "core/recording/own/csv_layout.hpp"

namespace drift {

/// Reads the rows of a CSV file whose layout is known.
class CsvRows {
 public:
  CsvRows(const std::string& path, CsvLayout layout, const RecordingFormat& format,
          RecordingKind kind, Problems& problems);

  /// The columns under the program's names. InputError (io).
  RawRecording read(const ReadProgress& progress = {});
  /// UTF-16 is read as longer text, whose end is not known beforehand.
  static double part_of(std::size_t consumed, std::size_t size) {
    return size > 0 ? std::min(0.99, static_cast<double>(consumed) / static_cast<double>(size))
                    : 0.0;
  }

 private:
  /// What is wrong with a row, kept until it is known that it is not the last, which may be cut.
  struct Complaint {
    std::string where, wrong, expected, fix;
  };

  std::string here(std::string_view column = {}) const;
  bool is_text(std::string_view line);
  bool is_header_sound();
  void read_comment(std::string_view text);
  void read_row(std::string_view line);
  void take_date(std::string_view cell);
  std::optional<Complaint> read_cell(std::size_t i, std::string_view cell);
  std::optional<Complaint> read_time(std::size_t i, std::string_view cell);
  std::optional<Complaint> read_position(std::size_t i, std::string_view cell);
  bool repeats_header(const std::vector<std::string_view>& cells) const;
  bool names_no_time(const std::vector<std::string_view>& cells) const;
  bool may_be_cut(std::string_view cell) const;
  void note_end(std::string_view cell);
  void note(std::string remark);
  void note_clock();
  void report_pending();
  void finish();
  void reserve();

  LineReader lines_;
  CsvLayout layout_;
  const RecordingFormat& format_;
  Problems& problems_;
  CellSplitter splitter_;
  RawRecording raw_;
  std::vector<ColumnUse> uses_;
  std::vector<double> row_;
  std::vector<Complaint> pending_;
  std::string decoded_;
  std::size_t windows_line_ = 0, point_line_ = 0, comma_line_ = 0;
  Clock clock_;
  std::optional<std::size_t> date_column_;  ///< whose cells stand before the times of day
  std::string date_;                        ///< of this row, or of the last one above that has one
  std::size_t dates_above_ = 0, date_line_ = 0;  ///< rows without a date of their own; the first
  std::string last_end_;                         ///< the last cell of the row before
  std::optional<std::size_t> decimals_;  ///< of the last column, where all rows have the same
  bool rows_have_ends_ = false;          ///< a last cell was seen
  bool last_row_cut_ = false;
  std::size_t footer_lines_ = 0, footer_line_ = 0;  ///< of text, up to here; the first of them
  std::size_t repeated_headers_ = 0, repeated_line_ = 0;
};

}  // namespace drift
