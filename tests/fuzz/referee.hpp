#pragma once
/// What the experiments' oracle, which shares no code with the library, says of two moving shapes at any time and precision.

#include <limits>

#include <thinwall/experiments/models/oracle.hpp>
#include "fuzz/judge.hpp"

namespace thinwall::fuzz {

template <class R> class Referee {
 public:
  using Vec = oracle::Vec<R>;

  explicit Referee(const Exhibit& exhibit)
      : problem_(std::visit(
            [&](const auto& a, const auto& b) {
              return oracle::pose<R>(Moving{a, exhibit.displacement_a}, Moving{b, exhibit.displacement_b});
            },
            exhibit.a, exhibit.b)) {
    problem_.reach += R(exhibit.min_separation);
  }

  struct State {
    R gap = 0;      ///< [length] < 0: the least translation that parts the two
    R closing = 0;  ///< [length] per step
    R scale = 0;    ///< [length] what one round-off is measured by
    R margin =
        0;  ///< [1] gap over scale; of two that overlap, along the direction in which the fewest round-offs part them
  };

  State at(const R& time) const {
    const oracle::Gap<R> apart = oracle::gap_at(problem_, time, tolerance());
    const R gap = apart.core - problem_.reach;
    const State outside{gap, apart.closing, apart.scale, over(gap, apart.scale)};
    return apart.core > touch() * size_at(time) ? outside : inside(time);
  }

  oracle::Impact<R> first_contact(const R& guess) const { return oracle::first_contact(problem_, guess, tolerance()); }

  /// The state at the first time in [from, 1] at which the two are nearest or deepest.
  State deepest(const R& from) const {
    R low = from, high = 1;
    if (at(high).closing > 0) return at(high);
    for (int round = 0; round < 4000 && high - low > tolerance() * high; ++round) {
      using std::sqrt;
      const R middle = low > 0 && high > 4 * low ? R(sqrt(low * high))
                       : low == 0 && round < 40  ? R(high / 1048576)
                                                 : R((low + high) / 2);
      if (middle == low || middle == high) break;
      (at(middle).closing > 0 ? low : high) = middle;
    }
    return at(high);
  }

  /// The separation along a direction: at most at().gap, and equal to it along the right one.
  R separation_along(const R& time, const Vec& normal) const {
    const Vec offset = oracle::combination(R(1), problem_.offset, time, problem_.motion);
    return oracle::dot(normal, offset) - problem_.support(normal) - problem_.reach * oracle::dot(normal, normal);
  }

  /// [length] the sum of all numbers that a computation at `time` adds up: bounds the rounding of a point in space.
  R size_at(const R& time) const {
    R size = problem_.reach;
    for (std::size_t i = 0; i < 3; ++i) size += problem_.start_size[i] + time * problem_.speed_size[i];
    return size;
  }

  R reach() const { return problem_.reach; }
  R path() const {
    using std::sqrt;
    return sqrt(oracle::dot(problem_.motion, problem_.motion));
  }
  /// [1] Cores this near, beside the numbers involved, meet: what is left of their distance is rounding.
  static R touch() { return std::numeric_limits<R>::digits > 100 ? R(ldexp(R(1), -90)) : R(ldexp(R(1), -54)); }
  static R tolerance() { return std::numeric_limits<R>::digits > 100 ? R(ldexp(R(1), -150)) : R(ldexp(R(1), -58)); }

 private:
  /// The cores meet: out along the normal of least depth, over all pairs of edges.
  State inside(const R& time) const {
    const Vec offset = oracle::combination(R(1), problem_.offset, time, problem_.motion);
    State best;
    R margin = 0;
    bool found = false;
    oracle::for_each_face(oracle::edges_of(problem_), [&](const Vec& n) {
      const R distance = oracle::dot(n, offset) - problem_.support(n), scale = problem_.scale(time, n);
      const R here = over(R(distance - problem_.reach), scale);
      if (!found || here > margin) margin = here;
      if (found && distance <= best.gap) return;
      found = true;
      best = {distance, R(-oracle::dot(n, problem_.motion)), scale, R(0)};
    });
    best.gap = (best.gap < 0 ? best.gap : R(0)) - problem_.reach;
    if (!found) best.scale = size_at(time);
    best.margin = found ? (margin < 0 ? margin : R(0)) : over(best.gap, best.scale);
    return best;
  }

  static R over(const R& gap, const R& scale) { return scale > 0 ? R(gap / scale) : gap; }

  oracle::Problem<R> problem_;
};

}  // namespace thinwall::fuzz
