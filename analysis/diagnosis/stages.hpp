#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace drift::diagnosis {

/// Told how far a diagnosis is: the stage, and the part of the whole that is done (0 .. 1). From
/// any thread.
using StageReport = std::function<void(const std::string& stage, double done)>;

/// The stages of a diagnosis: how long each took, and how far the whole is by the shares that they
/// usually have.
class Stages {
 public:
  Stages(std::vector<std::pair<std::string, double>>& seconds, StageReport report)
      : seconds_(seconds), report_(std::move(report)), last_(Clock::now()) {}

  /// Begins a stage that takes `share` of the whole; what was begun before is done.
  void begin(std::string name, double share) {
    end();
    const std::scoped_lock lock(guard_);
    name_ = std::move(name);
    share_ = share;
    tell(0.0);
  }
  /// A part of the present stage is done. Thread-safe.
  void step(std::size_t done, std::size_t total) {
    const std::scoped_lock lock(guard_);
    if (total > 0) tell(static_cast<double>(done) / static_cast<double>(total));
  }
  /// The last stage begun is done.
  void end() {
    const std::scoped_lock lock(guard_);
    const auto now = Clock::now();
    if (!name_.empty()) {
      seconds_.emplace_back(name_, std::chrono::duration<double>(now - last_).count());
      before_ += share_;
      share_ = 0.0;
      tell(0.0);
      name_.clear();
    }
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  void tell(double part) const {
    if (report_) report_(name_, std::min(1.0, before_ + part * share_));
  }
  std::vector<std::pair<std::string, double>>& seconds_;
  StageReport report_;
  Clock::time_point last_;
  std::mutex guard_;
  std::string name_;
  double share_ = 0.0, before_ = 0.0;
};

}  // namespace drift::diagnosis
