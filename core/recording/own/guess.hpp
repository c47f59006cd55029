#pragma once

#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/recording/own/csv_layout.hpp"

namespace drift {

/// One column of a file, as it looks, and what it may be.
struct GuessedColumn {
  HeaderCell header;
  std::size_t numbers = 0, texts = 0;  ///< cells
  double low = 0.0, high = 0.0;        ///< of the numbers
  /// Numbers of nothing but nines (-9999, 999.99), as loggers write what was not measured, as they
  /// stand, and from where to where the others are.
  std::set<std::string, std::less<>> nines;
  double low_beside = HUGE_VAL, high_beside = -HUGE_VAL;
  std::vector<std::string> words;  ///< the first different texts, in order
  std::string last_text;
  std::vector<std::size_t> text_rows;        ///< of the first stretches of one text, in order
  std::set<std::string, std::less<>> again;  ///< texts that stand again after another one
  /// Of positions: their numbers in order where one is left out; a plan that is made of the
  /// recording has none of that number.
  std::vector<std::string> numbered;
  std::string channel;     ///< the channel it may be; empty: none
  std::string unit;        ///< of the channel; "?": not to be guessed; empty: none needed
  bool by_values = false;  ///< the channel is guessed by what the column holds, not by its name
  double last = 0.0;       ///< number
  bool whole = true;       ///< all numbers are
  bool basic_times =
      true;  ///< all cells hold a time of day as ISO 8601 has it behind a date, 130510
  bool needs_date = false;  ///< they are such times, and a column of dates stands beside them
  std::pair<double, double> back{0.0, 0.0};  ///< the first number that is smaller than the last one
                                             ///< before it: that one and it; equal: none is
};

/// What a file of columns may be as a recording.
struct GuessedFile {
  CsvLayout layout;
  bool text = true;  ///< else columns of numbers under names: HDF5, MATLAB
  RecordingKind kind = RecordingKind::platform;
  std::vector<GuessedColumn> columns;
  std::size_t rows = 0;
  RecordingFormat format;  ///< reads it, where every unit could be told
  std::string counter;     ///< that may stand for time, were its tick known; empty: none
  bool complete = false;   ///< that is so, and the columns that are needed are there
};

/// Guesses by headers, units and values. InputError (io; recording, where an HDF5 or MATLAB file
/// cannot be read as columns of numbers).
GuessedFile guess_file(const std::string& path);

/// Takes the file for a recording of a kind, whatever it looked like: channels that such a
/// recording does not have are columns like any other.
void take_as(GuessedFile& file, RecordingKind kind);

/// Why the file cannot be a recording of a kind, naming the columns that say so; empty: it may be.
std::string other_kind(const GuessedFile& file, RecordingKind kind);

/// What the study file calls a column: by its name, and by the unit in the file too where that is
/// overruled.
std::string own_name(const GuessedColumn& column);

/// Whether the file is read otherwise than without a word in the study file.
bool needs_section(const GuessedFile& file);

/// The [recording] section of a study file that says so.
std::string recording_section(const GuessedFile& file);

/// What a recording needs that no column may be, and the keys that would say it, with the columns
/// whose unit would do; empty: nothing.
std::string what_is_missing(const GuessedFile& file);

/// Columns of numbers that are no channel, and what becomes of them; empty: there are none.
std::string what_has_no_place(const GuessedFile& file);

}  // namespace drift
