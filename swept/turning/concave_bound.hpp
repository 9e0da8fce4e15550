#pragma once
/// A gap between two turning shapes, bounded from below by a function of which the first root is known: all that a step of
/// conservative advancement asks for.

#include <algorithm>
#include <array>
#include <limits>

#include <thinwall/discrete/scalar.hpp>

namespace thinwall {

/// gap(t + tau) >= gap + slope tau - max over i of (corner_i + corner_slope_i tau) - sum over k of |edge_k + edge_slope_k tau|
///                 - curvature tau^2 / 2,
/// the rounding of it paid for. Concave in tau: the least of finitely many parabolas, all open downward.
template <Scalar S> struct ConcaveBound {
  S gap, slope;     ///< [length], [length] per step
  S curvature = 0;  ///< [length] per step squared, >= 0
  int edges = 0;    ///< in use, of the sum: half a box's edges, or a rod's core, times the plane's normal
  int corners = 0;  ///< in use, of the maximum: a triangle's; none is a maximum of 0
  std::array<S, 6> edge, edge_slope;
  std::array<S, 3> corner, corner_slope;

  void add_edge(const S& value, const S& change) {
    edge[static_cast<std::size_t>(edges)] = value;
    edge_slope[static_cast<std::size_t>(edges++)] = change;
  }
  void add_corner(const S& value, const S& change) {
    corner[static_cast<std::size_t>(corners)] = value;
    corner_slope[static_cast<std::size_t>(corners++)] = change;
  }
};

/// Where a bound starts, and how far it is positive.
template <Scalar S> struct FirstRoot {
  S value;  ///< [length] at the start
  S slope;  ///< [length] per step, there
  S tau;    ///< [1] >= 0: positive before; 0 where it is not at the start, and no more than what was asked for
};

/// The first root of one of the maximum's lines. If it is positive at the end as well it has none, being concave. If not: the root of the
/// parabola that is active at the start; where the signs of the absolute values are others there, the parabola with those lies below, and its
/// root is nearer. Roots only come nearer, and there are no more than edges + 1 of them.
template <Scalar S>
THINWALL_HOT FirstRoot<S> first_root_of_line(const ConcaveBound<S>& bound, S value, S slope, const S& end) {
  using std::sqrt;
  const auto count = static_cast<std::size_t>(bound.edges);
  S at_end = value + end * (slope - end * bound.curvature / S(2));
  for (std::size_t k = 0; k < count; ++k) at_end -= largest(S(bound.edge[k] + bound.edge_slope[k] * end));
  std::array<bool, 6> negative;
  for (std::size_t k = 0; k < count; ++k) {
    negative[k] = bound.edge[k] < S(0);
    value -= largest(bound.edge[k]);
    slope -= negative[k] ? -bound.edge_slope[k] : bound.edge_slope[k];
  }
  FirstRoot<S> first{value, slope, S(0)};
  if (!(value > S(0))) return first;
  if (at_end > S(0)) {
    first.tau = end;
    return first;
  }
  for (std::size_t round = 0; round <= count + 1; ++round) {
    const S root = sqrt(slope * slope + S(2) * bound.curvature * value);
    const S tau = slope < S(0)             ? S(2) * value / (root - slope)
                  : bound.curvature > S(0) ? (slope + root) / bound.curvature
                                           : std::numeric_limits<S>::infinity();
    first.tau = std::min(end, tau);
    bool same = true;
    for (std::size_t k = 0; k < count; ++k) {
      const S then = bound.edge[k] + bound.edge_slope[k] * first.tau;
      if (negative[k] ? !(then > S(0)) : !(then < S(0))) continue;
      const S twice = negative[k] ? S(-2) : S(2);
      value += twice * bound.edge[k];
      slope += twice * bound.edge_slope[k];
      negative[k] = !negative[k];
      same = false;
    }
    if (same) return first;
  }
  first.tau = S(0);  // rounding went in a circle
  return first;
}

/// How far the bound is positive, `end` [1] at most. Error: tau is off by a few units in the last place, to either side.
template <Scalar S> FirstRoot<S> first_root(const ConcaveBound<S>& bound, const S& end) {
  if (bound.corners == 0) return first_root_of_line(bound, bound.gap, bound.slope, end);
  FirstRoot<S> first{std::numeric_limits<S>::infinity(), S(0), end};
  for (std::size_t i = 0; i < static_cast<std::size_t>(bound.corners); ++i) {
    const FirstRoot<S> of_line =
        first_root_of_line<S>(bound, bound.gap - bound.corner[i], bound.slope - bound.corner_slope[i], first.tau);
    if (of_line.value < first.value) {
      first.value = of_line.value;
      first.slope = of_line.slope;
    }
    first.tau = of_line.tau;
  }
  return first;
}

}  // namespace thinwall
