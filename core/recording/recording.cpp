#include "core/recording/recording.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/base/atomic_file.hpp"
#include "core/base/check.hpp"
#include "core/base/seal.hpp"
#include "core/base/sha256.hpp"
#include "core/recording/instants/shifted_readings.hpp"
#include "core/recording/line_reader.hpp"
#include "core/recording/own/columns.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/recording_check.hpp"
#include "core/recording/recording_csv.hpp"
#include "core/recording/recording_files.hpp"
#include "core/recording/recording_hdf5.hpp"
#include "core/recording/recording_mat.hpp"
#include "core/recording/recording_output.hpp"
#include "core/recording/recording_read_back.hpp"

namespace drift {
namespace {

/// What was read from a file of named columns, as the format says.
RawRecording with_format(RawRecording raw, const RecordingFormat& format, RecordingKind kind,
                         Problems& problems) {
  std::vector<HeaderCell> header;
  for (RawColumn& c : raw.columns) {
    header.push_back({c.name, c.name, c.unit, false});
    c.numbers = c.values.size();
  }
  if (raw.columns.empty()) return raw;
  if (!format.date.empty())
    problems.add("", "recording.date of the study file names a column of dates",
                 "one in a text file: columns of this format hold numbers",
                 "Remove it, and write times in seconds");
  const std::size_t before = problems.count();
  const auto uses = uses_of_columns(header, format, kind, problems, raw);
  raw.settled = problems.count() == before;
  for (std::size_t i = 0; i < uses.size(); ++i)
    if (uses[i].role == ColumnUse::Role::position)
      for (double& x : raw.columns[i].values)
        for (const auto& [text, number] : format.positions)
          if (text == fmt::format("{:.15g}", x)) {
            x = number;
            break;
          }
  return with_channels(std::move(raw), uses, format, problems);
}

[[noreturn]] void throw_extension(const std::string& path, const std::string& extension) {
  throw InputError(
      ExitCode::recording,
      fmt::format("{}: no format is known for the extension {} (expected .csv, .h5, .hdf5 "
                  "or .mat; to read also .txt, .dat, .tsv). Rename or convert the file",
                  path, in_quotes(extension)));
}

/// Empty if it is a file and can be opened.
std::string why_unreadable(const std::string& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0) return std::strerror(errno);
  if (S_ISDIR(info.st_mode)) return "it is a directory";
  if (!S_ISREG(info.st_mode)) return "it is not an ordinary file";
  std::FILE* const f = std::fopen(path.c_str(), "re");
  if (f == nullptr) return std::strerror(errno);
  std::fclose(f);
  return "";
}

void require_regular_file(const std::string& path) {
  if (const std::string wrong = why_unreadable(path); !wrong.empty())
    throw InputError(ExitCode::io,
                     fmt::format("{}: cannot be read: {} (expected a recording). Check the "
                                 "path and its permissions",
                                 path, wrong));
}

/// Writes a MATLAB file once more and compares the bytes.
std::string other_when_written_again(const Recording& recording, const Facts& facts,
                                     const std::string& first) {
  const AtomicFile second(first + ".again");
  const std::string wrong =
      write_isolated([&] { return write_mat(recording, facts, second.temporary()); });
  if (!wrong.empty()) return wrong;
  return sha256_hex_of_file(first) == sha256_hex_of_file(second.temporary())
             ? ""
             : "what reaches the file is not always the same";
}

/// Facts as every format can hold them, so that what is written reads back alike everywhere.
Facts plain_facts(const Recording& recording, const std::string& path) {
  RawRecording raw;
  for (const auto& [key, value] : recording.facts) {
    std::string plain = key;
    std::ranges::replace(plain, '=', '_');
    if (!add_fact(raw, plain.empty() ? "fact" : plain, value))
      throw_cannot_write(path,
                         "the fact " + in_quotes(key) + " is too long, or there are too many");
  }
  return std::move(raw.facts);
}

/// The facts of a recording that is there; of a text file those above its rows.
Facts facts_of(const std::string& path) {
  Problems ignored(path);
  RawRecording raw;
  const std::string extension = extension_of(path);
  if (extension == ".csv") {
    LineReader lines(path);
    for (std::string_view line; lines.next(line) && line.starts_with("# ");)
      if (const std::size_t at = line.find(" = "); at != std::string_view::npos)
        add_fact(raw, line.substr(2, at - 2), line.substr(at + 3));
  }
  if (extension == ".h5" || extension == ".hdf5") raw = read_isolated(path, ignored, read_hdf5);
  if (extension == ".mat") raw = read_isolated(path, ignored, read_mat);
  return std::move(raw.facts);
}

/// Completes a recording of ours by the digest that tells whether it was changed later.
void seal(const std::string& file, const std::string& path, const std::string& extension) {
  // What follows the end of an HDF5 file is left alone by all readers; the others have a place.
  if (extension == ".h5" || extension == ".hdf5")
    append_seal(file, path);
  else
    close_seal(file, path);
}

}  // namespace

