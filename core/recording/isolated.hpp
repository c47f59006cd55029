#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "core/recording/recording_problems.hpp"
#include "core/recording/recording_raw.hpp"

namespace drift {

/// Takes what a reader finds in a file, in a child process, and hands it to the parent.
class RawSink {
 public:
  RawSink(int pipe, std::string file) : pipe_(pipe), problems_(std::move(file)) {}

  void fact(std::string_view key, std::string_view value);
  void unit(std::string_view column, std::string_view unit);  ///< before or after its column
  void column(std::string_view name, std::span<const double> values);
  Problems& problems() { return problems_; }
  void finish();

 private:
  void send(const void* data, std::size_t bytes);
  void send(std::string_view text);

  int pipe_;
  Problems problems_;
};

/// Runs a reader of a foreign binary format in a child process with limits on memory and CPU time:
/// the HDF5 and MATLAB libraries can crash or loop on damaged files (HDF5 #5375), and the user is
/// owed a message then. Whatever ends the child early becomes a problem "the file is damaged".
RawRecording read_isolated(
    const std::string& path, Problems& problems,
    const std::function<void(const std::string& path, RawSink& sink)>& reader);

/// Runs a writer in a child process, for the same reason and because HDF5 cannot let go of a file
/// on a full disk. Returns what went wrong, empty if nothing.
std::string write_isolated(const std::function<std::string()>& writer);

}  // namespace drift
