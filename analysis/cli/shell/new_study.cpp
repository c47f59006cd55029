#include <algorithm>
#include <filesystem>
#include <sstream>

#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/shell/study_template.hpp"
#include "analysis/preparation/clock_unit.hpp"
#include "analysis/preparation/held_rows.hpp"
#include "analysis/preparation/noise_card.hpp"
#include "analysis/report/noise/noise.hpp"
#include "analysis/report/page/table.hpp"
#include "core/base/named.hpp"
#include "core/base/number_text.hpp"
#include "core/base/output_file.hpp"
#include "core/base/results/folder.hpp"
#include "core/base/words.hpp"
#include "core/config/load.hpp"
#include "core/plan/readout_config.hpp"
#include "core/recording/instants/clock_leap.hpp"
#include "core/recording/own/guess.hpp"
#include "core/recording/own/preamble.hpp"
#include "core/recording/recording_problems.hpp"

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
  std::optional<Recording> recording{};  ///< empty: not before the blanks are filled in
  std::string mapping{};
  std::string blanks{};    ///< what the user has to say, in words; empty: nothing
  std::string unplaced{};  ///< columns that the study leaves aside, in words; empty: none
  std::string told{};      ///< the mapping without its blanks
  std::size_t named = 0;   ///< positions that the mapping names
  PreambleSite above{};    ///< what stands above the header of a text file
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

/// A text as comments of a study file.
std::string as_comment(const std::string& text) {
  std::string comment;
  std::istringstream lines(text.empty() ? "" : report::wrapped(text, 98));
  for (std::string line; std::getline(lines, line);) comment += "# " + line + "\n";
  return comment;
}

/// The section without what is to be filled in.
std::string without_blanks(GuessedFile file) {
  for (GuessedColumn& c : file.columns)
    if (c.unit == "?") c.channel.clear();
  file.counter.clear();
  return recording_section(file);
}

/// A log of a platform is none of sensors on a case, nor the other way about.
void require_kind(const GuessedFile& file, RecordingKind kind, const std::string& path) {
  const std::string other = other_kind(file, kind);
  if (other.empty()) return;
  const bool on_case = kind == RecordingKind::strapdown;
  throw InputError(
      ExitCode::recording,
      fmt::format("{}: it looks like a recording of {}: {} (expected one of {}). Make the study "
                  "with `driftscope new {}`, or rename the columns if they are something else",
                  path, on_case ? "a gimballed platform" : "sensors on a case", other,
                  on_case ? "sensors on a case" : "a gimballed platform",
                  on_case ? "platform` or `driftscope new diagnose" : "strapdown"));
}

LookedAt look_at(const std::string& path, RecordingKind kind) {
  constexpr double gravity = 9.80665;                                                // [m/s^2]
  if (!std::filesystem::is_regular_file(path)) read_recording(path, kind, gravity);  // says why not
  GuessedFile file = guess_file(path);
  require_kind(file, kind, path);
  if (kind == RecordingKind::platform)  // the plan is made of the recording
    for (GuessedColumn& c : file.columns)
      if (!c.numbered.empty()) c.words = c.numbered;
  take_as(file, kind);
  const std::string blanks = blanks_of(file), unplaced = what_has_no_place(file);
  const std::string said = blanks + (blanks.empty() || unplaced.empty() ? "" : " ") + unplaced;
  LookedAt seen{.told = without_blanks(file),
                .named = static_cast<std::size_t>(std::ranges::count_if(
                    file.format.positions, [](const auto& named) { return named.second > 0; })),
                .above = file.text ? preamble_site(path, file.layout) : PreambleSite()};
  std::string refused;
  if (file.complete || file.rows == 0) try {
      seen.recording = read_recording(path, file.format, kind, gravity);
      if (needs_section(file)) seen.mapping = recording_section(file);
      seen.unplaced = said;
      seen.mapping += as_comment(said);
      return seen;
    } catch (const InputError& e) {
      if (blanks.empty() || file.rows == 0 || e.code() != ExitCode::recording) throw;
      refused = fmt::format(" As it stands, reading it ends with: {}", e.what());
    }
  seen.blanks = said + refused;
  seen.mapping = recording_section(file) + as_comment(said);
  return seen;
}

