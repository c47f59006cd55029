#include "core/recording/isolated.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>

#include "core/base/check.hpp"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define DRIFT_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define DRIFT_SANITIZED
#endif
#endif

namespace drift {
namespace {

enum class Tag : char {
  fact = 'F',
  unit = 'U',
  column = 'C',
  problem = 'P',
  more = 'M',
  end = 'E'
};

/// Moves all bytes, or says that it could not.
bool write_all(int fd, const char* data, std::size_t bytes) {
  while (bytes > 0) {
    const ssize_t done = ::write(fd, data, bytes);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    data += done;
    bytes -= static_cast<std::size_t>(done);
  }
  return true;
}

bool read_all(int fd, void* data, std::size_t bytes) {
  char* to = static_cast<char*>(data);
  while (bytes > 0) {
    const ssize_t done = ::read(fd, to, bytes);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    to += done;
    bytes -= static_cast<std::size_t>(done);
  }
  return true;
}

bool read_text(int fd, std::string& text) {
  std::uint64_t size = 0;
  if (!read_all(fd, &size, sizeof size) || size > (1u << 20)) return false;
  text.resize(size);
  return read_all(fd, text.data(), size);
}

/// The child's end of the pipe, and the means to learn how the child ended.
struct Child {
  pid_t pid = -1;
  int pipe = -1;

  int wait() {
    ::close(pipe);
    int status = 0;
    while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
  }
};

Child start_child(const std::function<void(int pipe)>& work) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw InputError(ExitCode::io,
                     fmt::format("no pipe to a reader process: {}", std::strerror(errno)));
  const pid_t pid = ::fork();
  if (pid < 0) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw InputError(ExitCode::io, fmt::format("no reader process: {}", std::strerror(errno)));
  }
  if (pid > 0) {
    ::close(ends[1]);
    return {pid, ends[0]};
  }
  ::close(ends[0]);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  // What a library prints about a damaged file is said better by the parent.
  if (const int null = ::open("/dev/null", O_WRONLY); null >= 0) {
    ::dup2(null, STDOUT_FILENO);
    ::dup2(null, STDERR_FILENO);
  }
  try {
    work(ends[1]);
  } catch (...) {
    ::_exit(1);
  }
  ::_exit(0);
}

/// Keeps a damaged file from taking all memory or running for ever.
void limit_child(std::uint64_t file_size) {
  const rlim_t seconds = 30 + file_size / 1'000'000;
  const rlimit cpu{seconds, seconds};
  ::setrlimit(RLIMIT_CPU, &cpu);
#ifndef DRIFT_SANITIZED     // a sanitizer reserves more address space than any limit allows
  unsigned long pages = 0;  // what the parent holds is counted too
  if (std::FILE* f = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(f, "%lu", &pages) != 1) pages = 0;
    std::fclose(f);
  }
  const rlim_t held = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
  const rlim_t memory = held + (rlim_t{1} << 30) + 64 * file_size;
  const rlimit space{memory, memory};
  ::setrlimit(RLIMIT_AS, &space);
#endif
}

bool read_values(int pipe, std::vector<double>& values) {
  std::uint64_t n = 0;
  if (!read_all(pipe, &n, sizeof n) || n > (std::uint64_t{1} << 40)) return false;
  values.resize(n);
  return read_all(pipe, values.data(), n * sizeof(double));
}

