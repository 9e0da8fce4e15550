#pragma once
/// The axes of a box; and the fifteen that may part two boxes, in five groups of three lanes: none before the others, and no jump between
/// them.
/// Source: Ericson, Real-Time Collision Detection, 2005, section 4.4.1.

#include <array>
#include <bit>
#include <cstddef>
#include <limits>

#include <thinwall/discrete/clear/vectors.hpp>

namespace thinwall {

/// The axes of a box. They are clear if they are orthonormal to a few roundings, as those of a quaternion are that nothing has turned often. How
/// a face leans then, whose normal is across its edges and not quite its axis, counts by all of its length.
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
  /// Of each axis along the next one.
  THINWALL_HOT packed::Lanes lean() const {
    return dot(rows, packed::Vectors<packed::Lanes>{yzx(rows.x), yzx(rows.y), yzx(rows.z)});
  }
  THINWALL_HOT packed::LanesMask clear() const {
    return abs(squares - packed::all(1)) + abs(lean()) * packed::all(4) <= packed::all(0x1p-48);
  }
  /// No face of half extents h leans by more than u of all sizes along its axis: a place p and the box.
  THINWALL_HOT bool is_straight(const packed::Lanes& h, const packed::Lanes& p) const {
    const packed::Vectors<packed::Lanes> H = spread(h);
    return all_of(leaning(abs(lean()), h) <=
                  sizes_along(abs(p) + ((abs(x) * H.x + abs(y) * H.y) + abs(z) * H.z)) * packed::all(0x1p-53));
  }
  /// By how much less than along its axis a place in the box's own axes is along the normal of each face, which is across the other two.
  THINWALL_HOT packed::Lanes leaning(const packed::Lanes& place) const { return leaning(lean(), place); }
  /// Over their lengths.
  THINWALL_HOT packed::Lanes per_length() const { return packed::all(1.5) - squares * packed::all(0.5); }
  /// Vectors in the box's own axes, and one of these in the world's.
  THINWALL_HOT packed::Lanes into(const packed::Lanes& v) const { return dot(rows, spread(v)); }
  THINWALL_HOT packed::Lanes into(const Vec3<double>& v) const { return dot(rows, packed::spread(v)); }
  /// Of each axis of another box, what this one's have along it.
  THINWALL_HOT packed::Vectors<packed::Lanes> into(const ClearFrame& other) const {
    return {dot(rows, packed::spread(other.numbers)), dot(rows, packed::spread(other.numbers + 3)),
            dot(rows, packed::spread(other.numbers + 6))};
  }
  THINWALL_HOT packed::Lanes out_of(const packed::Lanes& v) const {
    const packed::Vectors<packed::Lanes> part = spread(v);
    return (x * part.x + y * part.y) + z * part.z;
  }
  /// How far each axis reaches along n, of numbers that all count.
  THINWALL_HOT packed::Lanes sizes_along(const packed::Lanes& n) const { return dot(abs(rows), spread(abs(n))); }
  THINWALL_HOT packed::Lanes axis(int i) const { return packed::lanes(numbers + 3 * static_cast<std::ptrdiff_t>(i)); }

 private:
  THINWALL_HOT static packed::Lanes leaning(const packed::Lanes& off, const packed::Lanes& place) {
    return off * yzx(place) + yzx(yzx(off * place));
  }
};

/// A box that is not turned, as ClearFrame is one that is.
struct ClearUpright {
  static constexpr bool is_turned = false;
  THINWALL_HOT static packed::LanesMask clear() { return packed::mask(true, true, true); }
  THINWALL_HOT static packed::Lanes per_length() { return packed::all(1); }
  THINWALL_HOT static packed::Lanes into(const packed::Lanes& v) { return v; }
  THINWALL_HOT static packed::Lanes out_of(const packed::Lanes& v) { return v; }
  THINWALL_HOT static packed::Lanes sizes_along(const packed::Lanes& n) { return abs(n); }
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
  THINWALL_HOT packed::LanesMask in_range() const {
    const auto is_plain = [](const packed::Lanes& x) {
      return (packed::all(0x1p-500) <= abs(x)) | (abs(x) <= packed::all(0));
    };
    return is_plain(rows.x) & is_plain(rows.y) & is_plain(rows.z);
  }

  /// Of these of the fifteen, by their bits as ClearAxis has them, the one face of a that all are normal to but for roundings, as of boxes that
  /// lie level; else all of them. If one of b's is among them, a's that is level with it is, too: noise is more than they differ by. A short
  /// product may lean to a's face: but not so that it parts more than that and the face beside it.
  THINWALL_HOT unsigned one_axis_of(unsigned axes) const {
    if ((axes & (axes - 1U)) == 0U) [[likely]]
      return axes;
    const int i = std::countr_zero(axes | 4U);
    const packed::Lanes level = packed::all(0x1p-51), along = dot(rows, spread(ClearUpright::axis(i)));
    const unsigned across = bits(abs(along) <= level), its = ~across & 7U;
    const packed::Lanes own = only(packed::lowest(its), rows);  // of a's axes along that one of b's
    const unsigned products = (across * 0x49U & ~(7U << 3 * i)) << 6U;
    const bool is_level = packed::is_one_axis(its) == 1U && bits(abs(own) <= level) == (7U & ~(1U << i)) &&
                          (axes & ~(1U << i | its << 3U | products)) == 0U;
    return is_level ? 1U << i : axes;
  }

