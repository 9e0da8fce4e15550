#pragma once
/// All rounds of one row, and what follows from them.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <thinwall/experiments/speed/bench_output.hpp>
#include <thinwall/experiments/statistics.hpp>

namespace thinwall {

struct Contender {
  std::string program, kind, subject, way;
  std::vector<double> nanoseconds;         ///< [ns] an answer, one of each round
  std::vector<double> floor_ns, to_floor;  ///< of each round, where the program says them
  std::map<std::string, double> errors;    ///< its other counters, in the first round
  bool errors_agree = true;                ///< the same in every round
};

struct ContenderTime {
  double median;
  Interval interval;  ///< 95 %, bootstrap
};

/// By program in the order of the suite, then as the program lists its rows.
std::vector<Contender> contenders(const std::vector<BenchOutput>& rounds);

ContenderTime time_of(const Contender& contender);

/// The counter, where the row has it.
std::optional<double> error_of(const Contender& contender, const std::string& counter);

/// What a picture calls it: "thinwall, kernel", "Bullet, subsimplex cast".
std::string name_of(const Contender& contender);

/// True for what another library answers.
bool is_peer(const Contender& contender);

/// Asked for a time of impact, and its errors counted: what the picture shows, pair by pair. Of those of one name and pair, the
/// first.
std::vector<const Contender*> drawn_contenders(const std::vector<Contender>& all);

/// The program's own answer through the front door, for the subject of `contender`; null if it is not there.
const Contender* front_door_for(const std::vector<Contender>& all, const Contender& contender);

}  // namespace thinwall
