#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/shell/study_template.hpp"
#include "analysis/report/page/table.hpp"
#include "core/base/atomic_file.hpp"
#include "core/base/named.hpp"
#include "core/base/output_file.hpp"
#include "core/config/load.hpp"
#include "core/recording/own/csv_cells.hpp"
#include "core/recording/own/guess.hpp"

namespace drift::cli {
namespace {

constexpr Named<StudyKind> study_kinds[] = {{"platform", StudyKind::platform},
                                            {"strapdown", StudyKind::strapdown},
                                            {"study", StudyKind::study},
                                            {"sweep", StudyKind::sweep},
                                            {"diagnose", StudyKind::diagnose}};

struct NewArguments {
  std::string kind, recording, output;
};

/// The recording as it will be read, and the [recording] section that says how.
struct LookedAt {
  std::optional<Recording> recording;  ///< empty: not before the blanks are filled in
  std::string mapping;
  std::string blanks;  ///< what the user has to say, in words; empty: nothing
};

/// What names and values of the columns do not tell.
std::string blanks_of(const GuessedFile& file) {
  std::string text;
  if (!file.counter.empty() ||
      std::ranges::find(file.columns, "?", &GuessedColumn::unit) != file.columns.end())
    text = "The units that show as [?] cannot be told: write them.";
  const std::string missing = what_is_missing(file);
  return text.empty() || missing.empty() ? text + missing : text + " " + missing;
}

LookedAt look_at(const std::string& path, RecordingKind kind) {
  constexpr double gravity = 9.80665;  // [m/s^2]
  const std::string end = lower_case(std::filesystem::path(path).extension().string());
  const bool names_its_channels = end == ".h5" || end == ".hdf5" || end == ".mat";
  if (names_its_channels) return {read_recording(path, kind, gravity), "", ""};
  if (!std::filesystem::is_regular_file(path)) read_recording(path, kind, gravity);  // says why not
  const GuessedFile file = guess_file(path);
  const std::string blanks = blanks_of(file);
  if (file.complete || file.rows == 0) try {
      return {read_recording(path, file.format, kind, gravity),
              file.format.columns.empty() ? "" : recording_section(file), ""};
    } catch (const InputError& e) {
      if (blanks.empty() || file.rows == 0 || e.code() != ExitCode::recording) throw;
    }
  std::string mapping = recording_section(file);
  std::istringstream lines(report::wrapped(blanks, 98));
  for (std::string line; std::getline(lines, line);) mapping += "# " + line + "\n";
  return {std::nullopt, mapping, blanks};
}

ExitCode make_study(const NewArguments& a) {
  const StudyKind kind = *value_in(study_kinds, a.kind);
  const bool on_case = kind == StudyKind::strapdown;
  require_output_file(a.output, {a.recording},
                      [](const std::string&) { return "a file that may hold work of yours"; });
  std::optional<RecordedPlan> plan;
  RecordedSite site;
  std::string mapping, blanks;
  if (!a.recording.empty()) {
    const LookedAt seen =
        look_at(a.recording, on_case ? RecordingKind::strapdown : RecordingKind::platform);
    mapping = seen.mapping;
    blanks = seen.blanks;
    if (seen.recording) site = recorded_site(*seen.recording);
    if (!on_case && seen.recording) plan = recorded_plan(*seen.recording);
  }
  const std::string text = study_template(kind, plan, mapping, site);
  if (blanks.empty()) mc::read_study_tree(config::parse_document(text, a.output), a.output);
  AtomicFile file(a.output);
  if (!(std::ofstream(file.temporary(), std::ios::binary) << text << std::flush))
    throw_cannot_write(a.output, "the disk took no more");
  file.commit();
  show("{} is written; what needs your numbers has a comment. Then:\n  driftscope check {}\n",
       a.output, a.output);
  if (!blanks.empty())
    show(
        "\nNot yet: the recording cannot be read before [recording] is complete, and the positions "
        "are those of a preset.\n{}\nThen this fills in the positions:\n"
        "  driftscope convert {} '{}' -o read.csv && driftscope new {} read.csv -o NEW.toml\n",
        report::wrapped(blanks, 98), a.output, a.recording, a.kind);
  return ExitCode::ok;
}

}  // namespace

Command new_command() {
  const auto add = [](CLI::App& app, NewArguments& a) {
    app.add_option("kind", a.kind, "platform, strapdown, study, sweep or diagnose")
        ->required()
        ->check(one_of({"platform", "strapdown", "study", "sweep", "diagnose"}));
    app.add_option("recording", a.recording, "recording to fill it from (.csv, .txt, .h5, .mat)");
    add_output(app, a.output, "study file to write")->required();
  };
  return {"new", group::plans, "a commented study file to begin with",
          "driftscope new diagnose log.txt -o lab.toml",
          with_arguments<NewArguments>(add, make_study)};
}

}  // namespace drift::cli
