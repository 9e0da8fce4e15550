#pragma once
/// A run as a list of tasks whose results are records: units, their journal text and reading it back follow.
///
///   auto tasks = tasks_of(plan->cells, key, plan->shots, [plan](const Cell& cell) { return fire(cell, plan->seed); });
///   return make_run([plan](const Done<Tally>& done) { return outcome(*plan, done.results, done.seconds); }, std::move(tasks));
///
/// Several lists of tasks may follow each other, each with results of its own kind: `finish` then takes as many `Done`.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/lab/record.hpp>

namespace thinwall {

template <class Result> struct Task {
  std::string key;                  ///< unique in the run; neither tab nor newline
  std::int64_t trials = 1;          ///< for the progress bar and the estimate
  std::function<Result()> compute;  ///< thread-safe, and deterministic but for times; a type that `to_text` takes
  double seconds = 0;               ///< [s] about how long it takes, if it starts a program; 0: a try tells
};

/// One for each of these things, each of as many trials: `compute(thing)`. All are copied.
template <class Thing, class Key, class Compute>
auto tasks_of(const std::vector<Thing>& things, const Key& key, std::int64_t trials, const Compute& compute) {
  std::vector<Task<std::invoke_result_t<const Compute&, const Thing&>>> tasks;
  for (const Thing& thing : things) tasks.push_back({key(thing), trials, [=] { return compute(thing); }});
  return tasks;
}

/// What came of a list of tasks, in its order.
template <class Result> struct Done {
  std::vector<Result> results;
  std::vector<double> seconds;  ///< [s] that each took
};

template <class Finish, class... Results> class TaskRun final : public Run {
 public:
  TaskRun(Finish finish, std::vector<std::string> notes, std::vector<Task<Results>>... tasks)
      : finish_(std::move(finish)), notes_(std::move(notes)), tasks_(std::move(tasks)...) {}

  std::vector<Unit> units() const override {
    std::vector<Unit> units;
    const auto add = [&](const auto& tasks) {
      for (const auto& task : tasks)
        units.push_back({task.key, task.trials, [&task] { return to_text(task.compute()); }, task.seconds});
    };
    std::apply([&](const auto&... tasks) { (add(tasks), ...); }, tasks_);
    return units;
  }

  std::vector<std::string> notes() const override { return notes_; }

  Outcome finish(const std::vector<std::string>& results, const std::vector<double>& seconds) const override {
    std::size_t i = 0;
    const auto read = [&]<class Result>(const std::vector<Task<Result>>& tasks) {
      Done<Result> done;
      for (std::size_t j = 0; j < tasks.size(); ++j, ++i) {
        done.results.push_back(from_text<Result>(results[i]));
        done.seconds.push_back(seconds[i]);
      }
      return done;
    };
    return std::apply([&](const auto&... tasks) { return std::apply(finish_, std::tuple{read(tasks)...}); }, tasks_);
  }

 private:
  Finish finish_;
  std::vector<std::string> notes_;
  std::tuple<std::vector<Task<Results>>...> tasks_;
};

/// `finish(const Done<Results>&...)` gives the Outcome. What the functions need they own: they outlive the call.
template <class Finish, class... Results>
std::unique_ptr<Run> make_run(Finish finish, std::vector<Task<Results>>... tasks) {
  return std::make_unique<TaskRun<Finish, Results...>>(std::move(finish), std::vector<std::string>{},
                                                       std::move(tasks)...);
}

/// The same with what whoever started the run should know at once: see Run::notes.
template <class Finish, class... Results>
std::unique_ptr<Run> make_run(Finish finish, std::vector<std::string> notes, std::vector<Task<Results>>... tasks) {
  return std::make_unique<TaskRun<Finish, Results...>>(std::move(finish), std::move(notes), std::move(tasks)...);
}

}  // namespace thinwall
