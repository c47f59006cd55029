#include "analysis/planning/shared_steps.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace drift::planning {
namespace {

mc::StoredBlock block_of(std::size_t step, std::size_t candidate,
                         const std::optional<double>& merit) {
  mc::StoredBlock b;
  b.block = {step, candidate, {mc::RunStatus::ok}, {merit ? 1.0 : 0.0, merit.value_or(0.0)}};
  return b;
}

}  // namespace

std::string steps_folder(const std::string& results) {
  return results + "/candidates";
}

mc::Manifest steps_manifest(mc::StudyIdentity study, const std::string& text, std::size_t steps,
                            const std::string& criterion) {
  study.text += fmt::format("# rank --improve {} --criterion {}\n", steps, criterion);
  study.block_size = 1;
  mc::Manifest manifest = mc::make_manifest(std::move(study), text, {});
  for (std::size_t step = 0; step < steps; ++step)
    manifest.points.push_back({fmt::format("position {} to add", step + 1),
                               {{"possible", unit::one}, {"merit", unit::one}}});
  return manifest;
}

mc::StudyState steps_state(const std::string& results) {
  mc::StudyReader reader(steps_folder(results));
  return mc::state_of(reader, {});
}

SharedSteps::SharedSteps(const std::string& folder, const mc::Manifest& manifest,
                         const mc::WorkSession& session)
    : folder_(folder),
      session_(session),
      store_(folder, session.share.index, manifest),
      reader_(folder) {}

void SharedSteps::look(std::size_t step) {
  reader_.refresh();
  const std::scoped_lock lock(guard_);
  for (std::size_t k = 0; k < candidates_; ++k) {
    if (known_.contains(k)) continue;
    const auto stored = reader_.read(step, k);
    if (!stored) continue;
    if (stored->block.rows.at(0) != 0.0) merits_[k] = stored->block.rows.at(1);
    known_.insert(k);
  }
}

bool SharedSteps::is_known(std::size_t k) {
  const std::scoped_lock lock(guard_);
  return known_.contains(k);
}

void SharedSteps::work_at(const std::vector<std::size_t>& jobs, std::size_t step,
                          const Judge& judge) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds interval(1);  // a transaction takes longer than many a candidate
  std::mutex commits, finished;
  std::vector<mc::StoredBlock> done;
  Clock::time_point last = Clock::now();
  const auto commit = [&](const std::vector<mc::StoredBlock>& batch) {
    const std::scoped_lock lock(commits);
    if (!batch.empty()) store_.commit(batch);
    judged_ += batch.size();
    look(step);
  };
  mc::work_through(jobs, session_, [&](std::size_t k) {
    if (is_known(k)) return;
    mc::StoredBlock block = block_of(step, k, judge(k));
    std::vector<mc::StoredBlock> batch;
    {
      const std::scoped_lock lock(finished);
      done.push_back(std::move(block));
      if (Clock::now() - last < interval) return;
      last = Clock::now();
      batch = std::exchange(done, {});
    }
    commit(batch);
  });
  commit(done);
}

std::optional<Merits> SharedSteps::judge(std::size_t step, std::size_t candidates,
                                         const Judge& judge) {
  if (!begun_) store_.begin_session(candidates);
  begun_ = true;
  candidates_ = candidates;
  merits_.assign(candidates, std::nullopt);
  known_.clear();
  look(step);
  while (known_.size() < candidates) {
    work_at(mc::own_part(candidates, session_.share), step, judge);
    if (known_.size() < candidates)
      work_at(mc::own_part_first(candidates, session_.share), step, judge);
    if (session_.time.is_over() && known_.size() < candidates) return std::nullopt;
  }
  return merits_;
}

void SharedSteps::end(ExitCode code) {
  if (begun_) store_.end_session(static_cast<int>(code));
  if (code == ExitCode::ok) mc::note_finished(folder_, candidates_);
}

}  // namespace drift::planning
