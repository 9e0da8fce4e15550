#pragma once
/// The program as its users start it: in a process, in a folder of its own.

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <boost/core/noncopyable.hpp>

namespace thinwall {

// ---- A folder that lasts as long as a test, and what lies in it.

class TemporaryFolder : boost::noncopyable {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "thinwall-test-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code none;
    std::filesystem::remove_all(path_, none);
  }

  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

inline std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

/// In a folder that is made if it is not there.
inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out << text;
  ASSERT_TRUE(out.flush()) << file;
}

/// Every file below `folder` and its content, by relative path.
inline std::map<std::string, std::string> files_in(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[entry.path().lexically_relative(folder).generic_string()] = read_text(entry.path());
  }
  return files;
}

inline void write_script(const std::filesystem::path& file, const std::string& body) {
  write_text(file, "#!/bin/sh\n" + body + "\n");
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
}

inline bool gnuplot_is_there() { return std::system("command -v gnuplot >/dev/null") == 0; }

// ---- The program as a process that a test can watch and kill.

class ProgramProcess : boost::noncopyable {
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

  bool running() { return !ended_ && !(ended_ = ::waitpid(child_, &status_, WNOHANG) == child_); }

  void signal(int number) const { ::kill(child_, number); }

  /// Its exit code, or minus the signal that ended it.
  int wait() {
    if (!ended_) ended_ = ::waitpid(child_, &status_, 0) == child_;
    return WIFSIGNALED(status_) ? -WTERMSIG(status_) : WEXITSTATUS(status_);
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

/// The number in `goes on: 12 of 34 units are done`, which a run that goes on says on a line of its own; 0 if it does not.
inline long units_read(const std::string& said) {
  const std::string_view begin = "goes on: ";
  const auto note = said.find(begin);
  return note == std::string::npos ? 0 : std::stol(said.substr(note + begin.size()));
}

// ---- The headline experiment in small, for tests of the program as it is: many units, every kind of file, in half a second.

inline constexpr const char* small_wall = R"(experiment = "thin_wall"
shots = 600
speed = [10, 200]
step = [0.016666666666666666]
radius = [0.001, 0.02]
thickness = [0.01]
angle_deg = [0, 60]
)";

/// Everything in a result folder that must not differ from run to run: the date in cite.bib may.
inline std::map<std::string, std::string> lasting_files(const std::filesystem::path& folder) {
  auto files = files_in(folder);
  for (const char* name : {"data/timings.csv", "report.html", "manifest.json"})
    EXPECT_EQ(files.erase(name), 1u) << name;
  const std::string& cite = files["cite.bib"];
  EXPECT_NE(cite.find("@misc{"), std::string::npos) << cite;
  files["cite.bib"] = cite.substr(0, cite.find("  date   = ", cite.find("@misc{")));
  return files;
}

}  // namespace thinwall
