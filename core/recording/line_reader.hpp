#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/recording/own/text_decoding.hpp"

namespace drift {

/// Reads a file line by line through one buffer, so that its size does not matter. A byte order
/// mark is passed over; UTF-16 with one is read as UTF-8.
class LineReader {
 public:
  static constexpr std::size_t longest_line = 64 * 1024;  ///< [bytes]

  /// InputError (io) if the file cannot be opened.
  explicit LineReader(const std::string& path);
  ~LineReader();
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  /// The following line without its line end (LF, CRLF, or CR where a file has no other), valid
  /// until the call after it; false at the end. Of a line longer than longest_line only the
  /// beginning is given. InputError (io) if reading fails.
  bool next(std::string_view& line);

  std::size_t number() const { return number_; }        ///< of the last line, from 1
  bool cut() const { return cut_; }                     ///< the last line was too long
  bool ended() const { return ended_; }                 ///< the last line had a line end
  std::size_t consumed() const { return consumed_; }    ///< bytes of all lines given so far
  std::size_t file_size() const { return file_size_; }  ///< when it was opened [bytes]

 private:
  bool refill();
  void choose_line_end();
  std::size_t read_bytes(char* to, std::size_t most);
  void take_mark();

  std::string path_;
  int fd_ = -1;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;
  std::size_t number_ = 0, consumed_ = 0, file_size_ = 0;
  std::optional<Utf16Decoder> utf16_;
  char line_end_ = '\n';
  bool cut_ = false, at_end_ = false, begun_ = false, ended_ = true;
};

}  // namespace drift
