#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/identification/delay_doubt.hpp"
#include "analysis/preparation/clock_unit.hpp"
#include "analysis/preparation/held_rows.hpp"
#include "analysis/preparation/input_thresholds.hpp"
#include "analysis/preparation/rows/raw_spikes.hpp"
#include "analysis/report/noise/noise.hpp"
#include "analysis/report/page/table.hpp"
#include "analysis/strapdown/case_study.hpp"
#include "analysis/strapdown/checks/saturated.hpp"
#include "core/base/number_text.hpp"
#include "core/base/words.hpp"
#include "core/estimate/strapdown/dwells.hpp"
#include "core/plan/shifted_numbers.hpp"
#include "core/recording/own/guess.hpp"
#include "core/recording/recording_files.hpp"
#include "core/recording/rows/quality_card.hpp"
#include "core/recording/rows/row_spacing.hpp"
#include "core/stats/median.hpp"

namespace drift::cli {
namespace {

/// What the columns hold and what they may be.
void show_columns(const GuessedFile& file) {
  const std::size_t header = file.layout.header_line, units = file.layout.unit_line;
  show("{} rows of {} columns", file.rows, file.columns.size());
  if (!file.text)
    show("\n");
  else
    show("; {}{}, cells are divided by {}\n",
         header > 0 ? fmt::format("the header is line {}", header) : "there is no header row",
         units > 0 ? fmt::format(", units are line {}", units) : "",
         file.layout.delimiter == '\t'  ? "tabs"
         : file.layout.delimiter == ' ' ? "blanks"
                                        : fmt::format("'{}'", file.layout.delimiter));
  show("{:<22}{:>9}{:>7}{:>13}{:>13}  {}\n", "column", "numbers", "texts", "min", "max", "may be");
  for (const GuessedColumn& c : file.columns) {
    const std::string unit = c.unit.empty() ? "" : fmt::format(" [{}]", c.unit);
    show("{:<22}{:>9}{:>7}{:>13}{:>13}  {}\n", c.header.name, c.numbers, c.texts,
         c.numbers > 0 ? fmt::format("{:.6g}", c.low) : "-",
         c.numbers > 0 ? fmt::format("{:.6g}", c.high) : "-",
         !file.format.date.empty() && c.header.name == file.format.date ? "date of the time"
         : c.channel.empty()                                            ? "-"
                             : c.channel + unit + (c.by_values ? " (by its values)" : ""));
  }
}

/// The usual length of the specific force; empty if it was not measured.
std::optional<double> usual_force(const Recording& r) {
  const Channel* acc[3] = {r.find("acc_x"), r.find("acc_y"), r.find("acc_z")};
  if (!acc[0] || !acc[1] || !acc[2]) return std::nullopt;
  std::vector<double> lengths;
  for (std::size_t i = 0; i < r.rows(); ++i)
    if (const double f = std::hypot(acc[0]->values[i], acc[1]->values[i], acc[2]->values[i]);
        std::isfinite(f))
      lengths.push_back(f);
  if (lengths.empty()) return std::nullopt;
  return stats::upper_median(std::move(lengths));
}

void show_positions(const Recording& r) {
  const Channel *position = r.find("position"), *time = r.find("time");
  const RowSpacing spacing = row_spacing(r);
  show("\n{:<10}{:>8}{:>14}{:>14}{:>13}{:>13}\n", "position", "rows", "first [s]", "last [s]",
       "length [s]", "sample [s]");
  for (std::size_t first = 0, end = 0; first < r.rows(); first = end) {
    while (end < r.rows() && position->values[end] == position->values[first]) ++end;
    // A row stands at the end of its interval: the first one began before its time.
    const double before = spacing.usual[first];
    const double length =
        time->values[end - 1] - time->values[first] + (std::isfinite(before) ? before : 0.0);
    const double sample = spacing.usual[end - 1];  // a position ends with its dwell
    show("{:<10}{:>8}{:>14.10g}{:>14.10g}{:>13.6g}{:>13}\n", position->values[first], end - first,
         time->values[first], time->values[end - 1], length,
         std::isfinite(sample) ? fmt::format("{:.6g}", sample) : "-");
  }
}

void show_dwells(const strapdown::DwellSearch& search, double static_min) {
  show("\n{} dwells: quiet for at least {:g} s, {:g} s of which are left out at their ends\n",
       search.dwells.size(), static_min, strapdown::DwellOptions{}.window);
  if (search.dwells.empty()) return;
  show("{:>12}{:>11}{:>10}{:>12}{:>12}{:>12}{:>10}\n", "from [s]", "quiet [s]", "for [s]",
       "acc_x [g]", "acc_y [g]", "acc_z [g]", "|f| [g]");
  constexpr std::size_t most = 30;
  for (std::size_t i = 0; i < std::min(most, search.dwells.size()); ++i) {
    const strapdown::Dwell& d = search.dwells[i];
    show("{:>12.6g}{:>11.4g}{:>10.4g}{:>12.6f}{:>12.6f}{:>12.6f}{:>10.6f}\n", d.start, d.quiet,
         d.duration(), d.acc.x(), d.acc.y(), d.acc.z(), d.acc.norm());
  }
  if (search.dwells.size() > most) show("and {} more\n", search.dwells.size() - most);
}

/// What a sample scatters by, which short rests show, too.
void show_scatter(const Recording& r, const std::vector<preparation::RestingRows>& rests) {
  std::vector<std::string> said;
  for (const auto& [channels, unit] :
       {std::pair{&accelerometer_channels, &unit::ug}, std::pair{&gimbal_channels, &unit::arcsec}})
    if (const double sigma = preparation::scatter_at_rest(r, rests, *channels); sigma > 0.0)
      said.push_back(fmt::format("{} by {} {}", channels->what, number_text(sigma / unit->to_si, 2),
                                 unit->symbol.view()));
  if (!said.empty())
    show("within the positions samples scatter about their slow course (1 sigma): {}\n",
         fmt::join(said, ", "));
}

/// What the accelerometers of a row are taken for: another thing than many a log has.
void show_means(const Recording& r) {
  const double interval = identification::usual_interval({r});
  if (r.find("acc_x") == nullptr || !(interval > 0.0)) return;
  const double half = 0.5 * interval;
  show(
      "\n{}\n",
      report::wrapped(
          fmt::format(
              "acc_* are taken as means over the {} s that end at the time of their row. Momentary "
              "readings are {} s later: on a platform that the Earth's rate turns they are up to "
              "{} ug off. If they are that, the study says so: recording.accelerometers = "
              "\"momentary\"",
              number_text(interval, 3), number_text(half, 3),
              number_text(detail::earth_rate * half / 1e-6, 2)),
          98));
}

/// The recording as a whole, of a plan where one is known; the noise that its rests show comes
/// back.
preparation::NoiseCard show_recording(const Recording& r, RecordingKind kind, double static_min,
                                      double gravity, const TestPlan* plan = nullptr) {
  show("\n{}", to_text(quality_card(r, kind)));
  if (const auto f = usual_force(r))
    show("the accelerometers together usually read {:.6f} g (1 at rest){}\n", *f,
         std::abs(*f - 1.0) < 0.02 ? "" : ": check their units, or was the case moving?");
  preparation::NoiseCard card;
  if (kind == RecordingKind::strapdown) {
    Recording measured = r;
    const std::vector<Saturation> saturated = strapdown::leave_out_saturated(measured);
    const auto search =
        strapdown::find_dwells(strapdown::signals_of(measured), {.static_min = static_min});
    for (const Saturation& s : saturated)
      show("! {}\n", strapdown::saturated_turns_text(s, r, search.dwells));
    show_dwells(search, static_min);
    card = strapdown::noise_of(r, search);
  } else {
    show_positions(r);
    show_means(r);
    for (const std::string& wrong : {preparation::other_unit_of_time(r),
                                     plan ? shifted_numbers(r, *plan) : shifted_numbers(r)})
      if (!wrong.empty()) show("\n{}\n", report::wrapped(wrong, 98));
    for (const preparation::RawSpikes& spikes : preparation::raw_spikes(r))
      show("\n{}\n", report::wrapped(preparation::raw_spikes_text(r, spikes), 98));
    const Recording measured = preparation::without_held_rows(r);
    for (const preparation::StuckRows& stuck : preparation::stuck_rows(measured))
      if (stuck.end - stuck.first < preparation::RecordingLimits::stuck)  // longer: by the card
        show(
            "\n{}: {} identical samples from line {} on, which chance does not make: a stuck "
            "sensor?\n",
            stuck.channel, stuck.end - stuck.first, r.lines[stuck.first]);
    const auto rests = preparation::resting_rows(measured);
    card = preparation::noise_card(measured, kind, rests);
    show_scatter(measured, rests);
  }
  show("\n{}", report::text_of({report::noise_section(card, gravity)}));
  return card;
}

/// What goes into the study file.
void show_paste(const std::string& section, const preparation::NoiseCard& card,
                std::string_view how) {
  const std::string noise = report::noise_keys(card);
  if (section.empty() && noise.empty()) return;
  show("\nFor the study file{}:\n\n{}", section.empty() ? "" : how,
       section.empty() || noise.empty() ? section + noise : section + "\n" + noise);
}

void show_commands(const std::string& path, RecordingKind kind) {
  show(
      "\nThen, with a study file lab.toml that has [plan]{} and a [[filter]]:\n"
      "  driftscope identify lab.toml {}\n"
      "  driftscope diagnose lab.toml {} -o out/lab\n",
      kind == RecordingKind::strapdown ? " kind = \"strapdown\"" : "", shell_word(path),
      shell_word(path));
}

ExitCode look_without_study(const std::string& path) {
  constexpr double gravity = 9.80665;  // [m/s^2]
  constexpr double static_min = 2.0;   // [s]
  if (!std::filesystem::is_regular_file(path) || !(is_text_file(path) || is_binary_file(path)))
    read_recording(path, {}, gravity);  // says why not
  const GuessedFile file = guess_file(path);
  show("{}: ", path);
  show_columns(file);
  bool read = false;
  std::vector<std::string> wrong;
  preparation::NoiseCard card;
  try {
    const Recording r = read_recording(path, file.format, file.kind, gravity);
    read = true;
    card = show_recording(r, file.kind, static_min, gravity);
  } catch (const InputError& e) {
    if (read || file.rows == 0 || e.code() != ExitCode::recording) throw;
    wrong = e.messages();
  }
  if (!read) show("\nIt is not a recording yet:\n- {}\n", fmt::join(wrong, "\n- "));
  show_paste(needs_section(file) || !read ? recording_section(file) : "", card,
             file.complete ? " (guessed from names and values: check it)"
                           : " (guessed; write the units that show as [?])");
  if (const std::string missing = what_is_missing(file); !missing.empty())
    show("\n{}\n", report::wrapped(missing, 100));
  if (const std::string unplaced = what_has_no_place(file); !unplaced.empty())
    show("\n{}\n", report::wrapped(unplaced, 100));
  show_commands(path, file.kind);
  return ExitCode::ok;
}

/// By its name and, where a study might have such a one, by columns of numbers that are channels.
bool evident_recording(const std::string& path) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) return false;
  if (is_binary_file(path)) return true;
  if (!is_text_file(path)) return false;
  try {
    return std::ranges::any_of(guess_file(path).columns, [](const GuessedColumn& c) {
      return !c.channel.empty() && c.numbers > c.texts;
    });
  } catch (const InputError&) {
    return false;  // no columns: whoever reads it as a study says what is wrong
  }
}