Recording read_recording(const std::string& path, const RecordingFormat& format, RecordingKind kind,
                         double gravity, const ReadProgress& progress) {
  require_regular_file(path);
  Problems problems(path);
  RawRecording raw;
  if (is_text_file(path)) {
    raw = read_csv(path, format, kind, problems, progress);
  } else if (is_binary_file(path)) {
    raw = with_format(read_binary(path, problems), format, kind, problems);
  } else {
    throw_extension(path, extension_of(path));
  }
  Recording recording = checked_recording(std::move(raw), kind, gravity, problems);
  problems.throw_if_any();
  take_instants(recording, format);
  return recording;
}

Recording read_recording(const std::string& path, RecordingKind kind, double gravity) {
  return read_recording(path, RecordingFormat{}, kind, gravity);
}

void write_recording_to(const Recording& recording, const std::string& path,
                        const std::string& temporary) {
  for (const auto& c : recording.channels) {
    DRIFT_DEMAND(c.values.size() == recording.rows());
    DRIFT_EXPECTS(valid_channel_name(c.name));
  }
  const std::string extension = extension_of(path);
  if (extension != ".csv" && extension != ".h5" && extension != ".hdf5" && extension != ".mat")
    throw_extension(path, extension);
  const Facts facts = plain_facts(recording, path);
  const bool mat = extension == ".mat";
  const auto writer = mat ? write_mat : write_hdf5;
  std::string wrong = extension == ".csv"
                          ? write_csv(recording, facts, temporary)
                          : write_isolated([&] { return writer(recording, facts, temporary); });
  if (wrong.empty() && extension != ".csv") {
    // Both libraries write late and do not always say what became of it.
    Problems problems(path);
    const RawRecording back = read_isolated(temporary, problems, mat ? read_mat : read_hdf5);
    wrong = lost_in_writing(recording, facts, back, problems);
  }
  // matio overlooks failures that its reader overlooks too, but not the same one twice.
  if (wrong.empty() && mat) wrong = other_when_written_again(recording, facts, temporary);
  if (!wrong.empty()) throw_cannot_write(path, wrong);
  if (!facts.empty() && facts.front().first == made_here) seal(temporary, path, extension);
}

void write_recording(const Recording& recording, const std::string& path) {
  AtomicFile file(path);
  write_recording_to(recording, path, file.temporary());
  file.commit();
}

std::string not_made_here(const std::string& path, const std::string& converted_from) {
  const Facts facts = facts_of(path);
  const auto fact = [&](std::string_view key) {
    const auto at = std::ranges::find(facts, key, &Facts::value_type::first);
    return at == facts.end() ? std::string() : at->second;
  };
  if (facts.empty() || facts.front().first != made_here) return "no recording that driftscope made";
  const std::string from = fact("converted_from");
  if (from != single_line(converted_from))
    return from.empty() ? "no recording that was converted"
                        : "a recording that was converted from " + from;
  if (from.empty() && fact("run").empty()) return "no recording that `simulate` made";
  return seal_holds(path) ? "" : seal_broken;
}

}  // namespace drift
