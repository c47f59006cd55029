#include "mc/engine/engine.hpp"

#include <signal.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>

#include "mc/engine/block_board.hpp"
#include "mc/engine/block_queue.hpp"
#include "mc/engine/outcome_of_ranks.hpp"
#include "mc/engine/rule_follower.hpp"
#include "mc/engine/session_stop.hpp"
#include "mc/engine/work_plan.hpp"
#include "mc/store/store.hpp"
#include "mc/store/study_reader.hpp"
#include "mc/task/campaign.hpp"
#include "mc/task/guarded_run.hpp"

namespace drift::mc {
namespace {

using Clock = std::chrono::steady_clock;
using Counter = Ranks::Counter;

/// One session of one worker.
class Engine {
 public:
  Engine(const StudyWork& work, const EngineOptions& options, const std::string& folder,
         const Manifest& manifest, Ranks& ranks, const ProgressSink& sink)
      : work_(work),
        options_(options),
        folder_(folder),
        ranks_(ranks),
        sink_(sink),
        stop_(options.max_wall, ranks),
        store_(folder, ranks.size() > 1 ? ranks.rank() : options.share.index, manifest),
        reader_(after_all(ranks, folder)),
        rules_(work.stop_rules, options.runs, reader_),
        plan_(work, options, ranks, reader_, rules_),
        board_([this] { return plan_.next(); }, columns()) {}

  StudyOutcome run() {
    store_.begin_session(options_.runs);
    plan_.make();
    std::vector<StoredBlock> parts = plan_.kept();
    kept_before_ = runs_of(parts);
    board_.go_on_from(std::move(parts), reader_.manifest().identity.block_size);
    execute();
    if (ranks_.largest(stop_.has_come()) == 0 && plan_.mend()) execute();
    return finish();
  }

 private:
  /// What a rank mends of its file when it opens it is not read by the others before.
  static const std::string& after_all(Ranks& ranks, const std::string& folder) {
    ranks.largest(0);
    return folder;
  }

  void execute() {
    const ThreadCount told(options_.threads);  // one thread: runs spread nothing either
    const int threads = usual_threads();
    require_threads(threads);
#pragma omp parallel num_threads(threads)
    work_through();
    stop_.tell_others();
    if (stop_.has_come() && !stop_.is_broken()) keep();
  }

  /// A session may be shorter than a block: what it executed of one is where the next goes on. Only
  /// runs at which `fail_fast` would stop are left out, so that the same call stops at one again.
  void keep() {
    try {
      const auto parts = board_.unfinished(failed_runs());
      store_.keep(parts);
      ranks_.add(Counter::kept, runs_of(parts));
    } catch (...) {
      queue_.give_up(std::current_exception());
      stop_.breaks();
    }
  }

  BlockBoard::Failed failed_runs() const {
    return options_.fail_fast ? BlockBoard::Failed::left_out : BlockBoard::Failed::kept;
  }

  std::vector<std::size_t> columns() const {
    std::vector<std::size_t> list;
    for (const PointInfo& p : reader_.manifest().points) list.push_back(p.columns.size());
    return list;
  }

  double seconds() const {
    return std::chrono::duration<double>(Clock::now() - started_).count();
  }

  void work_through() {
    try {
      std::unique_ptr<RunWorker> worker;
      std::size_t point = 0;
      const auto most = [&](std::size_t of) { return work_.points[of].task->together(); };
      std::vector<RunWork> runs;
      while (!stop_.must_stop(seconds())) {
        const auto tickets = board_.take(most);
        if (tickets.empty()) break;
        stop_.time().begin();
        const double begun = seconds();
        if (!worker || point != tickets[0].point())
          worker = work_.points[point = tickets[0].point()].task->worker();
        runs.clear();
        for (const BlockBoard::Ticket& t : tickets) runs.push_back({t.run(), t.row(), {}});
        guarded_runs(*worker, runs);
        stop_.time().end(seconds() - begun);
        for (std::size_t k = 0; k < runs.size(); ++k) finish(tickets[k], runs[k].outcome);
        tell();
      }
    } catch (...) {
      queue_.give_up(std::current_exception());
      stop_.breaks();
    }
  }

  void finish(const BlockBoard::Ticket& ticket, const RunOutcome& outcome) {
    if (outcome.status != RunStatus::ok) {
      ++own_failed_;
      if (options_.fail_fast && stop_.is_because(SessionStop::failed_run))
        failed_first_ = {ticket.point(),
                         {ticket.run(), outcome.status, outcome.cause, outcome.t_failed, 0.0}};
    }
    ++own_done_;
    if (auto block = board_.finish(ticket, outcome, failed_runs())) {
      ranks_.add(Counter::taken_over, ticket.block->taken_over);
      queue_.store(std::move(*block));
    }
  }

  void commit(const std::vector<StoredBlock>& batch) {
    store_.commit(batch);
    rules_.advance();
    std::uint64_t runs = 0, failed = 0;
    for (const StoredBlock& b : batch) runs += b.block.status.size(), failed += b.failures.size();
    ranks_.add(Counter::done, runs);
    if (failed > 0) ranks_.add(Counter::failed, failed);
  }

  void tell() {
    constexpr double interval = 0.2;  // [s]
    if (!sink_ || !ranks_.leader()) return;
    const std::unique_lock lock(progress_guard_, std::try_to_lock);
    if (!lock || seconds() - told_ < interval) return;
    told_ = seconds();
    sink_(progress());
  }