/// Two recordings, or a study file before the recording.
void require_study_behind(const std::string& recording, const std::string& config) {
  if (!evident_recording(config)) return;
  const bool first_is_one = is_text_file(recording) || is_binary_file(recording);
  throw InputError(
      ExitCode::usage,
      fmt::format("look: {} is a recording (expected one recording and, behind it, a study file "
                  "to read it with). {}",
                  config,
                  first_is_one ? "Look at one recording at a time"
                               : fmt::format("Name it first: driftscope look {} {}",
                                             shell_word(config), shell_word(recording))));
}

/// Says what a file holds, with a study file or with none (config empty).
ExitCode look(const StudyArguments& arguments, const std::string& recording) {
  if (arguments.config.empty()) return look_without_study(recording);
  require_study_behind(recording, arguments.config);
  const mc::Study study = arguments.read();
  const auto card =
      show_recording(read_recording(recording, study.recording, study.kind, study.site.gravity),
                     study.kind, study.static_min, study.site.gravity, &study.plan);
  show_paste("", card, "");
  show_commands(recording, study.kind);
  return ExitCode::ok;
}

}  // namespace

Command look_command() {
  struct Arguments {
    StudyArguments study;
    std::string recording;
  };
  const auto add = [](CLI::App& app, Arguments& a) {
    app.add_option("recording", a.recording, "recording (.csv, .txt, .h5, .mat)")->required();
    app.add_option("config", a.study.config, "study file (TOML) to read it with");
  };
  return {"look", group::recordings, "what a file holds, and how to read it as a recording",
          "driftscope look log.txt", with_arguments<Arguments>(add, [](const Arguments& a) {
            return look(a.study, a.recording);
          })};
}

}  // namespace drift::cli
