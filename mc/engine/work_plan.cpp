#include "mc/engine/work_plan.hpp"

#include <algorithm>

#include "core/base/shuffle.hpp"

namespace drift::mc {

WorkPlan::WorkPlan(const StudyWork& work, const EngineOptions& options, Ranks& ranks,
                   StudyReader& reader, RuleFollower& rules)
    : work_(work), options_(options), ranks_(ranks), reader_(reader), rules_(rules) {}

std::vector<std::uint64_t> WorkPlan::own(const std::vector<std::uint64_t>& blocks) const {
  const WorkerShare share = ranks_.size() > 1 ? WorkerShare{} : options_.share;
  std::vector<std::uint64_t> mine;
  for (const std::uint64_t i : blocks)
    if (share.has(i)) mine.push_back(i);
  return mine;
}

Listed WorkPlan::listed() {
  reader_.refresh();
  rules_.advance();
  return list_stored(reader_, all_, rules_);
}

Verified WorkPlan::verified() {
  return verify_stored(reader_, all_, rules_, work_.stop_rules);
}

void WorkPlan::make() {
  all_ = all_blocks(reader_.manifest(), options_.runs);
  std::vector<std::uint64_t> missing;
  if (!ranks_.leader()) {
    rules_.advance();
  } else {
    const Listed found = listed();
    before_ = found.runs;
    failed_before_ = found.failed;
    cut_short_ = found.cut_short;
    missing = own(found.missing);
  }
  ranks_.broadcast(missing);
  if (Stream stream(options_.shuffle, 0, Purpose::test); options_.shuffle != 0)
    shuffle(missing, stream);
  todo_ = std::move(missing);
}

bool WorkPlan::mend() {
  std::vector<std::uint64_t> damaged;
  if (ranks_.leader()) {
    if (listed().missing.empty()) {
      verified_ = verified();
      damaged = own(verified_->missing);
    }
    for (const std::uint64_t i : damaged) {
      before_ -= std::min<std::uint64_t>(before_, all_[i].count);
      if (const BlockEntry* listed = reader_.listed(all_[i].point, all_[i].first))
        failed_before_ -= std::min<std::uint64_t>(failed_before_, listed->failed);
    }
    damaged.push_back(ranks_.add(Ranks::Counter::block, 0));
  }
  ranks_.broadcast(damaged);
  taken_before_ = damaged.back() - todo_.size();  // every thread asked once more than there was
  damaged.pop_back();
  if (damaged.empty()) return false;
  todo_.insert(todo_.end(), damaged.begin(), damaged.end());
  verified_.reset();
  return true;
}

std::vector<StoredBlock> WorkPlan::kept() {
  const std::uint64_t size = reader_.manifest().identity.block_size;
  const std::uint64_t each = all_.size() / reader_.manifest().points.size();
  return reader_.kept([&](std::size_t point, std::uint64_t first) {
    return first < options_.runs && own({point * each + first / size}).size() == 1;
  });
}

std::optional<BlockKey> WorkPlan::next() {
  while (true) {
    const std::uint64_t i = ranks_.add(Ranks::Counter::block, 1) - taken_before_;
    if (i >= todo_.size()) return std::nullopt;
    const BlockKey& key = all_[todo_[i]];
    if (!rules_.enough(key.point)) return key;
    skipped_ += key.count;
  }
}

std::uint64_t WorkPlan::total(std::uint64_t done) const {
  std::uint64_t all = before_;
  for (const std::uint64_t i : todo_) all += all_[i].count;
  return all - std::min(all - done, std::min<std::uint64_t>(skipped_, all));
}

WorkPlan::Rest WorkPlan::rest() {
  std::vector<std::uint64_t> missing = listed().missing;
  Rest rest;
  if (missing.empty()) {
    rest.verified = verified_ ? std::move(verified_) : verified();
    missing = rest.verified->missing;
  }
  rest.all = missing.size();
  rest.own = own(missing).size();
  return rest;
}

}  // namespace drift::mc
