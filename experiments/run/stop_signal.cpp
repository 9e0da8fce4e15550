#include <thinwall/experiments/run/stop_signal.hpp>

#include <csignal>
#include <utility>

namespace thinwall {
namespace {

volatile std::sig_atomic_t requested = 0;

void request_stop(int) {
  requested = 1;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

}  // namespace

void watch_for_stop() {
  requested = 0;
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
}

bool stop_requested() { return requested != 0; }

StopGuard::StopGuard(std::chrono::milliseconds patience, std::function<void()> end)
    : thread_([this, patience, end = std::move(end)] { watch(patience, end); }) {}

StopGuard::~StopGuard() {
  {
    const std::scoped_lock lock(mutex_);
    done_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void StopGuard::watch(std::chrono::milliseconds patience, const std::function<void()>& end) {
  constexpr std::chrono::milliseconds look(50);  // a signal handler may set a flag, but not wake a thread
  std::unique_lock lock(mutex_);
  const auto done = [this] { return done_; };
  while (!changed_.wait_for(lock, look, done)) {
    if (!stop_requested()) continue;
    if (!changed_.wait_for(lock, patience, done)) end();
    return;
  }
}

}  // namespace thinwall