/// Follows what the child says; false if it fell silent before the end.
bool receive(int pipe, RawRecording& raw, Problems& problems) {
  std::vector<std::pair<std::string, std::string>> units;
  std::string a, b;
  Tag tag{};
  while (read_all(pipe, &tag, 1)) {
    if (tag == Tag::end) {
      for (const auto& [name, unit] : units) {
        const auto c = std::ranges::find(raw.columns, name, &RawColumn::name);
        if (c != raw.columns.end())
          c->unit = unit;
        else
          problems.add(name, "a unit is given but there is no such channel",
                       "one unit for each channel", "Correct the name of the unit's channel");
      }
      return true;
    }
    if (tag == Tag::column) {
      RawColumn column;
      if (!read_text(pipe, column.name) || !read_values(pipe, column.values)) return false;
      raw.columns.push_back(std::move(column));
    } else if (tag == Tag::more) {
      std::uint64_t more = 0;
      if (!read_all(pipe, &more, sizeof more)) return false;
      problems.add_uncounted(more);
    } else {
      if (!read_text(pipe, a)) return false;
      if (tag == Tag::problem) {
        problems.add(a);
      } else {
        if (!read_text(pipe, b)) return false;
        if (tag == Tag::unit)
          units.emplace_back(a, b);
        else if (!add_fact(raw, a, b))
          problems.add("", "one fact too many, or one too long: " + in_quotes(a),
                       fmt::format("at most {} facts of {} bytes", most_facts, longest_fact),
                       "Remove or shorten it");
      }
    }
  }
  return false;
}

void send_tag(int pipe, Tag tag) {
  if (!write_all(pipe, reinterpret_cast<const char*>(&tag), 1)) ::_exit(2);
}

}  // namespace

void RawSink::send(const void* data, std::size_t bytes) {
  if (!write_all(pipe_, static_cast<const char*>(data), bytes)) ::_exit(2);  // the parent is gone
}

void RawSink::send(std::string_view text) {
  const std::uint64_t size = std::min<std::size_t>(text.size(), 1u << 20);
  send(&size, sizeof size);
  send(text.data(), size);
}

void RawSink::fact(std::string_view key, std::string_view value) {
  send_tag(pipe_, Tag::fact);
  send(key);
  send(value);
}

void RawSink::unit(std::string_view column, std::string_view unit) {
  send_tag(pipe_, Tag::unit);
  send(column);
  send(unit);
}

void RawSink::column(std::string_view name, std::span<const double> values) {
  send_tag(pipe_, Tag::column);
  send(name);
  const std::uint64_t n = values.size();
  send(&n, sizeof n);
  send(values.data(), values.size_bytes());
}

void RawSink::finish() {
  for (const auto& message : problems_.messages()) {
    send_tag(pipe_, Tag::problem);
    send(message);
  }
  const std::uint64_t more = problems_.more();
  send_tag(pipe_, Tag::more);
  send(&more, sizeof more);
  send_tag(pipe_, Tag::end);
}

RawRecording read_isolated(const std::string& path, Problems& problems,
                           const std::function<void(const std::string&, RawSink&)>& reader) {
  struct stat info {};
  const bool known = ::stat(path.c_str(), &info) == 0 && info.st_size > 0;
  Child child = start_child([&](int pipe) {
    limit_child(known ? static_cast<std::uint64_t>(info.st_size) : 0);
    RawSink sink(pipe, problems.file());
    try {
      reader(path, sink);
    } catch (const std::bad_alloc&) {
      sink.problems().add("", "reading it takes more memory than a recording of its size can need",
                          "an undamaged file", "Copy or export it again");
    }
    sink.finish();
  });
  RawRecording raw;
  bool complete = false;
  try {
    complete = receive(child.pipe, raw, problems);
  } catch (...) {  // out of memory: the child must not be left behind
    child.wait();
    throw;
  }
  const int status = child.wait();
  if (!complete) {
    const std::string how = WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU
                                ? "reading it takes too long"
                                : "the library that reads it fails";
    problems.add("", "the file is damaged: " + how, "an undamaged file", "Copy or export it again");
    return {};
  }
  return raw;
}

std::string write_isolated(const std::function<std::string()>& writer) {
  Child child = start_child([&](int pipe) {
    const std::string wrong = writer();
    write_all(pipe, wrong.data(), wrong.size());
    write_all(pipe, "\n", 1);
  });
  std::string answer;
  char c = 0;
  while (read_all(child.pipe, &c, 1)) answer += c;
  child.wait();
  if (answer.empty()) return "the library that writes it fails";
  answer.pop_back();
  return answer;
}

}  // namespace drift
