#pragma once
/// The program as a process that a test can watch and kill.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

namespace thinwall {

class ProgramProcess {
 public:
  /// Its stdout goes nowhere, its stderr to the file `notes`.
  ProgramProcess(std::vector<std::string> words, const std::string& notes) {
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0666);
    posix_spawn_file_actions_addopen(&actions, 2, notes.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    EXPECT_EQ(::posix_spawn(&child_, pointers[0], &actions, nullptr, pointers.data(), environ), 0);
    posix_spawn_file_actions_destroy(&actions);
  }
  ~ProgramProcess() {
    if (running()) end_with(SIGKILL);
  }
  ProgramProcess(const ProgramProcess&) = delete;
  ProgramProcess& operator=(const ProgramProcess&) = delete;

  bool running() { return !ended_ && !(ended_ = ::waitpid(child_, &status_, WNOHANG) == child_); }

  void signal(int number) const { ::kill(child_, number); }

  /// Its status as waitpid says it.
  int wait() {
    if (!ended_) ended_ = ::waitpid(child_, &status_, 0) == child_;
    return status_;
  }

  int end_with(int number) {
    signal(number);
    return wait();
  }

  /// Waits until `moment` or the end of the process; false if the end came first.
  template <class Moment> bool wait_until(const Moment& moment, std::chrono::microseconds pause) {
    while (!moment()) {
      if (!running()) return false;
      std::this_thread::sleep_for(pause);
    }
    return running();
  }

 private:
  pid_t child_ = 0;
  int status_ = 0;
  bool ended_ = false;
};

/// Under a sanitizer everything takes ten times as long.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool sanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace thinwall
