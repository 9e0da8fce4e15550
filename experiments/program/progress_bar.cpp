#include <thinwall/experiments/program/progress_bar.hpp>

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {
namespace {

/// 1234567 as 1.2 M.
std::string short_text(double count) {
  for (const auto& [size, letter] : {std::pair{1e12, "T"}, {1e9, "G"}, {1e6, "M"}, {1e3, "k"}}) {
    if (count >= size) return rounded_text(count / size, count / size < 10 ? 2 : 3) + " " + letter;
  }
  return rounded_text(count, 3);
}

}  // namespace

bool stderr_is_terminal() {
  const char* const term = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && term != nullptr && std::string_view(term) != "dumb";
}

std::string progress_line(const Progress& progress, double seconds) {
  constexpr int width = 24;
  const bool weighed = progress.trials > 0;  // units differ in size: their trials tell more than their number
  const double all = weighed ? static_cast<double>(progress.trials) : static_cast<double>(progress.units);
  const double done = weighed ? static_cast<double>(progress.trials_done) : static_cast<double>(progress.units_done);
  const double share = all > 0 ? std::min(done / all, 1.0) : 1;
  const int filled = static_cast<int>(share * width);
  std::string line = fmt::format("[{:=>{}}{:>{}}] {:3.0f} %  {} trials", "", filled, "", width - filled, 100 * share,
                                 short_text(static_cast<double>(progress.trials_done)));
  const double now = static_cast<double>(progress.trials_done - progress.trials_resumed);
  if (now > 0 && seconds > 0) {
    const double rate = now / seconds, left = static_cast<double>(progress.trials - progress.trials_done) / rate;
    line += fmt::format("  {}/s  {} left", short_text(rate), duration_text(left));
  }
  return line;
}

void ProgressBar::show(const Progress& progress) {
  constexpr auto pause = std::chrono::milliseconds(100);
  const auto now = Clock::now();
  if (!enabled_ || (drawn_ && now - last_ < pause && progress.units_done < progress.units)) return;
  drawn_ = true;
  last_ = now;
  const std::string line = progress_line(progress, std::chrono::duration<double>(now - start_).count());
  std::fprintf(stderr, "\r%s\x1b[K", line.c_str());
  std::fflush(stderr);
}

void ProgressBar::erase() { std::fputs("\r\x1b[K", stderr); }

ProgressBar::~ProgressBar() {
  if (drawn_) erase();
}

}  // namespace thinwall
