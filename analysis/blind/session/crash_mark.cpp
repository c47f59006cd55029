#include "analysis/blind/session/crash_mark.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <mutex>
#include <utility>

namespace drift::blind {
namespace {

constexpr std::pair<int, const char*> crashes[] = {{SIGSEGV, "SIGSEGV\n"},
                                                   {SIGBUS, "SIGBUS\n"},
                                                   {SIGFPE, "SIGFPE\n"},
                                                   {SIGILL, "SIGILL\n"},
                                                   {SIGABRT, "SIGABRT\n"}};

thread_local const char* file_of_this_thread = nullptr;  // a handler reaches nothing but globals

/// Only what may be called in a signal handler. The default action, which SA_RESETHAND has set
/// again, follows: the instruction is repeated, or abort() goes on.
extern "C" void on_crash(int number) {
  if (file_of_this_thread != nullptr)
    if (const int fd = ::open(file_of_this_thread,
                              O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0666);
        fd >= 0) {
      for (const auto& [signal, line] : crashes)
        if (signal == number && ::write(fd, line, std::strlen(line)) > 0) ::fsync(fd);
      ::close(fd);
    }
  ::raise(number);
}

void install_handlers() {
  static std::once_flag once;
  std::call_once(once, [] {
    struct sigaction action {};
    action.sa_handler = on_crash;
    action.sa_flags = SA_RESETHAND | SA_ONSTACK;
    sigemptyset(&action.sa_mask);
    for (const auto& [signal, line] : crashes) ::sigaction(signal, &action, nullptr);
  });
}

}  // namespace

CrashMark::CrashMark(std::string file) : file_(std::move(file)), stack_(64 * 1024) {
  install_handlers();
  stack_t stack{};
  stack.ss_sp = stack_.data();
  stack.ss_size = stack_.size();
  ::sigaltstack(&stack, nullptr);
  file_of_this_thread = file_.c_str();
}

CrashMark::~CrashMark() {
  file_of_this_thread = nullptr;
  stack_t none{};
  none.ss_flags = SS_DISABLE;
  ::sigaltstack(&none, nullptr);
}

std::vector<std::string> crashes_in(const std::string& file) {
  std::ifstream in(file);
  std::vector<std::string> names;
  for (std::string line; std::getline(in, line);) names.push_back(line);
  return names;
}

}  // namespace drift::blind
