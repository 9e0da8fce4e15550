#pragma once
/// The fifteen axes that may part two boxes, in five groups of three lanes: none before the others, and no jump between them.
/// Source: Ericson, Real-Time Collision Detection, 2005, section 4.4.1.

#include <thinwall/discrete/clear/vectors.hpp>

namespace thinwall {

/// A box of half extents a, and one of half extents b: of whose axes `rows` are the numbers along each of the first one's.
struct ClearBoxAxes {
  packed::Vectors<packed::Lanes> rows;
  packed::Lanes a, b;
  packed::Lanes noise;  ///< [length] of every place and reach

  /// No number of the rows is so small, and not zero, that its products with lengths would underflow and part what overlaps.
  THINWALL_HOT bool in_range() const {
    const auto is_plain = [](const packed::Lanes& x) {
      return (packed::all(0x1p-500) <= abs(x)) | (abs(x) <= packed::all(0));
    };
    return all_of(is_plain(rows.x) & is_plain(rows.y) & is_plain(rows.z));
  }

  /// visit(along, reach, noise) of each group: `along` gives the part of a vector, spread, along the three axes, `reach` how far both boxes
  /// reach along them together. The axes are a's, b's, and each of a's crossed with b's, which are not of unit length and may have none.
  template <class Visit> THINWALL_HOT void each_group(const Visit& visit) const {
    using packed::Lanes;
    using Vectors = packed::Vectors<Lanes>;
    const Vectors wide = abs(rows), A = spread(a);
    const Lanes b1 = yzx(b), b2 = yzx(b1);
    visit([](const Vectors& d) { return lanes(firsts(xy_of(d.x), xy_of(d.y)), xy_of(d.z)); },
          a + dot(packed::transposed(wide.x, wide.y, wide.z), spread(b)), noise);
    visit([&](const Vectors& d) { return dot(d, rows); }, b + dot(A, wide), noise);
    const auto products = [&](const auto& along, const Lanes& ry, const Lanes& rz, const Lanes& ay, const Lanes& az) {
      const Lanes y = abs(ry), z = abs(rz), minor = abs(ry * yzx(rz) - rz * yzx(ry));
      visit(along, (ay * z + az * y) + (b1 * minor + b2 * yzx(yzx(minor))), noise * (y + z));
    };
    products([&](const Vectors& d) { return d.z * rows.y - d.y * rows.z; }, rows.y, rows.z, A.y, A.z);
    products([&](const Vectors& d) { return d.x * rows.z - d.z * rows.x; }, rows.z, rows.x, A.z, A.x);
    products([&](const Vectors& d) { return d.y * rows.x - d.x * rows.y; }, rows.x, rows.y, A.x, A.y);
  }
};

}  // namespace thinwall
