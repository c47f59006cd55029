#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/nan.hpp"
#include "core/base/units.hpp"
#include "core/base/weighed_texts.hpp"

namespace drift {

/// One column of a recording.
struct Channel {
  std::string name;
  Unit unit;                   ///< as written in the file
  std::vector<double> values;  ///< in internal units (rad, s, g, ...); NaN: not measured
};

/// What was measured, simulated or real: columns of equal length, and facts ("# key = value").
struct Recording {
  std::string source;  ///< the file it came from, for messages; empty if simulated
  std::vector<std::pair<std::string, std::string>> facts;
  std::vector<Channel> channels;
  std::vector<std::size_t> lines;  ///< line (CSV) or 1-based row of each sample, for messages
  /// What the rows of a recording that was made ready stand for; not in files. Empty: one sample
  /// each, since the row before.
  std::vector<double> begins;        ///< when the interval of each row begins [s]
  std::vector<double> samples;       ///< samples of the plan whose noise its accelerometers average
  std::vector<double> readings;      ///< readings whose noise its gimbal angles are a mean of
  WeighedTexts remarks;              ///< sentences about how the file was understood
  std::string unmapped_temperature;  ///< the remark on what looks like one and is not mapped; or ""

  std::size_t rows() const { return channels.empty() ? 0 : channels.front().values.size(); }
  const Channel* find(std::string_view name) const {
    for (const auto& c : channels)
      if (c.name == name) return &c;
    return nullptr;
  }
};

/// A recording of a gimballed platform or of sensors fixed to a case (core/docs/recording.md).
enum class RecordingKind { platform, strapdown };

/// Reads .csv, .h5/.hdf5 or .mat by extension, converts to internal units, checks everything that
/// can be checked without a plan. InputError (recording) lists every problem found, with
/// file:row:column, what was expected and what to do; InputError (io) if it cannot be opened.
/// Strapdown accelerations in m/s^2 become g through `gravity` [m/s^2].
Recording read_recording(const std::string& path, RecordingKind kind, double gravity);

struct RecordingFormat;

/// Told which part of a text file is read, 0 to 1, every so many lines and at its end.
using ReadProgress = std::function<void(double part)>;

/// Reads a user's file as its format says; .txt and .dat are read as CSV. The same errors.
Recording read_recording(const std::string& path, const RecordingFormat& format, RecordingKind kind,
                         double gravity, const ReadProgress& progress = {});

/// Looks over a recording that was not read from a file, as read_recording() looks over those that
/// are: channels of one length, time and the others that its kind needs, times that increase,
/// positions that are whole numbers from 1 on in the order of the plan, phases 0 or 1, a command in
/// every row, nothing infinite; NaN where a sensor was not measured. InputError (recording) lists
/// every problem found. What was read from a file passes.
void check_recording(const Recording& recording, RecordingKind kind);

/// Writes by extension, through a temporary file that is renamed when complete.
/// InputError (io) if that fails; the target is then as it was.
void write_recording(const Recording& recording, const std::string& path);

}  // namespace drift