/// Where it was made: what stands above the header goes before facts, which nobody looked at.
RecordedSite site_of(const LookedAt& seen, const std::string& path) {
  RecordedSite site = seen.recording ? recorded_site(*seen.recording) : RecordedSite();
  const Channel* acc = seen.recording ? seen.recording->find("acc_x") : nullptr;
  site.divides = acc != nullptr && acc->unit.symbol.view().find("/s") != std::string_view::npos;
  const auto take = [&](const std::optional<PreambleValue>& above,
                        std::optional<std::string>& value, std::string& place) {
    if (!above) return;
    value = above->value;
    place = fmt::format("{}:{}", path, above->line);
  };
  take(seen.above.latitude, site.latitude, site.latitude_place);
  take(seen.above.gravity, site.gravity, site.gravity_place);
  return site;
}

/// Of positions that are half way between two directions for a case that faces North.
std::string turned_text(const RecordedPlan& plan) {
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < plan.positions.size(); ++i)
    if (!plan.positions[i].turned.axes.empty()) numbers.push_back(fmt::format("{}", i + 1));
  if (numbers.empty()) return "";
  return fmt::format(
      "Position{} {} {} half way between two directions if the case {}; if its heading was "
      "{:.0f} deg there, write what the comments of the file say. No accelerometer and no gimbal "
      "shows "
      "which; `driftscope identify` says it if the Earth's rotation does not fit.",
      numbers.size() == 1 ? "" : "s", listed(numbers, "and"), numbers.size() == 1 ? "is" : "are",
      plan.faces == 0.0 ? "faced North"
                        : fmt::format("stood at {:.0f} deg", plan.faces / detail::deg),
      45.0 + plan.faces / detail::deg);
}

/// Of positions that are longer than a day, by times that nobody gave a unit or a wrong one.
std::string long_dwells_text(const RecordedPlan& plan) {
  constexpr double day = 86400.0;  // [s]
  const auto longest =
      std::ranges::max_element(plan.positions, {}, &RecordedPlan::Position::length);
  if (longest == plan.positions.end() || longest->length <= day) return "";
  return fmt::format(
      "By the times of the log a position lasts up to {:.3g} days: is their unit right? If not, "
      "give the column its unit in the header or in [recording] columns, and make the study again.",
      longest->length / day);
}

/// The line of [readout] that the rests of a recording give; empty where they show no noise.
std::string noise_line(const Recording& r, const std::vector<preparation::RestingRows>& rests) {
  const preparation::NoiseCard card = preparation::noise_card(r, RecordingKind::platform, rests);
  const std::string keys = report::noise_keys(card);
  const auto begin = keys.find("accelerometer_noise"), end = keys.find('\n', begin);
  if (begin == std::string::npos || end == std::string::npos) return "";
  std::size_t isolated = 0;
  for (const preparation::ChannelNoise& c : card.channels) isolated += c.isolated;
  const std::string without = isolated == 0
                                  ? ""
                                  : fmt::format(" without {} isolated sample{} far from the rest",
                                                isolated, isolated == 1 ? "" : "s");
  return keys.substr(begin, end - begin) + ", as the rests of the recording show" + without + "\n";
}

/// A line of [readout] by the scatter of the rests, of two digits; empty where they show none.
std::string scatter_line(const Recording& r, const std::vector<preparation::RestingRows>& rests,
                         std::string_view key, const ChannelTriple& channels, const Unit& unit) {
  const double sigma = preparation::scatter_at_rest(r, rests, channels), least = least_noise(key);
  if (!(sigma > 0.0)) return "";
  const std::string value = fmt::format(
      "\"{} {}\"", number_text(std::max(sigma, least) / unit.to_si, 2), unit.symbol.view());
  return fmt::format("{:<19} = {:<12} # 1 sigma of a sample, {}\n", key, value,
                     sigma < least
                         ? "the least that may stand here: it scatters by less in the rests"
                         : "as it scatters in the rests");
}

