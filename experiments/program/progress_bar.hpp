#pragma once
/// How far a run has come, on a terminal; nothing is printed where stderr is none.

#include <chrono>
#include <string>

#include <thinwall/experiments/run/runner.hpp>

namespace thinwall {

/// True if stderr is a terminal that can redraw a line (TERM is not `dumb`).
bool stderr_is_terminal();

/// One line of at most 79 letters: bar, share, trials, rate and time left.
std::string progress_line(const Progress& progress, double seconds);

class ProgressBar {
 public:
  explicit ProgressBar(bool enabled) : enabled_(enabled) {}
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);
  static void erase();

 private:
  using Clock = std::chrono::steady_clock;
  bool enabled_, drawn_ = false;
  Clock::time_point start_ = Clock::now(), last_;
};

}  // namespace thinwall
