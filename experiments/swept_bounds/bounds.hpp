#pragma once
/// The bounds that the balls are put to: what the library makes of a moving shape, and its exact answer.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/swept_bounds/obstacles.hpp>
#include <thinwall/experiments/swept_bounds/tally.hpp>

namespace thinwall {

/// What a run of a clock is about.
enum class TimedWork {
  build,    ///< make the bound, once a moving shape and step
  test,     ///< put every ball to the bound
  exact,    ///< put every ball to the closed form: the price of a hit, false or true
  pipeline  ///< put every ball to the bound, and to the closed form if it is reported
};

struct SweptBound {
  std::string name;
  bool makes_volume;  ///< and asks what overlaps it; else it asks the moving shape itself, and has no false hits
  std::function<bool(SweptForm)> serves;
  std::function<FittedBody(const Sweep&)> body;
  std::function<SweepTally(const Sweep&, std::uint64_t seed, std::int64_t shots)> ask_all;
  std::function<bool(const Sweep&, const Sphere<double>&)> reports;
  /// Goes `passes` times through the balls; returns how many were reported. Nothing else is done in that time.
  std::function<std::int64_t(TimedWork, const Sweep&, std::span<const Sphere<double>>, int passes)> repeat;
};

std::vector<std::string_view> swept_bound_names();
std::vector<SweptBound> swept_bounds_named(std::span<const std::string> names);  ///< in the list's own order

}  // namespace thinwall
