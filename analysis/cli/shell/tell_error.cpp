#include "analysis/cli/shell/tell_error.hpp"

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <new>

#include "analysis/cli/print.hpp"
#include "core/base/check.hpp"

namespace drift::cli {
namespace {

ExitCode told(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const InputError& e) {
    for (const auto& message : e.messages()) complain("error: {}\n", message);
    return e.code();
  } catch (const OutputLost& e) {
    complain("error: standard output: {}. Results are incomplete; make room and run again\n",
             e.code().message());
  } catch (const std::filesystem::filesystem_error& e) {
    complain("error: {}: {} (expected a path that can be used). Check it and its permissions\n",
             e.path1().string(), e.code().message());
  } catch (const std::bad_alloc&) {
    complain(
        "error: the memory is used up (expected more, or a smaller job). Make the plan or the "
        "recording shorter, use fewer threads, or run where there is more\n");
  } catch (const std::system_error& e) {
    complain("error: the system refuses: {} (expected more of what it is short of). Run again\n",
             e.what());
  } catch (const std::exception& e) {
    complain("internal error: {}\nThis is a bug in driftscope; please report it.\n", e.what());
    return ExitCode::internal;
  }
  return ExitCode::io;
}

/// The reader of standard output has seen enough: nothing to tell.
bool is_closed_pipe(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const OutputLost& e) {
    return e.code() == std::errc::broken_pipe;
  } catch (...) {
    return false;
  }
}

}  // namespace

int tell_error(const std::exception_ptr& error) {
  if (is_closed_pipe(error)) return 128 + SIGPIPE;
  std::fflush(stdout);  // results before words; if that fails, what went wrong first is told
  return static_cast<int>(told(error));
}

}  // namespace drift::cli
