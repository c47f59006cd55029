#include "core/recording/line_reader.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/base/check.hpp"

namespace drift {

LineReader::LineReader(const std::string& path) : path_(path), buffer_(4 * longest_line) {
  fd_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd_ < 0)
    throw InputError(ExitCode::io, fmt::format("{}: cannot be opened: {}. Check the path and its "
                                               "permissions",
                                               path, std::strerror(errno)));
  struct stat info {};
  if (::fstat(fd_, &info) == 0 && info.st_size > 0)
    file_size_ = static_cast<std::size_t>(info.st_size);
}

LineReader::~LineReader() {
  ::close(fd_);
}

std::size_t LineReader::read_bytes(char* to, std::size_t most) {
  ssize_t got = 0;
  do got = ::read(fd_, to, most);
  while (got < 0 && errno == EINTR);
  if (got < 0)
    throw InputError(ExitCode::io,
                     fmt::format("{}:{}: cannot be read on: {}. Check the disk or the "
                                 "network drive",
                                 path_, number_ + 1, std::strerror(errno)));
  return static_cast<std::size_t>(got);
}

void LineReader::take_mark() {
  begun_ = true;
  while (end_ < 3) {
    const std::size_t got = read_bytes(buffer_.data() + end_, 3 - end_);
    if (got == 0) break;
    end_ += got;
  }
  const std::string_view start(buffer_.data(), end_);
  std::size_t mark = 0;
  if (start.starts_with("\xEF\xBB\xBF")) mark = 3;
  if (start.starts_with("\xFF\xFE") || start.starts_with("\xFE\xFF")) {
    mark = 2;
    utf16_.emplace(start[0] == '\xFF' ? Utf16Decoder::Order::little : Utf16Decoder::Order::big);
  }
  std::string rest(start.substr(mark));
  if (utf16_) rest = utf16_->decode(rest);
  std::memcpy(buffer_.data(), rest.data(), rest.size());
  end_ = rest.size();
}

bool LineReader::refill() {
  if (!begun_) take_mark();
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  std::size_t got = 0;
  if (!utf16_) {
    got = read_bytes(buffer_.data() + end_, buffer_.size() - end_);
    end_ += got;
  } else {
    std::string raw((buffer_.size() - end_) / 2, '\0');  // two bytes become at most three
    got = read_bytes(raw.data(), raw.size());
    const std::string text = utf16_->decode(std::string_view(raw).substr(0, got));
    std::memcpy(buffer_.data() + end_, text.data(), text.size());
    end_ += text.size();
  }
  at_end_ = got == 0;
  if (number_ == 0) choose_line_end();
  return got > 0;
}

/// A file whose lines end with a carriage return alone (spreadsheets of old): no line feed in the
/// first buffer, and a carriage return that none may follow.
void LineReader::choose_line_end() {
  const std::string_view held(buffer_.data() + begin_, end_ - begin_);
  const auto at = held.find('\r');
  const bool alone = at != std::string_view::npos && at + 1 < held.size();
  line_end_ = alone && held.find('\n') == std::string_view::npos ? '\r' : '\n';
}

bool LineReader::next(std::string_view& line) {
  cut_ = false;
  std::size_t searched = 0;
  while (true) {
    const char* start = buffer_.data() + begin_;
    const std::size_t held = end_ - begin_;
    if (const void* hit = std::memchr(start + searched, line_end_, held - searched)) {
      std::size_t size = static_cast<std::size_t>(static_cast<const char*>(hit) - start);
      begin_ += size + 1;
      consumed_ += size + 1;
      cut_ = cut_ || size > longest_line;
      if (size > 0 && start[size - 1] == '\r') --size;
      line = {start, std::min(size, longest_line)};
      ++number_;
      ended_ = true;
      return true;
    }
    searched = held;
    if (held > 2 * longest_line) {  // keep the beginning for the message, drop what follows
      cut_ = true;
      consumed_ += held - longest_line - 1;
      end_ = begin_ + longest_line + 1;
      searched = longest_line + 1;
    }
    if (at_end_ || !refill()) {
      if (begin_ == end_) return false;
      const std::size_t size = end_ - begin_;
      line = {buffer_.data() + begin_, std::min(size, longest_line)};
      cut_ = cut_ || size > longest_line;
      begin_ = end_;
      consumed_ += size;
      ++number_;
      ended_ = false;
      return true;
    }
  }
}

}  // namespace drift
