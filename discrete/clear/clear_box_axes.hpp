#pragma once
/// The fifteen axes that may part two boxes, in five groups of three lanes: none before the others, and no jump between them.
/// Source: Ericson, Real-Time Collision Detection, 2005, section 4.4.1.

#include <thinwall/discrete/clear/lanes.hpp>

namespace thinwall {

/// A vector, and each of its numbers in every lane.
struct ClearSpread {
  packed::Lanes v, x, y, z;

  THINWALL_HOT explicit ClearSpread(const packed::Lanes& a)
      : v(a), x(all(firsts(xy_of(a)))), y(all(seconds(xy_of(a)))), z(all(zz_of(a))) {}
};

/// A box of half extents a, and one of half extents b whose axes are the columns of `rows` in those of the first.
struct ClearBoxAxes {
  packed::Lanes row[3];
  packed::Lanes a, b;
  packed::Lanes noise;  ///< [length] of every place and reach

  /// No number of the rows is so small, and not zero, that its products with lengths would underflow and part what overlaps.
  THINWALL_HOT bool in_range() const {
    const auto is_plain = [](const packed::Lanes& x) {
      return (packed::all(0x1p-500) <= abs(x)) | (abs(x) <= packed::all(0));
    };
    return all_of(is_plain(row[0]) & is_plain(row[1]) & is_plain(row[2]));
  }

  /// visit(along, reach, noise) of each group: `along` gives a vector's part along the three axes, `reach` how far both boxes reach
  /// along them together. The axes are a's, b's, and each of a's crossed with b's, which are not of unit length and may have none.
  template <class Visit> THINWALL_HOT void each_group(const Visit& visit) const {
    using packed::Lanes;
    const Lanes abs0 = abs(row[0]), abs1 = abs(row[1]), abs2 = abs(row[2]), b1 = yzx(b), b2 = yzx(b1);
    const ClearSpread A(a);
    visit([](const ClearSpread& d) { return d.v; }, a + lanes(two_sums(b * abs0, b * abs1), sum(b * abs2)), noise);
    visit([&](const ClearSpread& d) { return (d.x * row[0] + d.y * row[1]) + d.z * row[2]; },
          b + ((A.x * abs0 + A.y * abs1) + A.z * abs2), noise);
    const auto products = [&](const auto& along, const Lanes& ry, const Lanes& rz, const Lanes& ay, const Lanes& az) {
      const Lanes y = abs(ry), z = abs(rz), minor = abs(ry * yzx(rz) - rz * yzx(ry));
      visit(along, (ay * z + az * y) + (b1 * minor + b2 * yzx(yzx(minor))), noise * (y + z));
    };
    products([&](const ClearSpread& d) { return d.z * row[1] - d.y * row[2]; }, row[1], row[2], A.y, A.z);
    products([&](const ClearSpread& d) { return d.x * row[2] - d.z * row[0]; }, row[2], row[0], A.z, A.x);
    products([&](const ClearSpread& d) { return d.y * row[0] - d.x * row[1]; }, row[0], row[1], A.x, A.y);
  }
};

}  // namespace thinwall
