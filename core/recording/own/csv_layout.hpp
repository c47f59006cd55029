#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/recording/own/header.hpp"

namespace drift {

/// Where things stand in a CSV file.
struct CsvLayout {
  std::size_t header_line = 0;  ///< from 1; 0: there is none; rows begin below it
  std::size_t unit_line = 0;    ///< the row of units below it; 0: none
  std::size_t last_text = 0;    ///< the last line of text below it, units or words; 0: none
  std::size_t above = 0;        ///< lines above the header that are passed over
  char delimiter = ',';
  std::vector<HeaderCell> header;
};

/// Looks at the first lines of a file for its header row: the first line with two names that are
/// known, else of the lines of text above the first row of numbers the one with most names that are
/// guessed, else the last of them, else the first line. A row of units below it gives units to the
/// columns whose header has none; other text between it and the rows is passed over. A format that
/// names the columns has rows alone, below the lines it skips. The header is empty if the file
/// holds nothing. InputError (io).
CsvLayout find_layout(const std::string& path, const RecordingFormat& format, RecordingKind kind);

}  // namespace drift
