#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace drift {

/// A table in place, filled up to a size; entries beyond it are as they are made, and may be looked
/// at.
template <class Entry, std::size_t capacity>
class FilledTable {
 public:
  /// The first `size` of some entries.
  constexpr FilledTable(const std::array<Entry, capacity>& entries, std::size_t size)
      : size_(size) {
    std::copy_n(entries.begin(), size, entries_.begin());
  }
  constexpr void add(const Entry& entry) { entries_[size_++] = entry; }

  constexpr const Entry& operator[](std::size_t i) const { return entries_[i]; }
  constexpr std::size_t size() const { return size_; }
  constexpr const Entry* begin() const { return entries_.data(); }
  constexpr const Entry* end() const { return entries_.data() + size_; }

 private:
  std::array<Entry, capacity> entries_{};
  std::size_t size_;
};

}  // namespace drift
