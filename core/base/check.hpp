#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace drift {

/// What the program answers to the shell (core/docs/commands.md).
enum class ExitCode : int {
  ok = 0,
  internal = 1,
  usage = 2,
  config = 3,
  recording = 4,
  failed_runs = 5,
  io = 6,
  store = 7,
  self_check = 8,
  wall_time = 75,
  interrupted = 130,
  terminated = 143,
};

/// The user's data is wrong. Every problem found is kept, one message each, in the grammar
/// "file:line:col: what is wrong (what is expected). What to do". Only main() catches it.
class InputError : public std::runtime_error {
 public:
  InputError(ExitCode code, std::vector<std::string> messages)
      : std::runtime_error(joined(messages)), code_(code), messages_(std::move(messages)) {}
  InputError(ExitCode code, std::string message)
      : InputError(code, std::vector<std::string>{std::move(message)}) {}

  ExitCode code() const { return code_; }
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  static std::string joined(const std::vector<std::string>& messages) {
    std::string all;
    for (const auto& m : messages) all += (all.empty() ? "" : "\n") + m;
    return all;
  }

  ExitCode code_;
  std::vector<std::string> messages_;
};

/// The program itself is wrong: a contract between its parts was broken.
class ContractError : public std::logic_error {
  using std::logic_error::logic_error;
};

[[noreturn]] inline void contract_broken(const char* condition, const char* file, int line) {
  throw ContractError(fmt::format("{}:{}: contract broken: {}", file, line, condition));
}

}  // namespace drift

/// A precondition whose breach would touch memory that is not there; always on. Not for innermost
/// loops.
#define DRIFT_DEMAND(condition) \
  ((condition) ? void(0) : ::drift::contract_broken(#condition, __FILE__, __LINE__))

/// Any other precondition that only a mistake in this program can break; on in dev and asan builds.
#ifdef DRIFT_CONTRACTS
#define DRIFT_EXPECTS(condition) \
  ((condition) ? void(0) : ::drift::contract_broken(#condition, __FILE__, __LINE__))
#else
#define DRIFT_EXPECTS(condition) void(0)
#endif
