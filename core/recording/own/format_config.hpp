#pragma once

#include <string>
#include <vector>

#include "core/config/section.hpp"
#include "core/recording/recording.hpp"
#include "core/recording/recording_format.hpp"

namespace drift {

/// The keys of [recording] with one value each; columns, positions, offset and ignore are tables
/// and lists of the user's own names.
template <class Field>
void visit_options(RecordingFormat& o, Field&& field) {
  using config::Option;
  field(Option{.key = "skip_rows", .min = 0.0, .max = 1e6, .doc = "lines before the header"},
        o.skip_rows);
  field(Option{"rate", "Hz"_unit, 1e-4, 1e6, "of rows without a column of time"}, o.rate);
  field(Option{.key = "wrap", .min = 2.0, .max = 1e19, .doc = "the counter begins again there"},
        o.wrap);
  field(Option{"tick", unit::s, 1e-12, 1e5, "one count of the counter"}, o.tick);
  constexpr double latest = 600.0;  // [s]
  field(Option{"accelerometers_late", unit::s, -latest, latest,
               "they read what was so long before their row says"},
        o.accelerometers_late);
  field(Option{"gimbals_late", unit::s, -latest, latest,
               "they read what was so long before their row says"},
        o.gimbals_late);
}

/// Reads [recording]. `positions` are the names of the plan's positions: a text in the column
/// `position` that is one of them means it.
RecordingFormat read_recording_format(config::Section section, RecordingKind kind,
                                      const std::vector<std::string>& positions);

}  // namespace drift
