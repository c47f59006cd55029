#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace drift {

/// How much what is said matters to a reader who reads the first lines alone.
enum class Weight {
  wrong,     ///< something is not as it should be, and no answer can be better than it
  doubtful,  ///< something may not be, and the answer hangs on it
  note       ///< how something was understood, or what was taken for granted
};

/// Sentences in the order in which they are said: what is wrong, what is doubtful, what is noted;
/// those of one weight as they came. Who has room for a few shows the first.
class WeighedTexts {
 public:
  void add(Weight weight, std::string text) {
    const auto after = std::ranges::upper_bound(all_, weight, {}, &Text::weight);
    all_.insert(after, {weight, std::move(text)});
  }
  void add(const WeighedTexts& others) {
    for (const Text& t : others.all_) add(t.weight, t.text);
  }

  std::vector<std::string> texts() const {
    std::vector<std::string> out;
    for (const Text& t : all_) out.push_back(t.text);
    return out;
  }
  /// The first of what is wrong; empty where nothing is.
  std::string first_wrong() const {
    return all_.empty() || all_.front().weight != Weight::wrong ? "" : all_.front().text;
  }
  bool empty() const { return all_.empty(); }

 private:
  struct Text {
    Weight weight;
    std::string text;
  };
  std::vector<Text> all_;
};

}  // namespace drift
