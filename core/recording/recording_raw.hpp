#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/weighed_texts.hpp"
#include "core/recording/recording_format.hpp"

namespace drift {

/// Facts of a recording, in order: key and value.
using Facts = std::vector<std::pair<std::string, std::string>>;

/// One column as it stands in the file.
struct RawColumn {
  std::string name;
  std::optional<std::string> unit;      ///< empty: the file gives none
  std::vector<double> values;           ///< in the unit of the file
  double sign = 1.0;                    ///< the values are multiplied by it
  std::optional<ChannelOffset> offset;  ///< added after unit and sign
  std::size_t numbers = 0, texts = 0;   ///< cells of a text file that hold one or the other
  bool clock = false;  ///< the cells held times of day or dates, which are seconds here
};

/// A recording as it stands in the file, before anything is checked or converted.
struct RawRecording {
  Facts facts;
  std::vector<RawColumn> columns;
  std::vector<std::size_t> lines;  ///< line of each row; empty: rows are counted from 1
  SampleKind kind = SampleKind::rates;
  AngleDigits angles = AngleDigits::automatic;
  bool settled = true;               ///< the columns were told apart without a problem
  WeighedTexts remarks;              ///< sentences about how the file was understood
  std::string unmapped_temperature;  ///< as in Recording
};

/// Most facts a recording may carry; more is not a recording.
inline constexpr std::size_t most_facts = 1000;
/// Longest fact, key and value together [bytes]: what every format can hold.
inline constexpr std::size_t longest_fact = 60000;

/// Adds a fact, line ends within it turned into spaces. A key that occurs again has its values
/// joined by "; ". False if there are too many facts or this one is too long.
bool add_fact(RawRecording& raw, std::string_view key, std::string_view value);

/// A fact as every format can hold it: control characters become spaces, none at the ends.
std::string single_line(std::string_view text);

}  // namespace drift
