#pragma once
/// The axes of a box; and the fifteen that may part two boxes, in five groups of three lanes: none before the others, and no jump between
/// them.
/// Source: Ericson, Real-Time Collision Detection, 2005, section 4.4.1.

#include <array>
#include <bit>
#include <cstddef>

#include <thinwall/discrete/clear/vectors.hpp>

namespace thinwall {

/// The axes of a box. They are clear if they are orthonormal to a few roundings, as those are that nothing has turned often.
struct ClearFrame {
  static constexpr bool is_turned = true;
  const double* numbers;
  packed::Lanes x, y, z;
  packed::Vectors<packed::Lanes> rows;  ///< of each of the world's axes, what the box's have along it
  packed::Lanes squares;                ///< of the axes' lengths

  THINWALL_HOT explicit ClearFrame(const Mat3<double>& m)
      : numbers(m.data()),
        x(packed::lanes(numbers)),
        y(packed::lanes(numbers + 3)),
        z(packed::lanes(numbers + 6)),
        rows(packed::transposed(x, y, z)),
        squares(dot(rows, rows)) {}
  THINWALL_HOT bool clear() const {
    const packed::Vectors<packed::Lanes> next{yzx(rows.x), yzx(rows.y), yzx(rows.z)};
    return all_of(abs(squares - packed::all(1)) + abs(dot(rows, next)) * packed::all(4) <= packed::all(0x1p-49));
  }
  /// Over their lengths.
  THINWALL_HOT packed::Lanes per_length() const { return packed::all(1.5) - squares * packed::all(0.5); }
  /// Vectors in the box's own axes, and one of these in the world's.
  THINWALL_HOT packed::Lanes into(const packed::Lanes& v) const { return dot(rows, spread(v)); }
  THINWALL_HOT packed::Lanes out_of(const packed::Lanes& v) const {
    const packed::Vectors<packed::Lanes> part = spread(v);
    return (x * part.x + y * part.y) + z * part.z;
  }
  THINWALL_HOT packed::Lanes axis(int i) const { return packed::lanes(numbers + 3 * static_cast<std::ptrdiff_t>(i)); }
};

/// A box that is not turned, as ClearFrame is one that is.
struct ClearUpright {
  static constexpr bool is_turned = false;
  THINWALL_HOT static bool clear() { return true; }
  THINWALL_HOT static packed::Lanes per_length() { return packed::all(1); }
  THINWALL_HOT static packed::Lanes into(const packed::Lanes& v) { return v; }
  THINWALL_HOT static packed::Lanes out_of(const packed::Lanes& v) { return v; }
  THINWALL_HOT static packed::Lanes axis(int i) {
    return keep(packed::lowest(1U << static_cast<unsigned>(i)), packed::all(1));
  }
};

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

  /// visit(along, reach, noise, square) of each group: `along` gives the part of a vector, spread, along the three axes, `reach` how
  /// far both boxes reach along them together, `square` the square of their lengths. The axes are a's, b's, and each of a's crossed
  /// with b's, which are not of unit length and may have none.
  template <class Visit> THINWALL_HOT void each_group(const Visit& visit) const {
    using packed::Lanes;
    using Vectors = packed::Vectors<Lanes>;
    const Vectors wide = abs(rows), A = spread(a);
    const Lanes b1 = yzx(b), b2 = yzx(b1);
    visit([](const Vectors& d) { return lanes(firsts(xy_of(d.x), xy_of(d.y)), xy_of(d.z)); },
          a + dot(packed::transposed(wide.x, wide.y, wide.z), spread(b)), noise, packed::all(1));
    visit([&](const Vectors& d) { return dot(d, rows); }, b + dot(A, wide), noise, packed::all(1));
    const auto products = [&](const auto& along, const Lanes& ry, const Lanes& rz, const Lanes& ay, const Lanes& az) {
      const Lanes y = abs(ry), z = abs(rz), minor = abs(ry * yzx(rz) - rz * yzx(ry));
      visit(along, (ay * z + az * y) + (b1 * minor + b2 * yzx(yzx(minor))), noise * (y + z), y * y + z * z);
    };
    products([&](const Vectors& d) { return d.z * rows.y - d.y * rows.z; }, rows.y, rows.z, A.y, A.z);
    products([&](const Vectors& d) { return d.x * rows.z - d.z * rows.x; }, rows.z, rows.x, A.z, A.x);
    products([&](const Vectors& d) { return d.y * rows.x - d.x * rows.y; }, rows.x, rows.y, A.x, A.y);
  }
};

/// One of the fifteen axes, without a jump: 0 to 2 are those of a, 3 to 5 those of b, then their products, first by a's.
struct ClearAxis {
  double own, its;          ///< 1 if it is one of a's own, or of b's
  unsigned edge_a, edge_b;  ///< the bits of a's axis and of b's for a product, else 0
  int a, b;                 ///< the axes of a and of b, from 0
  bool alone;               ///< not of the last, which stands for several at once

  /// The axis of the one bit set in `axes`; not `alone` if there are more, or none.
  THINWALL_HOT static const ClearAxis& of(unsigned axes) {
    static constexpr auto all_of_them = [] {
      std::array<ClearAxis, 16> of_k{};
      for (unsigned k = 0; k < 15; ++k) {
        const unsigned i = k < 6 ? k % 3 : k / 3 - 2, j = k % 3;
        const bool product = k >= 6;
        of_k[k] = {k < 3 ? 1.0 : 0.0,
                   k >= 3 && k < 6 ? 1.0 : 0.0,
                   product ? 1U << i : 0U,
                   product ? 1U << j : 0U,
                   static_cast<int>(i),
                   static_cast<int>(j),
                   true};
      }
      return of_k;
    }();
    const bool alone = (axes & (axes - 1U)) == 0U;
    return all_of_them[alone ? static_cast<unsigned>(std::countr_zero(axes | 1U << 15U)) : 15U];
  }
};

}  // namespace thinwall
