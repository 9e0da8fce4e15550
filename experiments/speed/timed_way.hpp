#pragma once
/// All rounds of one row, and what follows from them.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <thinwall/experiments/speed/bench_output.hpp>
#include <thinwall/experiments/statistics.hpp>

namespace thinwall {

struct TimedWay {
  std::string program, kind, subject, way;
  std::vector<double> nanoseconds;         ///< [ns] an answer, one of each round
  std::vector<double> floor_ns, to_floor;  ///< of each round, where the program says them
  std::map<std::string, double> errors;    ///< its other counters, in the first round
  bool errors_agree = true;                ///< the same in every round
};

struct WayTime {
  double median;
  Interval interval;  ///< 95 %, bootstrap
};

/// By program in the order of the suite, then as the program lists its rows.
std::vector<TimedWay> ways(const std::vector<BenchOutput>& rounds);

WayTime time_of(const TimedWay& timed);

/// The counter, where the row has it.
std::optional<double> error_of(const TimedWay& timed, const std::string& counter);

/// What a picture calls it: "thinwall, kernel", "Bullet, subsimplex cast".
std::string name_of(const TimedWay& c);

/// True for what another library answers.
bool is_peer(const TimedWay& c);

/// Asked for a time of impact, and its errors counted: what the picture shows, pair by pair. Of those of one name and pair, the
/// first.
std::vector<const TimedWay*> drawn_ways(const std::vector<TimedWay>& all);

/// The program's own answer through the front door, for the subject of `timed`; null if it is not there.
const TimedWay* front_door_for(const std::vector<TimedWay>& all, const TimedWay& timed);

}  // namespace thinwall