  Progress progress() {
    // One process knows its runs one by one; of the other ranks whole blocks are known.
    const bool alone = ranks_.size() == 1;
    const BlockBoard::TakenOver before =
        alone ? board_.taken_over() : BlockBoard::TakenOver{ranks_.add(Counter::taken_over, 0), 0};
    Progress p;
    p.done_now = alone ? own_done_.load() : done_of_ranks();
    p.failed = plan_.failed_before() + before.failed +
               (alone ? own_failed_.load() : ranks_.add(Counter::failed, 0));
    p.done = plan_.runs_before() + before.runs + p.done_now;
    p.total = plan_.total(p.done);
    p.at_most = rules_.follows() && p.done < p.total;
    p.elapsed = seconds();
    return p;
  }

  /// Runs that this session executed, in blocks that it stored.
  std::uint64_t done_of_ranks() {
    const std::uint64_t taken_over = ranks_.add(Counter::taken_over, 0);
    return std::max(ranks_.add(Counter::done, 0), taken_over) - taken_over;
  }

  /// All ranks come here, whatever happened; the gravest answer is everyone's.
  StudyOutcome finish() {
    StudyOutcome outcome;
    outcome.leader = ranks_.leader();
    outcome.failed_first = failed_first_;
    ranks_.add(Counter::executed, own_done_);
    ranks_.add(Counter::executed_failed, own_failed_);
    const ExitCode defect = queue_.error() ? code_of(queue_.error()) : ExitCode::ok;
    outcome.code = of_gravity(ranks_.largest(gravity(stop_.code(defect))));
    if (queue_.error()) {
      end_session(defect);
      std::rethrow_exception(queue_.error());
    }
    if (sink_ && outcome.leader) sink_(progress());
    outcome.done_before = plan_.runs_before();
    outcome.cut_short = plan_.cut_short();
    outcome.stored_runs = reader_.runs();
    outcome.done = done_of_ranks();
    outcome.kept = ranks_.add(Counter::kept, 0);
    outcome.kept_before = kept_before_;
    outcome.taken_over = ranks_.add(Counter::taken_over, 0);
    const std::uint64_t saved = outcome.done + outcome.kept;
    outcome.dropped = std::max(ranks_.add(Counter::executed, 0), saved) - saved;
    outcome.longest_group = stop_.time().longest();
    outcome.failed = ranks_.add(Counter::failed, 0);
    outcome.failed_now = ranks_.add(Counter::executed_failed, 0);
    outcome.seconds = seconds();
    if (outcome.leader) look_back(outcome);
    share_with_all(outcome, ranks_);
    end_session(outcome.code, outcome.complete);
    outcome.notes = store_.notes();
    if (outcome.leader)  // all ranks read the same
      outcome.notes.insert(outcome.notes.end(), reader_.notes().begin(), reader_.notes().end());
    return outcome;
  }

  void end_session(ExitCode code, bool complete = false) {
    try {
      // What a longer study began is not of a shorter one.
      if (complete && options_.runs >= reader_.runs()) store_.forget_kept();
      store_.end_session(static_cast<int>(code));
    } catch (const InputError&) {  // the results are stored; a full disk has no room for this
    }
  }

  void look_back(StudyOutcome& outcome) {
    const WorkPlan::Rest rest = plan_.rest();
    outcome.missing = rest.all;
    outcome.missing_own = rest.own;
    outcome.complete = rest.all == 0;
    // No time for another group, and none was left.
    if (outcome.code == ExitCode::wall_time && rest.own == 0) outcome.code = ExitCode::ok;
    // Done and gone again: somebody took a file away, or damaged it, meanwhile.
    if (outcome.code == ExitCode::ok && rest.own > 0) outcome.code = ExitCode::wall_time;
    if (!outcome.complete) outcome.kept_after = runs_of(plan_.kept());
    if (!outcome.complete) return;
    outcome.results = rest.verified->results;
    outcome.failed = rest.verified->failed;
    outcome.digest = rest.verified->digest;
    try {
      note_finished(folder_, options_.runs);
    } catch (const InputError&) {  // the results are stored; this can be told anew
    }
    if (outcome.code == ExitCode::ok && outcome.failed > options_.allowed_failures)
      outcome.code = ExitCode::failed_runs;
  }

  const StudyWork& work_;
  const EngineOptions& options_;
  const std::string& folder_;
  Ranks& ranks_;
  const ProgressSink& sink_;
  SessionStop stop_;
  Clock::time_point started_ = Clock::now();
  WorkerStore store_;
  StudyReader reader_;
  RuleFollower rules_;
  WorkPlan plan_;
  BlockBoard board_;
  std::uint64_t kept_before_ = 0;
  std::atomic<std::uint64_t> own_done_ = 0, own_failed_ = 0;
  std::optional<StudyOutcome::FailedRun> failed_first_;  ///< by the thread that stopped for it
  std::mutex progress_guard_;
  BlockQueue queue_{[this](const std::vector<StoredBlock>& batch) { commit(batch); }};
  double told_ = -1.0;
};

}  // namespace

StudyOutcome run_study(const StudyWork& work, const EngineOptions& options,
                       const std::string& folder, const Manifest& manifest, Ranks& ranks,
                       const ProgressSink& progress) {
  return Engine(work, options, folder, manifest, ranks, progress).run();
}

}  // namespace drift::mc
