#pragma once
/// What an experiment is: a name, a question, a default configuration, and one function that answers.
/// An experiment reads its settings, computes, and returns an `Outcome`; it writes no file and prints nothing.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/lab/figure.hpp>
#include <thinwall/experiments/lab/table.hpp>

namespace thinwall {

class Settings;  // experiments/lab/settings.hpp: typed, checked access to one TOML file

/// A named piece of work small enough to be lost: a cell of a factorial design, usually.
/// Its result is a line of text that the run's journal keeps, so that an interrupted run can resume.
struct Unit {
  std::string key;                       ///< unique in the run and free of tabs and newlines
  std::int64_t trials;                   ///< for the progress bar and the estimate
  std::function<std::string()> compute;  ///< thread-safe; deterministic, but for times; free of newlines
  double seconds = 0;                    ///< [s] about how long it takes, if it starts a program; 0: a try tells
};

struct Section {
  std::string heading;
  std::string text;       ///< plain paragraphs, separated by a blank line
  std::string link = {};  ///< what they lead to, seen from the result's folder; may be empty
};

/// A file that is neither table nor figure: a recording, for one.
struct TextFile {
  std::string name;  ///< of the file, in the result folder itself
  std::string text;
};

struct Outcome {
  std::string answer;                  ///< the question's answer in a sentence or two, with its numbers
  std::string summary;                 ///< a table for the terminal, plain text, at most 100 columns
  std::vector<Table> tables;           ///< in the order the report shows them
  std::vector<Figure> figures;         ///< the first one is the headline
  std::vector<Section> sections = {};  ///< method, oracle, self-test, limits
  bool self_test_passed = true;
  std::vector<TextFile> files = {};
};

/// A configured run. `units` is fixed by the settings and the seed alone.
class Run {
 public:
  virtual ~Run() = default;
  virtual std::vector<Unit> units() const = 0;
  /// What whoever started it should know at once, such as what is left out and why: a line each, for stderr.
  virtual std::vector<std::string> notes() const { return {}; }
  /// `results[i]` is what `units()[i].compute` returned, `seconds[i]` how long it took.
  virtual Outcome finish(const std::vector<std::string>& results, const std::vector<double>& seconds) const = 0;
};

struct RunOptions {
  std::uint64_t seed = 0;
  std::optional<std::int64_t> trials;  ///< > 0: overrides the settings' own
  int threads = 1;                     ///< >= 1: for a run whose units have parts; of no effect on any result
};

struct Experiment {
  std::string_view name;          ///< as on the command line
  std::string_view question;      ///< one sentence, ends with a question mark
  std::string_view default_toml;  ///< the whole commented file, embedded at build
  std::unique_ptr<Run> (*configure)(const Settings&, const RunOptions&);  ///< throws UsageError
};

}  // namespace thinwall
