#include "mc/engine/block_board.hpp"

#include <algorithm>
#include <limits>

namespace drift::mc {
namespace {

using InFlight = BlockBoard::InFlight;

std::size_t size_of(const InFlight& block) {
  return block.stored.block.status.size();
}

/// The end of the group that begins at a run.
std::size_t end_of_group(const InFlight& block, std::size_t begin) {
  return std::min(begin + block.group, size_of(block));
}

void sort_failures(std::vector<Failure>& failures) {
  std::ranges::sort(failures, {}, &Failure::run);
}

void add(BlockTimes& sum, const BlockTimes& times) {
  sum.integration_s += times.integration_s;
  sum.filter_s += times.filter_s;
  sum.total_s += times.total_s;
}

/// On to the next run that no earlier session has executed.
void skip_taken_over(InFlight& block) {
  while (block.next < size_of(block) && block.runs[block.next] == InFlight::Run::taken_over)
    ++block.next;
}

/// One group of an unfinished block.
StoredBlock part_of(const InFlight& b, std::size_t begin, std::size_t end) {
  const auto at = [](std::size_t i) { return static_cast<std::ptrdiff_t>(i); };
  const Block& from = b.stored.block;
  StoredBlock part;
  part.block = {
      from.point,
      from.first + begin,
      {from.status.begin() + at(begin), from.status.begin() + at(end)},
      {from.rows.begin() + at(begin * b.columns), from.rows.begin() + at(end * b.columns)}};
  for (std::size_t r = begin; r < end; ++r) add(part.times, b.times[r]);
  for (const Failure& f : b.stored.failures)
    if (f.run >= from.first + begin && f.run < from.first + end) part.failures.push_back(f);
  sort_failures(part.failures);
  return part;
}

}  // namespace

void BlockBoard::go_on_from(std::vector<StoredBlock> parts, std::uint64_t block_size) {
  const std::scoped_lock lock(guard_);
  for (StoredBlock& part : parts) {
    const std::uint64_t first = part.block.first - part.block.first % block_size;
    kept_[{part.block.point, first}].push_back(std::move(part));
  }
}

bool BlockBoard::begin(const Most& most) {
  const auto key = next_block_();
  if (!key) return false;
  current_ = std::make_shared<InFlight>();
  InFlight& b = *current_;
  b.columns = columns_[key->point];
  b.group = std::max<std::size_t>(1, most(key->point));
  b.left = key->count;
  b.runs.resize(key->count);
  b.times.resize(key->count);
  b.stored.block = {
      key->point, key->first, std::vector<RunStatus>(key->count),
      std::vector<double>(key->count * b.columns, std::numeric_limits<double>::quiet_NaN())};
  take_over(b);
  skip_taken_over(b);
  begun_[{key->point, key->first}] = current_;
  return true;
}

void BlockBoard::take_over(InFlight& b) {
  const auto kept = kept_.extract({b.stored.block.point, b.stored.block.first});
  if (kept.empty()) return;
  for (const StoredBlock& part : kept.mapped()) {
    const std::size_t begin = part.block.first - b.stored.block.first;
    const std::size_t count = part.block.status.size();
    // Other groups than those of this session are executed again. So is one where nothing else is
    // left to do: a block ends with a run of the session that stores it.
    if (begin >= size_of(b) || begin % b.group != 0 || begin + count != end_of_group(b, begin) ||
        b.runs[begin] != InFlight::Run::to_do || b.left == count)
      continue;
    const auto at = static_cast<std::ptrdiff_t>(begin);
    std::ranges::copy(part.block.status, b.stored.block.status.begin() + at);
    std::ranges::copy(part.block.rows,
                      b.stored.block.rows.begin() + at * static_cast<std::ptrdiff_t>(b.columns));
    std::fill_n(b.runs.begin() + at, count, InFlight::Run::taken_over);
    add(b.stored.times, part.times);
    b.stored.failures.insert(b.stored.failures.end(), part.failures.begin(), part.failures.end());
    b.left -= count;
    b.taken_over += count;
    taken_over_.runs += count;
    taken_over_.failed += part.failures.size();
  }
}

std::vector<BlockBoard::Ticket> BlockBoard::take(const Most& most) {
  const std::scoped_lock lock(guard_);
  if (!current_ && !begin(most)) return {};
  InFlight& b = *current_;
  std::vector<Ticket> tickets;
  for (const std::size_t end = end_of_group(b, b.next); b.next < end; ++b.next)
    tickets.push_back({current_, b.next});
  skip_taken_over(b);
  if (b.next == size_of(b)) current_.reset();
  return tickets;
}

std::optional<StoredBlock> BlockBoard::finish(const Ticket& ticket, const RunOutcome& outcome,
                                              Failed failed) {
  const std::scoped_lock lock(guard_);
  InFlight& b = *ticket.block;
  b.stored.block.status[ticket.offset] = outcome.status;
  b.runs[ticket.offset] = InFlight::Run::done;
  b.times[ticket.offset] = {outcome.integration_s, outcome.filter_s, outcome.total_s};
  add(b.stored.times, b.times[ticket.offset]);
  if (outcome.status != RunStatus::ok) {
    b.has_failed = true;
    b.stored.failures.push_back(
        {ticket.run(), outcome.status, outcome.cause, outcome.t_failed, outcome.total_s});
  }
  if (--b.left > 0 || (b.has_failed && failed == Failed::left_out)) return std::nullopt;
  begun_.erase({b.stored.block.point, b.stored.block.first});
  sort_failures(b.stored.failures);
  return std::move(b.stored);
}

BlockBoard::TakenOver BlockBoard::taken_over() const {
  const std::scoped_lock lock(guard_);
  return taken_over_;
}

std::vector<StoredBlock> BlockBoard::unfinished(Failed failed) const {
  const std::scoped_lock lock(guard_);
  std::vector<StoredBlock> parts;
  for (const auto& [place, block] : begun_)
    for (std::size_t begin = 0; begin < size_of(*block); begin += block->group) {
      const std::size_t end = end_of_group(*block, begin);
      const auto group = std::span(block->runs).subspan(begin, end - begin);
      if (std::ranges::any_of(group, [](auto run) { return run != InFlight::Run::done; })) continue;
      StoredBlock part = part_of(*block, begin, end);
      if (failed == Failed::kept || part.failures.empty()) parts.push_back(std::move(part));
    }
  return parts;
}

}  // namespace drift::mc
