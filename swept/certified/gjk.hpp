#pragma once
/// Is the origin within reach of a convex polytope? The algorithm of Gilbert, Johnson and Keerthi (GJK) in integers.
///
/// It keeps a simplex of corners and the direction n of its point nearest to the origin, a multiple of it, so that nothing
/// is divided. Each round asks for the corner lowest along n:
///   - the simplex is within reach: touching;
///   - the corner's plane is beyond reach: apart, and that plane proves it;
///   - else the corner joins, and only the face nearest to the origin stays.
/// Every sign is exact, so the distance falls in each round, no simplex comes twice, no four corners lie in one plane, and it
/// ends. No tolerance, no limit of rounds.
/// Source: Gilbert, Johnson, Keerthi 1988; the budget of bits is derived in docs/certified.md.

#include <thinwall/swept/certified/integer_polytope.hpp>
#include <thinwall/swept/certified/simplex.hpp>

namespace thinwall {

/// True if the polytope and the ball of its reach about the origin share a point.
template <class Integer> bool touches_origin(const IntegerPolytope<Integer>& polytope) {
  Simplex<Integer> simplex(polytope.starts[0]);
  const Integer reach_square = polytope.reach * polytope.reach;
  while (true) {
    if (simplex.level == 0) return true;
    const Integer limit = reach_square == 0 ? Integer(0) : Integer(reach_square * dot(simplex.normal, simplex.normal));
    const auto is_beyond = [&](const Integer& level) { return level > 0 && (limit == 0 || level * level > limit); };
    if (!is_beyond(simplex.level)) return true;
    const Triple<Integer> corner = polytope.lowest_along(simplex.normal);
    if (is_beyond(dot(simplex.normal, corner))) return false;
    if (!simplex.add(corner)) return true;
  }
}

}  // namespace thinwall
