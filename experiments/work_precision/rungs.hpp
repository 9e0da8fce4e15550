#pragma once
/// The settings that each method is raced with: its rungs, from rough to fine along its option, if it has one.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <thinwall/experiments/work_precision/race_options.hpp>
#include <thinwall/swept/methods.hpp>

namespace thinwall {

template <class Method> struct Rung {
  Method method;
  std::string label;             ///< "tolerance 1e-06"; empty for a method without an option
  std::optional<double> option;  ///< its value
};

template <class Method>
concept HasTolerance = requires(const Method& method) { method.tolerance; };
template <class Method>
concept HasPoses = requires(const Method& method) { method.n; };

template <class Method, class S> std::vector<Rung<Method>> rungs(const Ladder& ladder) {
  std::vector<Rung<Method>> all;
  if constexpr (HasTolerance<Method>) {
    for (const double tolerance : ladder.tolerances) {
      if (!is_tolerance(static_cast<S>(tolerance))) continue;
      Method method;
      method.tolerance = static_cast<S>(tolerance);
      all.push_back({method, fmt::format("tolerance {:g}", tolerance), tolerance});
    }
  } else if constexpr (HasPoses<Method>) {
    for (const std::int64_t n : ladder.poses) {
      Method method;
      method.n = static_cast<int>(n);
      all.push_back({method, fmt::format("n {}", n), static_cast<double>(n)});
    }
  } else {
    all.push_back({Method{}, "", {}});
  }
  return all;
}

}  // namespace thinwall
