#pragma once
/// Ctrl-C and SIGTERM as a question that a long loop asks.

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace thinwall {

/// From now on SIGINT and SIGTERM only set a flag. A second one ends the program at once.
void watch_for_stop();

/// True once one of them has come.
bool stop_requested();

/// Ends the program if a stop is requested while this lives and it still lives `patience` later: for work that asks too
/// seldom, and that loses nothing it has counted by such an end.
class StopGuard {
 public:
  /// `end` is called on a thread of its own, and should not return.
  StopGuard(std::chrono::milliseconds patience, std::function<void()> end);
  ~StopGuard();
  StopGuard(const StopGuard&) = delete;
  StopGuard& operator=(const StopGuard&) = delete;

 private:
  void watch(std::chrono::milliseconds patience, const std::function<void()>& end);

  std::mutex mutex_;
  std::condition_variable changed_;
  bool done_ = false;
  std::thread thread_;
};

}  // namespace thinwall
