#pragma once
/// The clear cases of a moving segment and a triangle, rounded by R: of a moving point and the prism { y - w d }, y in the triangle, w in
/// [0, 1], which the triangle sweeps along the segment d backwards.
///
/// The prism is entered by a face that the motion leads into, or by an edge or a corner of such a face: the normal of a place is of the cone
/// of the faces that meet there, and leads against the motion. So those faces are asked alone, as in clear_flat.hpp: first the one whose plane
/// is entered last. The distance to a convex body is convex: what is R apart, closes, has all of the prism behind the gap, and began apart, is
/// the first contact. And what passes one of their edges on its outer side, beyond which no such face lies, passes the prism.
///
/// Where the triangle's normal N and the segment agree, N.d > 0, the prism's faces look along N, against it, and along each edge x d; across
/// each of them the prism is N.d thick. Most misses are told by these: one of the planes parts the two from the start to the end of the step.
/// Source: derived here; the five faces are those of capsule_triangle_entry.hpp.

#include <array>
#include <bit>

#include <thinwall/capsule/clear_segment_triangle.hpp>
#include <thinwall/swept/clear/clear_flat.hpp>

namespace thinwall {

/// The prism, with the planes of its sides, and in the last lane that of the triangle.
struct ClearPrism : ClearSegmentTriangle {
  std::array<packed::Lanes, 3> corner, edge;  ///< of the triangle, each edge from its corner on
  packed::Vectors<packed::Lanes> normals;     ///< across each edge and d, and the triangle; out of the prism
  packed::PairMask leans;                     ///< the segment leans against the triangle

  THINWALL_HOT ClearPrism(const packed::Lanes& e1, const packed::Lanes& e2, const packed::Lanes& core)
      : ClearSegmentTriangle(e1, e2, core), corner{packed::all(0), e1, e2}, edge{e1, e2 - e1, packed::all(0) - e2} {
    using packed::both;
    const packed::Pair sign = select(thick < both(0), both(-1), both(1));
    const auto sides = cross(face.edges(), packed::spread(d));
    normals = packed::with_last(sides, yzx(face.n)) * all(sign);
    leans = face.nn * dot(d, d) * both(0x1p-40) <= thick * thick;
  }

  /// A side, or of 3 the triangle.
  THINWALL_HOT ClearFlat flat(unsigned k) const {
    return k < 3 ? ClearFlat::parallelogram(edge[k], packed::all(0) - d) : ClearFlat::triangle(face);
  }
};

/// First time at which p + v t is within R > 0 of the prism; `q` is p + d, rounded once.
struct ClearPrismEntry {
  bool clear = false;
  packed::Pair time = packed::both(ClearEntry::never);  ///< [1] >= 0, twice; ClearEntry::never for a miss
  packed::Lanes normal{}, on{};                         ///< unit, out of the prism; and the place y on the triangle
  int rounds = 0;                                       ///< how many faces were asked; none for a miss told by a plane

  THINWALL_HOT ClearPrismEntry(const ClearPrism& prism, const packed::Lanes& p, const packed::Lanes& q,
                               const packed::Lanes& v, const packed::Pair& R) {
    using packed::Lanes, packed::LanesMask, packed::Pair, packed::PairMask, packed::all, packed::both;
    const Lanes none = all(0), never = all(ClearEntry::never), never_asked = never * all(-4);
    const Pair size = sum(abs(p) + abs(v)) + prism.length, squares = size * size;
    const PairMask in_range =
        (size * both(0x1p-14) <= R) & (size <= both(packed::most_length)) & (both(1 / packed::most_length) <= size);
    if (!all_of(in_range)) return;

    // Above a plane by R or more, or below that of the other side of the prism.
    const packed::Vectors<Lanes>& N = prism.normals;
    const Lanes noise = all(squares * size * both(0x1p-46)), start = dot(N, packed::spread(p) - prism.corners);
    const Lanes rate = dot(N, packed::spread(v)), end = start + rate * all(1 + 0x1p-9);
    const Lanes above = all(R) * root(dot(N, N)) + noise, below = none - (above + all(abs(prism.thick)));
    if (four_bits((above < min(start, end)) | (max(start, end) < below)) != 0U) {
      clear = true;
      return;
    }
    const Lanes back = none - v;
    const bool is_ahead = all_of(prism.reach(back) + R * root(dot(v, v)) + squares * both(0x1p-46) < dot(back, p));
    if (!packed::either(four_bits((above < start) | (start < below)) != 0U, is_ahead)) return;

    // When each plane is entered, of the triangle's two the one that the motion leads into.
    const LanesMask is_rear = packed::mask(false, false, false, true) & (none < rate);
    const Lanes speed = select(is_rear, rate, none - rate);
    const Lanes high = select(is_rear, none - (start + all(abs(prism.thick))), start);
    const bool rear = four_bits(is_rear) != 0U, along_triangle = four_bits(noise < speed) < 8U;
    if (along_triangle) return;
    const unsigned sides = bits(none - noise < speed);
    Lanes entered =
        select(speed <= none - noise, never_asked, none - never);  // of a side along the motion, to rounding, last
    entered = select(noise < speed, (high - above) / speed, entered);
    bool sure = true;
    for (;;) {
      const Pair latest = largest_of(entered);
      if (all_of(latest <= both(-2 * ClearEntry::never))) break;
      const LanesMask one = packed::lowest_of_four(all(latest) <= entered);
      entered = select(one, never_asked, entered);
      const auto k = static_cast<unsigned>(std::countr_zero(four_bits(one)));
      const bool is_side = k < 3;
      const Lanes from = is_side ? prism.corner[k] : none, seen = is_side || !rear ? p - from : q;
      const ClearFlatEntry entry(prism.flat(k), seen, v, R);
      ++rounds;
      // Of a side's edges the neighbors are the triangle, the next side, the triangle at w = 1 and the side before.
      const unsigned next = sides >> (k + 1) % 3 & 1U, before = sides >> (k + 2) % 3 & 1U;
      const unsigned neighbors = is_side ? (rear ? 4U : 1U) | next << 1U | before << 3U : sides | 8U;
      if ((entry.passed & ~neighbors) != 0U && all_of(both(-ClearEntry::never) < latest)) {
        clear = true, time = both(ClearEntry::never);
        return;
      }
      const bool is_one = !is_side || all_of(entry.broad | (both(1) < entry.time)), its = entry.clear && is_one;
      sure = sure && its;
      if (!all_of(entry.time < time)) continue;
      time = entry.time, normal = entry.normal;
      const Lanes place = (p + v * all(time)) - normal * all(R);
      on = is_side ? from + prism.edge[k] * all(entry.s) : rear ? (q + v * all(time)) - normal * all(R) : place;
      if (its && prism.is_behind(place, normal, size, squares * both(0x1p-98) / (R * R))) {
        sure = true;
        break;
      }
    }
    // Where all lie level any place may be where they touch.
    clear = sure && all_of((both(1 + 0x1p-9) < time) | prism.leans);
  }
};

}  // namespace thinwall
