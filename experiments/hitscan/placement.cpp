#include <thinwall/experiments/hitscan/placement.hpp>

#include <cmath>
#include <limits>

#include <boost/math/tools/toms748_solve.hpp>

namespace thinwall {

namespace {

using Real = long double;

/// Where a function that is negative at the one end and positive at the other is zero.
template <class Function> Real root(const Function& f, const Real& lower, const Real& upper) {
  const boost::math::tools::eps_tolerance<Real> tolerance(std::numeric_limits<Real>::digits - 2);
  std::uintmax_t most = 200;
  const auto bracket = boost::math::tools::toms748_solve(f, lower, upper, tolerance, most);
  return bracket.first + (bracket.second - bracket.first) / 2;
}

/// The arc, seen from the target's center: in its plane, and how far beside that plane the center is.
struct ArcFromTarget {
  Arc<Real> arc;
  Real range, along, beside_squared, reach;

  /// Of the distance from the target's center: its square less that of contact.
  Real excess(const Real& x) const {
    const Real s = at_distance(arc, x).s - along, ahead = x - range;
    return ahead * ahead + s * s + beside_squared - reach * reach;
  }
  /// The sign of its slope.
  Real slope(const Real& x) const {
    const auto p = at_distance(arc, x);
    return (x - range) + (p.s - along) * p.vs / p.vx;
  }
  bool passes_beside() const {
    const Real low = at_distance(arc, Real(range - reach)).s, high = at_distance(arc, Real(range + reach)).s;
    return beside_squared > reach * reach || along < low - reach || along > high + reach;
  }
};

}  // namespace

Placement random_placement(const HitscanCell& c, const RandomStream& stream, std::uint64_t trial) {
  const double disc = disc_radius(c);
  const Vec3<double> on_arc = pull_direction(c) * deflection(c);
  for (std::uint64_t draw = 0;; ++draw) {
    const RandomWords words = random_words(stream, trial, draw);
    const double y = (2 * uniform(words[1]) - 1) * disc, z = (2 * uniform(words[2]) - 1) * disc;
    if (y * y + z * z > disc * disc) continue;
    const bool around_arc = uniform(words[3]) < 0.5;
    const Vec3<double> across = Vec3<double>(0, y, z) + (around_arc ? on_arc : Vec3<double>(0, 0, 0));
    if (around_arc && across.squaredNorm() <= disc * disc) continue;  // what both discs hold comes from the first alone
    return {{across + Vec3<double>(c.range, 0, 0), c.target}, uniform(words[0])};
  }
}

TrueImpact true_impact(const HitscanCell& c, const Vec3<double>& target_center) {
  const Vec3<Real> pull = pull_direction(c).cast<Real>(), center(0, target_center[1], target_center[2]);
  const Real along = center.dot(pull), reach = Real(c.target) + Real(c.radius);
  const ArcFromTarget seen = {arc_of<Real>(c), target_center[0], along, (center - pull * along).squaredNorm(), reach};
  if (seen.passes_beside()) return {false};
  const Real first = seen.range - reach, last = seen.range + reach;
  Real closest = seen.slope(first) >= 0 ? first : last;
  if (seen.slope(first) < 0 && seen.slope(last) > 0) {
    closest = root([&](const Real& x) { return seen.slope(x); }, first, last);
  }
  if (seen.excess(closest) > 0) return {false};
  const Real entry =
      seen.excess(first) <= 0 ? first : root([&](const Real& x) { return seen.excess(x); }, first, closest);
  const Real s = at_distance(seen.arc, entry).s;
  const Vec3<Real> bullet = Vec3<Real>(entry, 0, 0) + pull * s;
  return {true, static_cast<double>(time_to(seen.arc, entry)), bullet.cast<double>()};
}

Vec3<double> contact_point(const HitscanCell& c, const TrueImpact& truth, const Vec3<double>& target_center) {
  return target_center + (truth.bullet - target_center) * (c.target / reach(c));
}

}  // namespace thinwall
