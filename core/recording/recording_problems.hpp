#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/utf8.hpp"

namespace drift {

/// What to do about a damaged file.
inline constexpr std::string_view copy_again = "Copy or export the file again";

/// What is wrong with one file, message by message. The same thing wrong in many rows of a column
/// is one message with a count; the first `cap` messages are kept, the rest counted.
class Problems {
 public:
  static constexpr std::size_t cap = 50;

  explicit Problems(std::string file) : file_(std::move(file)) {}

  /// "file:where: wrong (expected ...). Fix". `where` is "line:column", "line", "column" or empty.
  void add(std::string_view where, std::string_view wrong, std::string_view expected,
           std::string_view fix);
  /// "file:line: sentences". The same sentences about many rows are one message with a count.
  void add_in_line(std::size_t line, std::string_view sentences);
  /// A complete message, as another Problems made it.
  void add(std::string message);
  /// Problems found elsewhere beyond their own cap.
  void add_uncounted(std::size_t more) { more_ += more; }

  const std::string& file() const { return file_; }
  bool any() const { return !messages_.empty() || more_ > 0; }
  std::size_t count() const;
  std::size_t more() const { return more_; }
  bool full() const { return messages_.size() >= cap; }
  std::vector<std::string> messages() const;

  /// InputError (recording) with every message kept and the number of those that are not.
  void throw_if_any() const;

 private:
  /// Counts one more row of a kind; false if there is none yet.
  bool counted(std::string_view kind, std::string_view line);

  struct Message {
    std::string kind;  ///< what messages of the same kind have in common; empty: nothing
    std::string where, text;
    std::size_t alike = 0;    ///< further rows
    std::string last_where;   ///< of these
    std::size_t columns = 0;  ///< further ones, named in `where`
  };

  std::string file_;
  std::vector<Message> messages_;
  std::size_t more_ = 0;
};

/// Text of a file made fit for a message: in quotes, shortened, control characters and bytes that
/// are not UTF-8 as \xNN.
std::string in_quotes(std::string_view text);

/// Without spaces, tabs and line ends at both ends.
std::string_view trimmed(std::string_view text);

}  // namespace drift
