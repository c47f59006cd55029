#include <algorithm>

#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/still_to_check.hpp"
#include "core/base/output_file.hpp"
#include "core/base/utf8.hpp"
#include "core/recording/canonical_units.hpp"
#include "core/recording/recording_output.hpp"
#include "core/recording/rows/quality_card.hpp"

namespace drift::cli {
namespace {

/// Where the recording was made, for the study that is made for it next (`new`). A latitude that
/// nobody has checked is none; the gravity that it was divided by is.
void add_site(const mc::Study& study, Recording& recording) {
  const bool open = std::ranges::any_of(still_to_check(study), [](const StillToCheck& one) {
    return one.value.starts_with("latitude");
  });
  for (const std::string key : {"latitude", "gravity"}) {
    std::erase_if(recording.facts, [&](const auto& fact) { return fact.first == key; });
    const auto given = std::ranges::find(study.resolved, "site." + key, &mc::Resolved::key);
    if (given != study.resolved.end() && !given->origin.starts_with("default") &&
        !(open && key == "latitude" && given->value == guessed_latitude))
      recording.facts.emplace_back(key, given->value);
  }
}

/// Writes the recording with the program's own columns and units.
ExitCode convert(const StudyArguments& arguments, const std::string& recording,
                 const std::string& output) {
  const mc::Study study = arguments.read();
  say("{}", still_to_check_text(study));
  require_output_file(output, {study.path, recording}, [&](const std::string& path) {
    return not_made_here(path, utf8_text(recording));
  });
  Recording r = in_canonical_units(
      read_recording(recording, study.recording, study.kind, study.site.gravity));
  auto& facts = r.facts;
  std::erase_if(facts, [](const auto& fact) { return fact.first == made_here; });
  facts.insert(facts.begin(), {{std::string(made_here), "converted"},
                               {"converted_from", utf8_text(recording)},
                               {"converted_with", utf8_text(study.path)}});
  add_site(study, r);
  write_recording(r, output);
  r.source = output;
  show("{}", to_text(quality_card(r, study.kind)));
  return ExitCode::ok;
}

}  // namespace

Command convert_command() {
  struct Arguments {
    StudyArguments study;
    std::string recording, output;
  };
  const auto add = [](CLI::App& app, Arguments& a) {
    add_study(app, a.study);
    app.add_option("recording", a.recording, "recording (.csv, .txt, .h5, .mat)")->required();
    add_output(app, a.output, "recording to write (.csv, .h5 or .mat)")->required();
  };
  return {"convert", group::recordings,
          "a recording of your own with the program's columns and units",
          "driftscope convert lab.toml log.txt -o recording.csv",
          with_arguments<Arguments>(
              add, [](const Arguments& a) { return convert(a.study, a.recording, a.output); })};
}

}  // namespace drift::cli
