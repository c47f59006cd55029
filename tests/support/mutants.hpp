#pragma once

#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace drift::test {

/// Damaged copies of files: bytes and bits changed, pieces taken out, doubled, cut off, exchanged
/// with another file's, and words put in that readers look for. Mutant `number` of `series` is
/// always the same.
class Mutants {
 public:
  Mutants(std::vector<std::string> originals, std::vector<std::string> words)
      : originals_(std::move(originals)), words_(std::move(words)) {}

  std::string of(unsigned series, unsigned number) const {
    std::seed_seq seed{series, number};
    std::mt19937 random(seed);
    std::string text = originals_[number % originals_.size()];
    for (auto changes = 1 + random() % 6; changes > 0 && !text.empty(); --changes)
      change(text, random);
    return text;
  }

 private:
  void change(std::string& text, std::mt19937& random) const {
    const auto below = [&](std::size_t n) { return n > 0 ? random() % n : 0; };
    // Half of the damage goes to the beginning, where the headers of binary files are.
    const std::size_t at =
        below(random() % 2 == 0 ? text.size() : std::min<std::size_t>(text.size(), 2048));
    const std::string& other = originals_[below(originals_.size())];
    switch (below(9)) {
      case 0:
        text[at] = static_cast<char>(random());
        break;
      case 1:
        text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        break;
      case 2:
        text.erase(at, 1 + below(20));
        break;
      case 3:
        text.insert(at, words_[below(words_.size())]);
        break;
      case 4:
        text.insert(at, text.substr(below(text.size()), below(60)));
        break;
      case 5:
        text.replace(at, below(200), other, below(other.size()), below(200));
        break;
      case 6:
        for (std::size_t i = at; i < std::min(text.size(), at + 1 + below(16)); ++i)
          text[i] = static_cast<char>(random());
        break;
      case 7:
        text.replace(at, std::min<std::size_t>(8, text.size() - at), 8,
                     random() % 2 == 0 ? '\0' : '\xff');
        break;
      default:
        if (random() % 8 == 0) text.resize(at);
    }
  }

  std::vector<std::string> originals_, words_;
};

}  // namespace drift::test
