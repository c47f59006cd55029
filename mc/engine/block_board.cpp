#include "mc/engine/block_board.hpp"

#include <algorithm>
#include <limits>

namespace drift::mc {

std::vector<BlockBoard::Ticket> BlockBoard::take(
    const std::function<std::size_t(std::size_t)>& most) {
  const std::scoped_lock lock(guard_);
  if (!current_) {
    const auto key = next_block_();
    if (!key) return {};
    current_ = std::make_shared<InFlight>();
    current_->columns = columns_[key->point];
    current_->left = key->count;
    current_->stored.block = {key->point, key->first, std::vector<RunStatus>(key->count),
                              std::vector<double>(key->count * current_->columns,
                                                  std::numeric_limits<double>::quiet_NaN())};
  }
  const std::size_t all = current_->stored.block.status.size();
  std::vector<Ticket> tickets;
  for (std::size_t left = most(current_->stored.block.point); left > 0 && current_->taken < all;
       --left)
    tickets.push_back({current_, current_->taken++});
  if (current_->taken == all) current_.reset();
  return tickets;
}

std::optional<StoredBlock> BlockBoard::finish(const Ticket& ticket, const RunOutcome& outcome) {
  const std::scoped_lock lock(guard_);
  InFlight& b = *ticket.block;
  b.stored.block.status[ticket.offset] = outcome.status;
  b.stored.times.integration_s += outcome.integration_s;
  b.stored.times.filter_s += outcome.filter_s;
  b.stored.times.total_s += outcome.total_s;
  if (outcome.status != RunStatus::ok)
    b.stored.failures.push_back(
        {ticket.run(), outcome.status, outcome.cause, outcome.t_failed, outcome.total_s});
  if (--b.left > 0) return std::nullopt;
  std::sort(b.stored.failures.begin(), b.stored.failures.end(),
            [](const Failure& x, const Failure& y) { return x.run < y.run; });
  return std::move(b.stored);
}

}  // namespace drift::mc
