#pragma once
/// The benchmark programs: which there are, where they lie, running one, what it said, and all rounds of one of its rows.

#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/lab/figure.hpp>
#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/lab/record.hpp>

namespace thinwall {

/// In the order of a round.
std::span<const std::string_view> bench_program_names();

/// bench/ of the build tree that this program lies in; where that does not exist, where it would be.
std::filesystem::path built_benchmarks();

/// True if the file can be run.
bool is_program(const std::filesystem::path& file);

/// A number that a program says, by its name.
struct Counter {
  std::string name;
  double value;
  static constexpr auto fields() { return record(kept("name", &Counter::name), kept("value", &Counter::value)); }
  bool operator==(const Counter&) const = default;
};

/// One row of Google Benchmark's: KIND/SUBJECT/WAY, such as time_of_impact/sphere_aabb/careful.
struct BenchRow {
  std::string kind, subject, way;
  double nanoseconds = 0;         ///< [ns] of the processor, an answer
  std::vector<Counter> counters;  ///< those of the suite: errors, floors

  static constexpr auto fields() {
    using B = BenchRow;
    return record(kept("kind", &B::kind), kept("subject", &B::subject), kept("way", &B::way),
                  kept("nanoseconds", &B::nanoseconds), kept("counters", &B::counters));
  }
};

/// Peers that are npm packages, as `peers` calls them where they are missing.
inline constexpr std::array<std::string_view, 5> npm_peers = {"Rapier", "Jolt", "PhysX", "Havok", "Box2D 3"};

/// What one start of a program said.
struct BenchOutput {
  std::string program;
  std::string missing;                      ///< why there are no rows; empty if the program ran
  std::vector<Counter> floors;              ///< of the machine, as the program measured them
  std::vector<std::string> peers_left_out;  ///< libraries that the program was built without
  std::vector<BenchRow> rows;

  static constexpr auto fields() {
    using B = BenchOutput;
    return record(kept("program", &B::program), kept("missing", &B::missing), kept("floors", &B::floors),
                  kept("peers_left_out", &B::peers_left_out), kept("rows", &B::rows));
  }
};

/// From what `program` wrote to --benchmark_out. Throws std::runtime_error, in one line, if that is not such JSON or a row of it
/// says that it failed.
BenchOutput bench_output_from_json(const std::string& program, const std::string& json);

struct BenchOptions {
  double seconds = 0.02;  ///< [s] each row is timed at least so long
  std::string filter;     ///< regular expression; empty: every row
};

/// Starts FOLDER/NAME and waits for it. One at a time in the whole process, so that none disturbs another. A program that is
/// not there gives an output that says so and what to do. Throws std::runtime_error, in one line, if it fails.
BenchOutput run_bench_program(const std::filesystem::path& folder, const std::string& name,
                              const BenchOptions& options);

/// All rounds of one row, and what follows from them.
struct TimedWay {
  std::string program, kind, subject, way;
  std::vector<double> nanoseconds = {};              ///< [ns] an answer, one of each round
  std::vector<double> floor_ns = {}, to_floor = {};  ///< of each round, where the program says them
  std::vector<double> call_ns = {};  ///< [ns] what calling another language takes, not in the time; so, too
  std::vector<Counter> errors = {};  ///< its other counters, in the first round
  bool errors_agree = true;          ///< the same in every round

  Measured time() const { return median_of_rounds(nanoseconds); }
  std::optional<double> error(std::string_view counter) const;  ///< where the row has it
  double wrong_verdicts() const { return error("missed").value_or(0) + error("false").value_or(0); }

  std::string name() const;    ///< what a picture calls it: "thinwall, careful", "Bullet, subsimplex cast"
  bool is_front_door() const;  ///< the program's own answer through it
  bool is_peer() const;        ///< another library answers
  bool must_be_right()
      const;  ///< our own, on queries where a wrong verdict has no excuse: not the ones made to be hard
};

/// The least and the most of numbers > 0.
struct Extremes {
  double least = std::numeric_limits<double>::infinity(), most = 0;

  void add(double x) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
  bool any() const { return most > 0; }
};

/// Names along an axis, the first at the far end: the last is at 1.
std::vector<Tic> tics_from_top(const std::vector<std::string>& names);

/// By program in the order of the suite, then as the program lists its rows.
std::vector<TimedWay> ways(const std::vector<BenchOutput>& rounds);

/// Asked for a time of impact, and its errors counted: what the picture shows, pair by pair. Of those of one name and pair, the
/// first.
std::vector<TimedWay> drawn_ways(const std::vector<TimedWay>& all);

/// The program's own answer through the front door, for the subject of `timed`; null if it is not there.
const TimedWay* front_door_for(const std::vector<TimedWay>& all, const TimedWay& timed);

// ---- What the benchmark of batches says: the picture of it, and a sentence.

/// What a row of a batch takes, by pair, scalar and width of vector; without panels where no batch was timed.
Figure batch_figure(const std::vector<TimedWay>& all);

/// A sentence on batches, after a space; empty where none was timed.
std::string batch_text(const std::vector<TimedWay>& all);

}  // namespace thinwall
