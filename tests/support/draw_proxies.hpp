#pragma once
/// Random worlds of boxes, drawn to hit what goes wrong in a broad phase.

#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <thinwall/discrete/broad_phase/proxy.hpp>

#include "support/shaker.hpp"

namespace thinwall::testing {

/// Lattice coordinates (ties and touching boxes), points, plates, sizes decades apart, one place for all, far outliers,
/// infinite boxes, worlds far from the origin; now and then static, masked and skipped bodies.
inline std::vector<Proxy> drawn_proxies(Shaker<double>& draw, int most) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const int count = draw.pick(0, most), style = draw.pick(0, 9), roles = draw.pick(0, 2);
  const double extent = std::ldexp(1.0, draw.pick(0, 5)), far_off = draw.pick(0, 3) == 0 ? std::ldexp(1.0, 40) : 0;
  std::vector<Proxy> proxies(static_cast<std::size_t>(count));
  for (Proxy& p : proxies) {
    Vec3<double> corner = draw.vector() * extent;
    Vec3<double> sides = draw.sizes();
    const int chance = draw.pick(0, 15), axis = draw.pick(0, 2);
    if (style == 0) corner.setZero();                                                    // all at one point
    if (style == 1) sides.setZero();                                                     // points
    if (style == 2) sides *= std::ldexp(1.0, draw.pick(-40, 12));                        // sizes decades apart
    if (style == 3 && chance == 0) corner[axis] = std::ldexp(1.0, draw.pick(60, 1020));  // bodies that escaped
    if (style == 4) sides[axis] = chance < 8 ? 0 : 1000;                                 // plates and rods
    if (style == 5) corner[axis] = 0;                                                    // mostly flat
    if (style == 6) {  // on a lattice of touching cubes
      corner = {double(draw.pick(-2, 2)), double(draw.pick(-2, 2)), double(draw.pick(-2, 2))};
      sides.setOnes();
    }
    if (style == 7) sides *= std::ldexp(1.0, -300), corner *= std::ldexp(1.0, -300);  // tiny
    if (style == 8) sides *= std::ldexp(1.0, 1000), corner *= std::ldexp(1.0, 1000);  // huge
    p.low = corner.array() + far_off;
    p.high = p.low + sides;
    if (style == 9 && chance == 0) p.high[axis] = infinity;
    if (style == 9 && chance == 1) p.low[axis] = -infinity;
    if (style == 9 && chance == 2) p.low.setConstant(infinity), p.high.setConstant(infinity);
    if (style == 9 && chance == 3) p.low.setConstant(-infinity), p.high.setConstant(infinity);
    if (roles == 0) continue;
    p.is_static = draw.pick(0, 3) == 0;
    p.skipped = draw.pick(0, 7) == 0;
    if (p.skipped && draw.pick(0, 1) == 0) p.low[axis] = std::numeric_limits<double>::quiet_NaN();
    if (roles == 1) continue;
    p.group = static_cast<std::uint32_t>(draw.pick(0, 3));
    p.mask = static_cast<std::uint32_t>(draw.pick(0, 3));
  }
  return proxies;
}

inline std::string describe(const std::vector<Proxy>& proxies) {
  std::ostringstream out;
  out.precision(17);
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    const Proxy& p = proxies[i];
    out << i << ": low " << p.low.transpose() << " high " << p.high.transpose() << " group " << p.group << " mask "
        << p.mask << (p.is_static ? " static" : "") << (p.skipped ? " skipped" : "") << "\n";
  }
  return out.str();
}

}  // namespace thinwall::testing