/// Reads the study as `check` will. What is wrong with one that was made of a recording is said of
/// that: the study is not written. long_dwells: long_dwells_text(), or nothing.
void require_readable(const std::string& study, const NewArguments& a,
                      const std::string& long_dwells) {
  try {
    mc::read_study_tree(config::parse_document(study, a.output), a.output);
  } catch (const InputError& e) {
    if (a.recording.empty()) throw;
    std::vector<std::string> wrong;
    for (const std::string& message : e.messages()) {  // "lab.toml:26:23: what is wrong"
      const bool placed = message.starts_with(a.output + ":");
      const auto at = placed ? message.find(": ", a.output.size()) : std::string::npos;
      wrong.push_back(at == std::string::npos ? message : message.substr(at + 2));
    }
    if (!long_dwells.empty())
      throw InputError(ExitCode::recording,
                       fmt::format("{}: the study that is made of it cannot be read, and is not "
                                   "written: {}. {}",
                                   a.recording, fmt::join(wrong, ". "), long_dwells));
    throw InputError(
        ExitCode::recording,
        fmt::format("{}: the study that is made of it cannot be read, and is not written: {} "
                    "(expected a recording that stands in each of its positions). Check with "
                    "`driftscope look '{}'` what its columns are taken for: rename those that are "
                    "something else, and correct numbers of positions that go on while it turns",
                    a.recording, fmt::join(wrong, ". "), a.recording));
  }
}

ExitCode make_study(const NewArguments& a) {
  const StudyKind kind = *value_in(study_kinds, a.kind);
  const bool on_case = kind == StudyKind::strapdown;
  require_output_file(a.output, {a.recording},
                      [](const std::string&) { return "a file that may hold work of yours"; });
  std::optional<RecordedPlan> plan;
  RecordedSite site;
  LookedAt seen;
  if (!a.recording.empty()) {
    seen = look_at(a.recording, on_case ? RecordingKind::strapdown : RecordingKind::platform);
    site = site_of(seen, a.recording);
    if (!on_case && seen.recording) {
      if (const std::string leap = clock_leaps_text(*seen.recording); !leap.empty())
        throw InputError(ExitCode::recording, fmt::format("{}: {}", a.recording, leap));
      if (std::string wrong = preparation::other_unit_of_time(*seen.recording); !wrong.empty())
        throw InputError(ExitCode::recording, std::move(wrong));
      plan = recorded_plan(*seen.recording);
      const Recording measured = preparation::without_held_rows(*seen.recording);
      const auto rests = preparation::resting_rows(measured);
      plan->noise = noise_line(measured, rests);
      if (plan->noise.empty())
        plan->noise =
            scatter_line(measured, rests, "accelerometer_noise", accelerometer_channels, unit::ug);
      plan->gimbal_noise =
          scatter_line(measured, rests, "gimbal_noise", gimbal_channels, unit::arcsec);
    }
    if (!on_case && !seen.recording && seen.named > 0) plan = plan_to_come(seen.named);
  }
  const std::string& blanks = seen.blanks;
  const std::string text = study_template(kind, plan, seen.mapping, site),
                    told = blanks.empty() ? text : study_template(kind, plan, seen.told, site);
  require_readable(told, a, plan ? long_dwells_text(*plan) : "");
  write_text_atomically(a.output, text);
  show("{} is written; what needs your numbers has a comment. Then:\n  driftscope check {}\n",
       a.output, shell_word(a.output));
  if (!blanks.empty())
    show(
        "\nNot yet: the recording cannot be read before [recording] is complete, and the positions "
        "are {}.\n{}\nThen this fills in the positions:\n"
        "  driftscope convert {} {} -o read.csv && driftscope new {} read.csv -o NEW.toml\n",
        plan ? "all alike, as many as it names" : "those of a preset", report::wrapped(blanks, 98),
        shell_word(a.output), shell_word(a.recording), a.kind);
  if (plan && !plan->contradiction.empty())
    show(
        "\n{}\n\nThen this fills in the positions:\n"
        "  driftscope convert {} {} -o read.csv && driftscope new {} read.csv -o NEW.toml\n",
        report::wrapped(plan->contradiction, 98), shell_word(a.output), shell_word(a.recording),
        a.kind);
  if (plan)
    for (const std::string& said : {long_dwells_text(*plan), turned_text(*plan)})
      if (!said.empty()) show("\n{}\n", report::wrapped(said, 98));
  if (!seen.unplaced.empty()) show("\n{}\n", report::wrapped(seen.unplaced, 98));
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
