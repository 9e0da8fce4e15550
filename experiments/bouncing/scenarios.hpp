#pragma once
/// Impacts that come in crowds: at one instant, without end, or in tens of millions. Each has an answer of its own to be held
/// against; each is a row of the results and a test. Everything moves without gravity here but the ball on the floor.

#include <cstdint>
#include <string>
#include <vector>

#include <thinwall/experiments/bouncing/trials.hpp>

namespace thinwall {

struct BounceScenario {
  std::string name;      ///< what is done
  std::string must;      ///< what must happen
  std::string happened;  ///< what did
  bool passed = false;

  bool operator==(const BounceScenario&) const = default;
};

/// A ball dropped from 1 m at g = 2 m/s^2 with restitution 1/2 bounces at 1, 2, 2.5, 2.75, ... s, without end before 3 s.
/// Followed by steps of 1/4 s on the exact arc; the times are those of its impacts.
std::vector<double> zeno_times();
std::vector<BounceScenario> zeno_scenarios();

/// A ball that rests on the floor, for each policy, over 1e5 steps.
std::vector<BounceScenario> rest_scenarios();

/// A ball flies into a corner of two walls, and of three, and touches them at one instant; in every order of the walls.
std::vector<BounceScenario> corner_scenarios();

/// A ball between two walls with 2^-20 m of play, for a second at 1 m/s; and a point between a wall and one that closes in.
std::vector<BounceScenario> gap_scenarios();

/// A ball hits another head-on, `ratio` times as heavy; and the other way round.
std::vector<BounceScenario> mass_scenarios(const std::vector<double>& ratios);

/// Five touching balls in a row, and one, two or three of them come in.
std::vector<BounceScenario> cradle_scenarios();

struct BlockCount {
  std::int64_t impacts;
  /// [m^2/s] Of the path of (heavy, light) around the corner where all three touch: |x_heavy v_light - x_light v_heavy|. An impact
  /// only turns its sign, so that it stays what it was, 1. It is what the places say, where the speeds alone decide the count.
  double moment;
};

/// Impacts of a block that stands 1 m from a wall while one 100^digits times as heavy comes in at 1 m/s. S: float or double.
/// Error: right up to 5 digits in float and 7 in double, as measured.
template <class S> BlockCount count_block_impacts(int digits);
std::vector<BounceScenario> digit_scenarios(int most);

/// Lists of scenarios as the line that a run's journal keeps, and back. Throws std::runtime_error if it is not one.
std::string to_line(const std::vector<BounceScenario>& scenarios);
std::vector<BounceScenario> bounce_scenarios_from_line(const std::string& line);

}  // namespace thinwall
