#include "analysis/cli/read_recordings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "analysis/cli/print.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/cli/still_to_check.hpp"
#include "analysis/preparation/own_names.hpp"
#include "analysis/report/page/wording.hpp"
#include "core/base/check.hpp"
#include "core/base/units.hpp"
#include "core/plan/plan_rows.hpp"
#include "core/recording/own/csv_cells.hpp"
#include "core/recording/own/preamble.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/recording_output.hpp"
#include "core/recording/rows/quality_card.hpp"
#include "core/recording/rows/row_remarks.hpp"
#include "core/recording/rows/shared_noise.hpp"
#include "core/recording/rows/shared_rows.hpp"

namespace drift::cli {
namespace {

/// Says where dwells are a thousand or a million times as long as the plan's, or as short, or sixty
/// times with as many rows: a wrong unit of time. What differs less may be another test, and is
/// looked at by those who use it.
void check_time_unit(const mc::Study& study, const Recording& recording) {
  const Channel *position = recording.find("position"), *time = recording.find("time");
  if (study.kind != RecordingKind::platform || !position || recording.rows() < 3) return;
  const auto number = static_cast<std::size_t>(position->values.front());
  if (number > study.plan.positions.size()) return;  // said by those who lay it out
  std::size_t end = 1;
  while (end < recording.rows() && position->values[end] == position->values.front()) ++end;
  const Position& planned = study.plan.positions[number - 1];
  const double usual = planned.dwell - planned.sample;
  const double length = time->values[end - 1] - time->values.front();
  if (end < 3 || !(usual > 0.0)) return;
  const bool as_many_rows =
      std::abs(static_cast<double>(end - 1) * planned.sample / usual - 1.0) < 0.05;
  std::vector<double> factors{1e3, 1e6, 1e-3, 1e-6};
  if (as_many_rows) factors.insert(factors.end(), {60.0, 3600.0, 1.0 / 60.0, 1.0 / 3600.0});
  for (const double factor : factors)
    if (std::abs(length / (factor * usual) - 1.0) < 0.05)
      throw InputError(
          ExitCode::recording,
          fmt::format("{}:time: the first position lasts {:.4g} s, {:.4g} times as long as in the "
                      "plan (expected about {:.4g} s). Correct the unit of time, in the file or in "
                      "[recording] columns of the study file",
                      recording.source, length, factor, usual));
}

/// Where it was used without being given.
void tell_assumed_gravity(const mc::Study& study, const Recording& recording) {
  const auto gravity = assumed_gravity(study);
  for (const std::string_view name : accelerometer_channels.names)
    if (const Channel* c = recording.find(name);
        gravity && c && c->unit.symbol.view().find("m/s") != std::string_view::npos) {
      say("note: {}: accelerometers in {} are divided by site.gravity, which is not given: {} is "
          "assumed, and K1, in ppm, is off by as many ppm as gravity is there\n",
          recording.source, c->unit.symbol.view(), *gravity);
      return;
    }
}

/// What a recording says of itself under a key; empty if nothing.
std::string fact_of(const Recording& recording, std::string_view key) {
  const auto at = std::ranges::find(recording.facts, key, [](const auto& f) { return f.first; });
  return at == recording.facts.end() ? "" : at->second;
}

/// Where the file itself says that it is of another latitude than the study.
void tell_other_latitude(const mc::Study& study, const Recording& recording,
                         const std::string& path) {
  if (study.kind != RecordingKind::platform) return;
  std::string said = fact_of(recording, "latitude"), place = recording.source;
  const std::string end = lower_case(std::filesystem::path(path).extension().string());
  if (end != ".h5" && end != ".hdf5" && end != ".mat")
    if (const auto above =
            preamble_site(path, find_layout(path, study.recording, study.kind)).latitude) {
      said = above->value;
      place += fmt::format(":{}", above->line);
    }
  const auto blank = said.find(' ');
  if (blank == std::string::npos || said.substr(blank) != " deg") return;
  const std::string number = said.substr(0, blank);
  const double degrees = parse_cell(number, DecimalMark::automatic).value;
  const auto point = number.find('.');
  const auto decimals =
      point == std::string::npos ? 0.0 : static_cast<double>(number.size() - point - 1);
  // What was rounded differs by half a unit of its last digit; a minute of arc is no survey's.
  const double room = std::max(0.5 * std::pow(10.0, -decimals), 1.0 / 60.0);
  const double of_study = study.site.latitude / unit::deg.to_si;
  if (!(std::abs(degrees - of_study) > room)) return;
  say("note: {}: says latitude {}, the study {:.6g} deg: which one is it?\n", place, said,
      of_study);
}

/// Where what was converted was divided by another gravity than the study's. Of any other file the
/// gravity that it names is a remark: it is divided by the study's as it is read.
void tell_other_gravity(const mc::Study& study, const Recording& recording) {
  constexpr double ppm = 1e-6;
  if (fact_of(recording, made_here) != "converted") return;
  const std::string said = fact_of(recording, "gravity");
  const auto blank = said.find(' ');
  if (blank == std::string::npos || said.substr(blank) != " m/s^2") return;
  const double of_file = parse_cell(said.substr(0, blank), DecimalMark::automatic).value,
               off = study.site.gravity / of_file - 1.0;
  if (!(std::abs(off) > ppm)) return;
  say("note: {}: its accelerometers were divided by a gravity of {}, the study says {:.6g} m/s^2: "
      "K1 is off by {:.0f} ppm. Convert the log again with the right one\n",
      recording.source, said, study.site.gravity, off / ppm);
}

/// What a recording looks like, also beside the plan.
QualityCard card_of(const mc::Study& study, const Recording& recording) {
  QualityCard card = quality_card(recording, study.kind);
  if (study.kind == RecordingKind::platform)
    if (std::string text = rows_longer_than_others(recording, study.plan); !text.empty())
      card.remarks.add(Weight::doubtful, std::move(text));
  return card;
}

/// What looks odd is told at once, what weighs most of it.
void tell_remarks(const QualityCard& card, const mc::Study& study,
                  const std::vector<std::string>& paths) {
  constexpr std::size_t most = 3;
  std::vector<std::string> remarks = card.remarks.texts();
  for (std::string& text : remarks) text = fmt::format("{}: {}", card.file, text);
  preparation::correct_alone(remarks, study, paths);
  for (std::size_t k = 0; k < std::min(remarks.size(), most); ++k) say("note: {}\n", remarks[k]);
  if (remarks.size() > most)
    say("note: {}: {} more remark{}; --full prints them\n", card.file, remarks.size() - most,
        report::plural(remarks.size() - most));
}

/// The part of a large file that is read, which takes seconds, and the time left.
ReadProgress reading_progress(const std::string& path, const std::string& style) {
  constexpr std::uintmax_t large = 20'000'000;  // [bytes] a second or so
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(path, unknown);
  if (unknown || size < large) return {};
  const auto report = stage_reporter(style, "reading");
  if (!report) return {};
  return [report, name = std::filesystem::path(path).filename().string()](double part) {
    report(name, part);
  };
}

/// One of the files, which the study reads.
Recording read_one(const mc::Study& study, const std::string& path,
                   const std::vector<std::string>& paths, const std::string& progress) {
  try {
    const ReadProgress told = reading_progress(path, progress);
    Recording r = read_recording(path, study.recording, study.kind, study.site.gravity, told);
    if (told) told(1.0);
    check_time_unit(study, r);
    return r;
  } catch (const InputError& error) {
    std::vector<std::string> messages = error.messages();
    preparation::correct_alone(messages, study, paths);
    throw InputError(error.code(), std::move(messages));
  }
}

/// Whether both hold the same readings, whatever their files look like: to a millionth of the
/// largest, which another unit or fewer digits may round off.
bool same_readings(const Recording& a, const Recording& b) {
  constexpr double rounding = 1e-6;
  bool any = false;
  for (const auto* names : {&accelerometer_channels.names, &gyro_channels.names})
    for (const auto name : *names) {
      const Channel *p = a.find(name), *q = b.find(name);
      if (p == nullptr || q == nullptr) continue;
      double largest = 0.0;
      for (const double x : p->values)
        if (std::isfinite(x)) largest = std::max(largest, std::abs(x));
      const bool equal = std::ranges::equal(p->values, q->values, [&](double x, double y) {
        return std::abs(x - y) <= rounding * largest || (std::isnan(x) && std::isnan(y));
      });
      if (!equal) return false;
      any = any || std::ranges::any_of(p->values, [](double x) { return std::isfinite(x); });
    }
  return any;
}

/// What stands in two files would count twice.
void refuse_copies(const Recording& earlier, const std::string& earlier_path,
                   const Recording& later, const std::string& path) {
  if (same_readings(earlier, later))
    throw InputError(
        ExitCode::usage,
        fmt::format("{}: has the same readings as {} (expected recordings of different tests: "
                    "one and the same is no further evidence). Name one of them",
                    path, earlier_path));
  if (const auto shared = shared_rows(earlier, later))
    throw InputError(
        ExitCode::usage,
        fmt::format("{}: {} hold the readings of {}: {} (expected recordings of different tests: "
                    "rows that stand in both are no further evidence). Name one of them, or cut "
                    "these rows out of one",
                    path, rows_in_words(later, shared->second, shared->count), earlier_path,
                    rows_in_words(earlier, shared->first, shared->count)));
  if (const auto shared = shared_noise(earlier, later))
    throw InputError(
        ExitCode::usage,
        fmt::format("{}: its noise is that of {}: of {} readings that scatter at times of both "
                    "{:.0f} % do so to the same side, of two tests some 50 % (expected recordings "
                    "of different tests: other rows of one log, or means of them, are no further "
                    "evidence). Name one of them; simulated ones need a --seed each",
                    path, earlier_path, shared->readings, 100.0 * shared->alike));
}

}  // namespace

std::optional<std::string> assumed_gravity(const mc::Study& study) {
  const auto gravity = std::ranges::find(study.resolved, "site.gravity", &mc::Resolved::key);
  if (gravity == study.resolved.end() || !gravity->origin.starts_with("default")) return {};
  return gravity->value;
}

std::vector<Recording> read_recordings(const mc::Study& study,
                                       const std::vector<std::string>& paths,
                                       const std::string& progress) {
  for (std::size_t k = 0; k < paths.size(); ++k)
    for (std::size_t before = 0; before < k; ++before)
      if (std::error_code unknown; std::filesystem::equivalent(paths[k], paths[before], unknown))
        throw InputError(
            ExitCode::usage,
            fmt::format("{}: given twice (expected recordings of different tests: one and the same "
                        "is no further evidence). Name it once",
                        paths[k]));
  say("{}", still_to_check_text(study));
  std::vector<Recording> recordings;
  for (const std::string& path : paths) {
    recordings.push_back(read_one(study, path, paths, progress));
    tell_assumed_gravity(study, recordings.back());
    tell_other_latitude(study, recordings.back(), path);
    tell_other_gravity(study, recordings.back());
    for (std::size_t before = 0; before + 1 < recordings.size(); ++before)
      refuse_copies(recordings[before], paths[before], recordings.back(), path);
    tell_remarks(card_of(study, recordings.back()), study, paths);
  }
  return recordings;
}

std::string cards_text(const mc::Study& study, const std::vector<Recording>& recordings) {
  std::string out;
  for (const Recording& r : recordings) out += to_text(card_of(study, r)) + "\n";
  return out;
}

}  // namespace drift::cli
