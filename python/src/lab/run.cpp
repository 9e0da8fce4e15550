#include "lab.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/manifest.hpp>
#include <thinwall/experiments/lab/runner.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/program/command.hpp>
#include <thinwall/experiments/program/run.hpp>

namespace thinwall {

namespace {

namespace py = pybind11;
namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto look = 50ms;       // at Ctrl-C and at the progress
constexpr auto patience = 500ms;  // for a unit to end after Ctrl-C; one may be long

// ---- A run works on a thread of its own; whoever asked for it waits, and looks now and then whether Python wants something.

struct Job {
  RunWish wish;
  std::vector<std::string> argv;
  std::ostringstream out, err;
  std::atomic<bool> stop = false;

  std::mutex mutex;  // of what follows
  std::condition_variable changed;
  Progress progress = {};
  bool ended = false;
  int status = exit_done;
  std::exception_ptr failure = {};

  bool wait(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, time, [this] { return ended; });
  }
};
using JobPtr = std::shared_ptr<Job>;

std::atomic<int> at_work = 0;

/// Before what a job may use is torn down. What it was computing is lost; what it had finished is in its journal.
void leave(int status, void*) {
  if (at_work == 0) return;
  std::fflush(nullptr);
  std::_Exit(status);
}

void work(const JobPtr& job) {
  int status = exit_failed;
  std::exception_ptr failure;
  try {
    status = perform_run(job->wish, {experiments(), job->argv, job->out, job->err});
  } catch (const std::exception&) {
    failure = std::current_exception();
  }
  const std::scoped_lock lock(job->mutex);
  job->status = status;
  job->failure = failure;
  job->ended = true;
  --at_work;
  job->changed.notify_all();
}

void start(const JobPtr& job) {
  [[maybe_unused]] static const int once = ::on_exit(leave, nullptr);
  ++at_work;
  std::thread(work, job).detach();
}

/// Waits with the GIL released. Throws what a signal handler or `progress` raised.
void wait_for(Job& job, const py::object& progress) {
  std::int64_t told = -1;
  for (bool ended = false; !ended;) {
    Progress now;
    {
      const py::gil_scoped_release others;
      ended = job.wait(look);
      const std::scoped_lock lock(job.mutex);
      now = job.progress;
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (progress.is_none() || now.units == 0 || now.trials_done == told) continue;
    told = now.trials_done;
    progress(now.trials_done, now.trials);
  }
}

/// Jobs that were told to stop within a long unit. They end with it, and the unit is kept; until then they hold their folder.
std::vector<JobPtr>& stopping() {
  static std::vector<JobPtr> jobs;  // guarded by the GIL
  return jobs;
}

bool is_same_folder(const std::string& a, const std::string& b) {
  return fs::weakly_canonical(fs::absolute(a)) == fs::weakly_canonical(fs::absolute(b));
}

void wait_until_free(const std::string& folder) {
  const std::vector<JobPtr> jobs = stopping();
  for (const JobPtr& job : jobs) {
    if (is_same_folder(job->wish.out, folder)) wait_for(*job, py::none());
  }
  std::erase_if(stopping(), [](const JobPtr& job) { return job->wait(0ms); });
}

/// The same call has the same folder, and another call another one.
std::string folder_of(const RunWish& wish) {
  const ConfiguredRun chosen = configure_run(wish.target, wish.request, experiments());
  return (fs::path("results") / (chosen.name + "-" + run_id(chosen.record))).string();
}

/// Returns the folder, and what there is to know of the run, line by line.
std::pair<std::string, std::string> run(RunWish wish, std::vector<std::string> argv, const py::object& progress) {
  const auto job = std::make_shared<Job>();
  if (wish.out.empty()) {
    const py::gil_scoped_release others;
    wish.out = folder_of(wish);
  }
  wait_until_free(wish.out);
  wish.launch = Launch{};
  Job& told = *job;
  wish.watch = RunWatch{.stop = [&told] { return told.stop.load(); },
                        .on_progress =
                            [&told](const Progress& now) {
                              const std::scoped_lock lock(told.mutex);
                              told.progress = now;
                            }};
  job->wish = std::move(wish);
  job->argv = std::move(argv);
  start(job);
  try {
    wait_for(*job, progress);
  } catch (const py::error_already_set&) {
    job->stop = true;
    bool ended = false;
    {
      const py::gil_scoped_release others;
      ended = job->wait(patience);
    }
    if (!ended) stopping().push_back(job);
    throw;
  }
  if (job->failure) std::rethrow_exception(job->failure);
  return {job->wish.out, job->err.str()};
}

}  // namespace

void bind_run(py::module_& module) {
  module.def(
      "run",
      [](const std::string& target, std::optional<std::string> text, bool compare, std::uint64_t seed,
         std::optional<std::int64_t> trials, std::optional<int> threads, const std::string& out,
         std::vector<std::string> argv, const py::object& progress) {
        RunWish wish;
        wish.target = target;
        wish.request.text = std::move(text);
        wish.request.compare = compare;
        wish.request.options = {seed, trials, threads ? *threads : default_threads()};
        wish.out = out;
        return run(std::move(wish), std::move(argv), progress);
      },
      py::arg("target"), py::arg("text"), py::arg("compare"), py::arg("seed"), py::arg("trials"), py::arg("threads"),
      py::arg("out"), py::arg("argv"), py::arg("progress"));
  module.def("experiments", [] {
    std::vector<std::pair<std::string, std::string>> all;
    for (const Experiment& each : experiments()) all.emplace_back(each.name, each.question);
    return all;
  });
  module.def(
      "spelling_hint",
      [](const std::string& word, const std::vector<std::string>& names) {
        return spelling_hint(word, std::vector<std::string_view>(names.begin(), names.end()));
      },
      py::arg("word"), py::arg("names"));
  module.def(
      "default_toml",
      [](const std::string& name) {
        for (const Experiment& each : experiments()) {
          if (each.name == name) return std::string(each.default_toml);
        }
        return std::string();
      },
      py::arg("name"));
}

}  // namespace thinwall
