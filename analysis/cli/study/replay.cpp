#include "mc/engine/replay.hpp"

#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "analysis/cli/answer.hpp"
#include "analysis/cli/argument_checks.hpp"
#include "analysis/cli/command.hpp"
#include "analysis/cli/frozen_study.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/study_program.hpp"
#include "core/base/atomic_file.hpp"
#include "core/base/file_text.hpp"
#include "core/base/output_file.hpp"
#include "mc/export/export_text.hpp"
#include "mc/store/same_study.hpp"

namespace drift::cli {
namespace {

/// Which run of which study point.
struct RunChoice {
  std::uint64_t run = 0;
  std::size_t point = 0;
};

std::string first_line(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  std::getline(file, line);
  return line;
}

/// The course of a run as CSV in the units of its columns.
class CsvTrace : public mc::TraceSink {
 public:
  explicit CsvTrace(const std::string& path)
      : path_(path), target_(path), file_(std::fopen(target_.temporary().c_str(), "wb")) {
    if (file_ == nullptr) throw_cannot_write(path_, std::strerror(errno));
  }
  ~CsvTrace() override {
    if (file_ != nullptr) std::fclose(file_);
  }
  CsvTrace(const CsvTrace&) = delete;
  CsvTrace& operator=(const CsvTrace&) = delete;

  void columns(const std::vector<mc::Column>& columns) override {
    columns_ = columns;
    std::string line;
    for (const mc::Column& c : columns)
      line += fmt::format("{}{} [{}]", line.empty() ? "" : ",", c.name, c.unit.symbol.view());
    require_output_file(path_, {}, [&](const std::string& path) -> std::string {
      return first_line(path) != line ? "no trace of such a run" : "";
    });
    put(line + "\n");
  }
  void row(std::span<const double> values) override {
    std::string line;
    for (std::size_t i = 0; i < values.size(); ++i)
      line += fmt::format("{}{}", i == 0 ? "" : ",", mc::in_column_unit(values[i], columns_.at(i)));
    put(line + "\n");
    ++rows_;
  }
  std::size_t rows() const { return rows_; }
  bool begun() const { return !columns_.empty(); }
  void commit() {
    if (std::fclose(std::exchange(file_, nullptr)) != 0)
      throw_cannot_write(path_, std::strerror(errno));
    // A replay repeats itself bit for bit: what differs is of another run, or was edited. No digest
    // stands in the file, whose rows every reader takes as they are.
    require_output_file(path_, {}, [&](const std::string& path) -> std::string {
      return file_text(path) == file_text(target_.temporary())
                 ? ""
                 : "the trace of another run, or changed since driftscope made it";
    });
    target_.commit();
  }

 private:
  void put(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), file_) != text.size())
      throw_cannot_write(path_, std::strerror(errno));
  }

  std::string path_;
  AtomicFile target_;
  std::FILE* file_;
  std::vector<mc::Column> columns_;
  std::size_t rows_ = 0;
};

bool as_stored(const mc::Replay& r, std::size_t i) {
  return !r.stored || r.same ||
         std::bit_cast<std::uint64_t>(r.row[i]) == std::bit_cast<std::uint64_t>(r.stored_row[i]);
}

/// The numbers of a run: all, or the first that are not as stored.
std::string numbers_text(const std::vector<mc::Column>& columns, const mc::Replay& r,
                         Terminal::Shown all) {
  constexpr std::size_t most = 6;
  std::size_t width = 0, others = 0;
  for (const mc::Column& c : columns) width = std::max(width, c.name.size());
  std::string out;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    others += !as_stored(r, i);
    if (all == Terminal::Shown::no && (as_stored(r, i) || others > most)) continue;
    out += fmt::format("{:<{}}  {:>24} {}", columns[i].name, width,
                       fmt::format("{}", mc::in_column_unit(r.row[i], columns[i])),
                       columns[i].unit.symbol.view());
    if (!as_stored(r, i))
      out += fmt::format("   stored: {}", mc::in_column_unit(r.stored_row[i], columns[i]));
    out += "\n";
  }
  if (all == Terminal::Shown::no && others > most)
    out += fmt::format("... {} numbers of {} are not as stored\n", others, columns.size());
  return out;
}