  /// visit(along, reach, noise, square) of each group: `along` gives the part of a vector, spread, along the three axes, `reach` how
  /// far both boxes reach along them together, `square` the square of their lengths. The axes are a's, b's, and each of a's crossed
  /// with b's, which are not of unit length and may have none.
  template <class Visit> THINWALL_HOT void each_group(const Visit& visit) const {
    each_group_of_faces(visit);
    each_group_of_products(visit);
  }
  template <class Visit> THINWALL_HOT void each_group_of_faces(const Visit& visit) const {
    using Vectors = packed::Vectors<packed::Lanes>;
    const Vectors wide = abs(rows), A = spread(a);
    visit([](const Vectors& d) { return lanes(firsts(xy_of(d.x), xy_of(d.y)), xy_of(d.z)); },
          a + dot(packed::transposed(wide.x, wide.y, wide.z), spread(b)), noise, packed::all(1));
    visit([&](const Vectors& d) { return dot(d, rows); }, b + dot(A, wide), noise, packed::all(1));
  }
  template <class Visit> THINWALL_HOT void each_group_of_products(const Visit& visit) const {
    using Vectors = packed::Vectors<packed::Lanes>;
    const Vectors A = spread(a);
    products(
        visit, [&](const Vectors& d) { return d.z * rows.y - d.y * rows.z; }, rows.y, rows.z, A.y, A.z);
    products(
        visit, [&](const Vectors& d) { return d.x * rows.z - d.z * rows.x; }, rows.z, rows.x, A.z, A.x);
    products(
        visit, [&](const Vectors& d) { return d.y * rows.x - d.x * rows.y; }, rows.x, rows.y, A.x, A.y);
  }

 private:
  template <class Visit, class Along>
  THINWALL_HOT void products(const Visit& visit, const Along& along, const packed::Lanes& ry, const packed::Lanes& rz,
                             const packed::Lanes& ay, const packed::Lanes& az) const {
    const packed::Lanes b1 = yzx(b), b2 = yzx(b1), y = abs(ry), z = abs(rz), minor = abs(ry * yzx(rz) - rz * yzx(ry));
    visit(along, (ay * z + az * y) + (b1 * minor + b2 * yzx(yzx(minor))), noise * (y + z), y * y + z * z);
  }
};

/// How far two such boxes, `between` apart, overlap on the fifteen axes.
struct ClearOverlaps {
  packed::LanesMask parted, shared;       ///< beyond all noise: apart on one of them, and not so on any
  packed::Lanes overlaps[5], squares[5];  ///< [length] times the length of each axis, and of that length
  packed::Lanes noise;                    ///< [length]

  THINWALL_HOT ClearOverlaps(const ClearBoxAxes& boxes, const packed::Lanes& between)
      : parted(packed::all(1) < packed::all(0)), shared(packed::all(0) <= packed::all(0)), noise(boxes.noise) {
    using packed::Lanes;
    int group = 0;
    boxes.each_group([this, d = spread(between), &group](const auto& along, const Lanes& reach, const Lanes& rounding,
                                                         const Lanes& square) {
      add(group++, reach - abs(along(d)), rounding, square);
    });
  }
  THINWALL_HOT bool apart() const { return any_of(parted); }
  THINWALL_HOT bool within() const { return all_of(shared); }

  struct Least {
    packed::Pair overlap;  ///< [length] below 0 where they are apart
    unsigned axes;         ///< the bits, as ClearAxis has them, of those on which it may be so small
  };
  /// Along axes of unit length. They are off by noise, and three halves of it on a product.
  THINWALL_HOT Least least() const {
    using packed::Lanes, packed::all;
    constexpr double none = std::numeric_limits<double>::infinity();
    Lanes lengths[5] = {overlaps[0], overlaps[1]};
    for (int i = 2; i < 5; ++i) lengths[i] = select(all(0) < squares[i], overlaps[i] / root(squares[i]), all(none));
    const Lanes smallest = min(min(lengths[0], lengths[1]), min(min(lengths[2], lengths[3]), lengths[4]));
    Least least{smallest_of(smallest), 0};
    const Lanes bound = all(least.overlap) + noise * all(3);
    for (unsigned i = 0; i < 5; ++i) least.axes |= bits(lengths[i] <= bound) << 3U * i;
    return least;
  }

 private:
  THINWALL_HOT void add(int group, const packed::Lanes& overlap, const packed::Lanes& rounding,
                        const packed::Lanes& square) {
    parted = parted | (overlap < packed::all(0) - rounding);
    shared = shared & (rounding <= overlap);
    overlaps[group] = overlap, squares[group] = square;
  }
};

/// One of the fifteen axes, without a jump: 0 to 2 are those of a, 3 to 5 those of b, then their products, first by a's.
struct ClearAxis {
  double own, its;          ///< 1 if it is one of a's own, or of b's
  unsigned edge_a, edge_b;  ///< the bits of a's axis and of b's for a product, else 0
  int a, b;                 ///< the axes of a and of b, from 0
  int first, second;        ///< the two edges it is across: both a's or b's, or one of each
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
                   static_cast<int>(product ? i : (i + 1) % 3),
                   static_cast<int>(product ? j : (j + 2) % 3),
                   true};
      }
      return of_k;
    }();
    const bool alone = (axes & (axes - 1U)) == 0U;
    return all_of_them[alone ? static_cast<unsigned>(std::countr_zero(axes | 1U << 15U)) : 15U];
  }
};

}  // namespace thinwall
