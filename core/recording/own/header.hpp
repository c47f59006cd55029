#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/recording/recording.hpp"
#include "core/recording/recording_format.hpp"

namespace drift {

/// One cell of a header row: "name [unit]" or "name (unit)"; "name / unit" (DIN 461) or "name in
/// unit", where what stands there is a unit.
struct HeaderCell {
  std::string whole;                ///< as it stands in the file
  std::string name;                 ///< without the unit
  std::optional<std::string> unit;  ///< empty: the cell gives none
  bool open = false;                ///< a bracket that is not closed
};

HeaderCell header_cell(std::string_view text);

/// Whether a header in the file is the one that a text of the study file means: the whole cell, its
/// name, or its name with the unit of the file behind it.
bool is_called(const HeaderCell& cell, std::string_view own);

/// Whether a text of the study file names the unit of the file beside the header: who writes
/// "T (°F) [degC]" has seen the one and means the other.
bool names_unit_too(const HeaderCell& cell, std::string_view own);

/// Names of the channels that the program knows of a kind of recording, required ones first.
std::vector<std::string_view> canonical_channels(RecordingKind kind);

/// Whether the header is a channel the program knows, or one that the format names.
bool is_known(const HeaderCell& cell, const RecordingFormat& format, RecordingKind kind);

/// The channels closest to a header that is none of them but hardly means anything else; empty for
/// a covariate of its own.
std::vector<std::string_view> meant_channels(std::string_view name,
                                             const std::vector<std::string_view>& absent);

/// A text with letters of ASCII for those with accents: "Kühlöl méd." -> "Kuehloel med.".
std::string folded(std::string_view text);

/// A header made fit for the name of a channel: "Öl temp" -> "Oel_temp".
std::string plain_channel_name(std::string_view header);

}  // namespace drift