/// The result in one sentence, its judgement first.
report::InBrief in_brief(const RunChoice& choice, const mc::Replay& r) {
  report::InBrief brief;
  const std::string_view compared = r.damaged ? "what is stored of it is damaged; executed anew, "
                                                "nothing to compare with"
                                    : !r.stored
                                        ? "the run is not stored yet; executed anew, nothing "
                                          "to compare with"
                                    : r.same ? "equal to the stored result, bit for bit"
                                             : "other than the stored result";
  brief.tone = !r.stored ? report::Tone::doubtful : r.same ? report::Tone::good : report::Tone::bad;
  brief.verdict =
      fmt::format("Run {}: {}. It ended {}", choice.run, compared, mc::name(r.outcome.status));
  if (r.outcome.status != mc::RunStatus::ok)
    brief.verdict += fmt::format(" at t = {:.6g} s: {}", r.outcome.t_failed, r.outcome.cause);
  brief.more.add(Weight::note,
                 fmt::format("CPU time {:.3g} s, of it integration {:.3g} s, filters {:.3g} s.",
                             r.outcome.total_s, r.outcome.integration_s, r.outcome.filter_s));
  return brief;
}

ExitCode replay(const std::string& folder, const RunChoice& choice, const std::string& trace,
                const StudyProgram& program) {
  mc::StudyReader reader(folder);
  const auto [study, work] = frozen_study(folder, reader, program);
  if (choice.point >= work.points.size())
    throw InputError(ExitCode::usage,
                     fmt::format("--point {}: the study has points 0 to {}. Choose one of them",
                                 choice.point, work.points.size() - 1));
  if (reader.runs() > 0 && choice.run >= reader.runs())
    throw InputError(
        ExitCode::usage,
        fmt::format(
            "--run {}: the study has runs 0 to {} (expected one of them). Choose one, or extend "
            "the study with --runs",
            choice.run, reader.runs() - 1));
  const mc::RunTask& task = *work.points[choice.point].task;
  std::optional<CsvTrace> sink;
  if (!trace.empty()) sink.emplace(trace);
  const mc::Replay r = mc::replay(task, reader, choice.point, choice.run, sink ? &*sink : nullptr);
  if (sink && sink->begun()) sink->commit();
  show_answer(in_brief(choice, r), {numbers_text(task.columns(), r, Terminal::Shown::yes), "", {}});
  if (terminal().details == Terminal::Shown::no)
    show("{}", numbers_text(task.columns(), r, Terminal::Shown::no));
  if (sink && sink->begun()) {
    show("trace: {} samples in {}{}\n", sink->rows(), trace,
         study.monte_carlo.estimator == mc::EstimatorKind::ekf
             ? ""
             : fmt::format(", of the EKF from the same starts, sample by sample: the results of "
                           "this study are of estimator \"{}\", which looks at all samples "
                           "together, and its last row is not theirs",
                           key_of(study.monte_carlo.estimator)));
  } else if (sink) {
    say("note: runs of this study have no trace; {} is not written\n", trace);
  }
  if (r.damaged)
    throw InputError(
        ExitCode::store,
        fmt::format("{}: the stored block of run {} is damaged (expected a whole one). "
                    "Run the study again with the same command: it is computed anew",
                    folder, choice.run));
  if (r.stored && !r.same) mc::require_same_arithmetic(folder, reader.manifest());
  if (r.stored && !r.same)
    throw InputError(
        ExitCode::self_check,
        fmt::format("{}: run {} came out other than stored ({}; expected equal bits). Was another "
                    "program or processor at work?",
                    folder, choice.run, mc::name(r.stored_status)));
  return ExitCode::ok;
}

}  // namespace

Command replay_command() {
  struct Arguments {
    std::string folder, trace;
    RunChoice choice;
  };
  const auto add = [](CLI::App& app, Arguments& a) {
    add_folder(app, a.folder);
    app.add_option("--run", a.choice.run, "run number")->required()->check(whole(0, last_run));
    app.add_option("--point", a.choice.point, "study point of a sweep, from 0")
        ->check(whole(0, last_run));
    app.add_option("--trace", a.trace, "write the course of the EKF along the run as CSV")
        ->check(check_path);
    add_full(app);
  };
  return {"replay", group::studies, "execute one run again, bit for bit",
          "driftscope replay results/study --run 17 --trace run17.csv",
          with_arguments<Arguments>(add, [](const Arguments& a) {
            return replay(a.folder, a.choice, a.trace, study_program());
          })};
}

}  // namespace drift::cli
