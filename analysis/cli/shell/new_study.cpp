#include <filesystem>
#include <fstream>

#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/shell/study_template.hpp"
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
  Recording recording;
  std::string mapping;
};

LookedAt look_at(const std::string& path, RecordingKind kind) {
  constexpr double gravity = 9.80665;  // [m/s^2]
  const std::string end = lower_case(std::filesystem::path(path).extension().string());
  const bool names_its_channels = end == ".h5" || end == ".hdf5" || end == ".mat";
  if (names_its_channels) return {read_recording(path, kind, gravity), ""};
  if (!std::filesystem::is_regular_file(path)) read_recording(path, kind, gravity);  // says why not
  const GuessedFile file = guess_file(path);
  if (!file.complete)
    throw InputError(ExitCode::recording,
                     fmt::format("{}: units or channels cannot be told from names and values "
                                 "(expected columns that can). See `driftscope look '{}'`, and "
                                 "give the study without the recording",
                                 path, path));
  return {read_recording(path, file.format, kind, gravity),
          file.format.columns.empty() ? "" : recording_section(file)};
}

ExitCode make_study(const NewArguments& a) {
  const StudyKind kind = *value_in(study_kinds, a.kind);
  const bool on_case = kind == StudyKind::strapdown;
  require_output_file(a.output, {a.recording},
                      [](const std::string&) { return "a file that may hold work of yours"; });
  std::optional<RecordedPlan> plan;
  std::string mapping;
  if (!a.recording.empty()) {
    const LookedAt seen =
        look_at(a.recording, on_case ? RecordingKind::strapdown : RecordingKind::platform);
    mapping = seen.mapping;
    if (!on_case) plan = recorded_plan(seen.recording);
  }
  const std::string text = study_template(kind, plan, mapping);
  mc::read_study_tree(config::parse_document(text, a.output), a.output);
  AtomicFile file(a.output);
  if (!(std::ofstream(file.temporary(), std::ios::binary) << text << std::flush))
    throw_cannot_write(a.output, "the disk took no more");
  file.commit();
  show("{} is written; what needs your numbers has a comment. Then:\n  driftscope check {}\n",
       a.output, a.output);
  return ExitCode::ok;
}

}  // namespace

Command new_command() {
  const auto add = [](CLI::App& app, NewArguments& a) {
    app.add_option("kind", a.kind, "platform, strapdown, study, sweep or diagnose")
        ->required()
        ->check(CLI::IsMember({"platform", "strapdown", "study", "sweep", "diagnose"}));
    app.add_option("recording", a.recording, "recording to fill it from (.csv, .txt, .h5, .mat)");
    add_output(app, a.output, "study file to write")->required();
  };
  return {"new", group::plans, "a commented study file to begin with",
          "driftscope new diagnose log.txt -o lab.toml",
          with_arguments<NewArguments>(add, make_study)};
}

}  // namespace drift::cli
