#pragma once
/// Where a swept core lies, apart from the ball about the origin or touching it, by GJK in double whose every exit is a
/// proof: a plane, a point of the simplex, or a tetrahedron around the origin. Rounding may lead it astray; then it gives up.
/// Constants: docs/certified.md.

#include <thinwall/swept/certified/crossing_proof.hpp>

namespace thinwall {

enum class Position { apart, touching, unknown };

struct PositionProof {
  Position position = Position::unknown;
  Vec3<double> normal = Vec3<double>::Zero();  ///< of the last plane tried, that which parts them if `apart`
};

inline Vec3<double> to_vector(const Triple<double>& x) { return {x[0], x[1], x[2]}; }

/// The point of the simplex' nearest face that is nearest to the origin.
inline Vec3<double> nearest_of(const Simplex<double>& simplex) {
  const Vec3<double> a = to_vector(simplex.corners[0]);
  if (simplex.count == 1) return a;
  const Vec3<double> ab = to_vector(simplex.corners[1]) - a;
  if (simplex.count == 2) return a + ab * std::clamp(-a.dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  const Vec3<double> ac = to_vector(simplex.corners[2]) - a, n = cross(ab, ac);
  const double square = n.squaredNorm();
  const double beta = std::clamp(cross(ac, a).dot(n) / square, 0.0, 1.0);
  const double gamma = std::clamp(cross(a, ab).dot(n) / square, 0.0, 1.0 - beta);
  return (a + ab * beta) + ac * gamma;
}

/// True if the origin is inside the tetrahedron, whose corners are off by up to 20 u of `size`.
inline bool holds_origin(const Simplex<double>& simplex, const Vec3<double>& size) {
  const auto side = [&](std::size_t i, std::size_t j, std::size_t k) {
    return to_vector(simplex.corners[i]).dot(cross(to_vector(simplex.corners[j]), to_vector(simplex.corners[k])));
  };
  const double error = 6 * 80 * roundoff_unit * (size[0] * size[1] * size[2]) + 0x1p-900;
  const double sides[] = {side(1, 2, 3), -side(0, 2, 3), side(0, 1, 3), -side(0, 1, 2)};
  const auto beyond = [&](double sign) {
    return std::all_of(std::begin(sides), std::end(sides), [&](double x) { return sign * x > error; });
  };
  return beyond(1) || beyond(-1);
}

/// The core swept over [0, time], n the first plane to try.
template <class Core> PositionProof position_proof(const Core& core, double time, const Vec3<double>& n) {
  constexpr double u = roundoff_unit, tiny = 0x1p-900;
  constexpr int most_rounds = 32;  // of a guess: what is left is decided exactly
  const Vec3<double> sweep = core.v * time, size = core.size + sweep.cwiseAbs();
  PositionProof proof{Position::unknown, n};
  Simplex<double> simplex({0, 0, 0});
  for (int round = 0; round < most_rounds; ++round) {
    const double length = std::sqrt(proof.normal.squaredNorm());
    if (!(length > 0)) return proof;
    proof.normal /= length;
    Triple<double> corner = core.lowest_corner(proof.normal);
    if (proof.normal.dot(sweep) < 0) {
      for (int i = 0; i < 3; ++i) corner[static_cast<std::size_t>(i)] += sweep[i];
    }
    const double level = proof.normal.dot(to_vector(corner));
    const double error = u * (28 * size_along(proof.normal, size) + 8 * core.R) + tiny;
    if (level - core.R > error) {
      proof.position = Position::apart;
      return proof;
    }
    if (round == 0) {
      simplex = Simplex<double>(corner);
    } else if (!(level < proof.normal.dot(to_vector(simplex.corners[0])) - error)) {
      return proof;  // no nearer than rounding
    } else if (!simplex.add(corner)) {
      if (simplex.count == 4 && holds_origin(simplex, size)) proof.position = Position::touching;
      return proof;
    }
    if (is_within(nearest_of(simplex), core.R, size, 64)) {
      proof.position = Position::touching;
      return proof;
    }
    proof.normal = to_vector(simplex.normal);
  }
  return proof;
}

}  // namespace thinwall
