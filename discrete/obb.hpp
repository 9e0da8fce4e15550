#pragma once
/// The oriented box, and its pairs with the sphere and both kinds of box.

#include <algorithm>
#include <limits>
#include <optional>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/boxes/box_pair.hpp>
#include <thinwall/discrete/clear/clear_box_gap.hpp>
#include <thinwall/discrete/entry/near_path.hpp>

namespace thinwall {

/// All points center + axes * x with |x| <= half_extents, axis by axis.
template <thinwall::Scalar S> struct Obb {
  using Scalar = S;
  static constexpr int rank = 2;

  Vec3<S> center;        ///< [length]
  Vec3<S> half_extents;  ///< [length] each >= 0; a 0 makes a plate, a rod or a point
  /// Unit columns, at right angles (has_valid_axes()): the directions of the three extents. Left out: upright.
  Mat3<S> axes = Mat3<S>::Identity();
};
template <Scalar S> Obb(Vec3<S>, Vec3<S>, Mat3<S>) -> Obb<S>;
template <Scalar S> Obb(Vec3<S>, Vec3<S>) -> Obb<S>;

template <Scalar S> Obb<S> to_obb(const Aabb<S>& box) { return {box.center, box.half_extents, Mat3<S>::Identity()}; }
template <Scalar S> const Obb<S>& to_obb(const Obb<S>& box) { return box; }
/// The same box, if its axes are the coordinates' own, in any order and either way round, and nothing is round (`reach` is 0): what meets it
/// then does so without a rounding.
template <Scalar S> std::optional<Aabb<S>> sharp_upright(const Obb<S>& box, const S& reach) {
  if (reach != S(0)) return std::nullopt;
  const Mat3<S> along = box.axes.cwiseAbs();
  if (!(along.array() == S(0) || along.array() == S(1)).all()) return std::nullopt;
  return Aabb<S>{box.center, along * box.half_extents};
}

template <Scalar S> Vec3<S> center(const Obb<S>& box) { return box.center; }
template <Scalar S> S skin_radius(const Obb<S>&) { return S(0); }
template <Scalar S> S magnitude(const Obb<S>& box) {
  return box.center.cwiseAbs().sum() + box.half_extents.cwiseAbs().sum() + box.axes.cwiseAbs().sum();
}
template <Scalar S> bool has_valid_sizes(const Obb<S>& box) { return box.half_extents.minCoeff() >= S(0); }
/// True if the axes are unit and at right angles: what their six products are off by adds up to 2^-30 (1e-9) at most in double
/// and 2^-13 (1e-4) in float. That is four sevenths of the digits, beyond what the roundings of a million turns in double, or of
/// hundreds in float, add up to; and its square is rounding, so that one step of Newton's method mends it (widened()).
/// Scalars wider than double take axes made in double. A mirrored frame will do: a box is its own mirror image. False for NaN.
template <Scalar S> bool has_valid_axes(const Obb<S>& box) {
  constexpr int digits = std::min(std::numeric_limits<S>::digits, std::numeric_limits<double>::digits);
  const auto x = box.axes.col(0), y = box.axes.col(1), z = box.axes.col(2);
  const S uneven = largest(S(x.dot(x) - S(1))) + largest(S(y.dot(y) - S(1))) + largest(S(z.dot(z) - S(1)));
  const S oblique = largest(S(x.dot(y))) + largest(S(y.dot(z))) + largest(S(z.dot(x)));
  return uneven + oblique <= constant_power_of_two<S, -(digits * 4 / 7)>();
}
/// True if the center and the half extents are finite, no half extent is negative, and the axes are orthonormal as
/// has_valid_axes() has it. Any other box is no question: see the queries for what they answer.
template <Scalar S> bool valid(const Obb<S>& box) {
  return is_finite(box.center) && is_finite(box.half_extents) && has_valid_sizes(box) && has_valid_axes(box);
}
template <Scalar S> Obb<S> scaled(const Obb<S>& box, int e) {
  return {times_power_of_two(box.center, e), times_power_of_two(box.half_extents, e), box.axes};
}
template <Scalar T, Scalar S> Obb<T> cast(const Obb<S>& box) {
  return {box.center.template cast<T>(), box.half_extents.template cast<T>(), box.axes.template cast<T>()};
}
/// What is orthonormal to the rounding of S alone is a slanted box in W: this one has the orthonormal axes that are nearest to its axes, half
/// as far off as their transpose, and the true lengths of its edges to the square of that. Steps of Newton's method without a division
/// (Newton-Schulz) for the polar factor of the axes, each of which squares what is off.
template <Scalar W, Scalar S> Obb<W> widened(const Obb<S>& box) {
  Obb<W> straight = cast<W>(box);
  for (int digits = std::numeric_limits<S>::digits; digits < std::numeric_limits<W>::digits; digits *= 2) {
    const Mat3<W> gram = straight.axes.transpose() * straight.axes;
    straight.axes = straight.axes * (Mat3<W>::Identity() * W(3) - gram) / W(2);
    for (int i = 0; i < 3; ++i) straight.half_extents[i] *= (gram(i, i) + W(1)) / W(2);
  }
  return straight;
}
/// A float's, which takes two steps, in registers.
template <> THINWALL_HOT Obb<double> widened<double, float>(const Obb<float>& box) {
  using packed::Lanes, packed::all;
  const auto wide = [](const auto& v) { return packed::lanes(Vec3<double>(v.template cast<double>())); };
  Lanes x = wide(box.axes.col(0)), y = wide(box.axes.col(1)), z = wide(box.axes.col(2)), lengths = all(1);
  for (int step = 0; step < 2; ++step) {
    const packed::Vectors<Lanes> rows = packed::transposed(x, y, z);
    const auto straightened = [&](const Lanes& axis) {
      const packed::Vectors<Lanes> along = spread(dot(rows, spread(axis)));
      return axis * all(1.5) - ((x * along.x + y * along.y) + z * along.z) * all(0.5);
    };
    const Lanes next_x = straightened(x), next_y = straightened(y), next_z = straightened(z);
    lengths = lengths * (dot(rows, rows) + all(1)) * all(0.5);
    x = next_x, y = next_y, z = next_z;
  }
  Obb<double> straight;  // written from registers: what is stored by halves and read whole would wait
  store(wide(box.center), straight.center);
  store(wide(box.half_extents) * lengths, straight.half_extents);
  store(x, straight.axes.data());
  store(y, straight.axes.data() + 3);
  store(z, straight.axes.data() + 6);
  return straight;
}
template <Scalar S> Obb<S> moved(const Obb<S>& box, const Vec3<S>& by) {
  return {box.center + by, box.half_extents, box.axes};
}
template <Scalar S> Vec3<S> half_widths(const Obb<S>& box) { return box.axes.cwiseAbs() * box.half_extents; }
template <Scalar S> Vec3<S> contact_point(const Obb<S>&, const Vec3<S>& core_point, const Vec3<S>&) {
  return core_point;
}

/// A world vector in the box's own axes, and back.
template <Scalar S> Vec3<S> into(const Obb<S>& box, const Vec3<S>& world) { return box.axes.transpose() * world; }
template <Scalar S> Vec3<S> out_of(const Obb<S>& box, const Vec3<S>& own) { return box.axes * own; }

/// A normal in the box's own axes, in the world's: it may be an axis, which is only as near unit as valid() asks, so it is made unit.
template <Scalar S> Vec3<S> normal_out_of(const Obb<S>& box, const Vec3<S>& own) { return safe_unit(out_of(box, own)); }

/// The normal of a box's i-th face, of a length near 1: across its edges, to which the axis is at right angles but for roundings, that count by
/// all of the face.
template <Scalar S> Vec3<S> face_normal(const Mat3<S>& axes, int i) {
  return accurate_cross<S>(axes.col((i + 1) % 3), axes.col((i + 2) % 3));
}

/// A gap given in the box's own axes, in the world's.
template <Scalar S> CoreGap<S> out_of(const Obb<S>& box, const CoreGap<S>& gap) {
  return {gap.distance, normal_out_of(box, gap.normal), out_of(box, gap.local_a), out_of(box, gap.local_b),
          out_of(box, gap.along)};
}

template <Scalar S> bool cores_within(const Obb<S>& box, const Sphere<S>& sphere, const S& reach) {
  return within(excess_of<S>(into<S>(box, sphere.center - box.center), box.half_extents), reach);
}

template <Scalar S> CoreGap<S> core_gap(const Obb<S>& box, const Sphere<S>& sphere) {
  return out_of(box, gap_to_point<S>(into<S>(box, sphere.center - box.center), box.half_extents));
}

/// A turn so small that its products with lengths would underflow is none: what is left of them might part boxes that overlap.
template <Scalar S> Mat3<S> without_underflow(const Mat3<S>& axes) {
  return axes.unaryExpr([](const S& x) { return square_in_range(S(x * x)) ? x : S(0); });
}

/// B seen from A's axes, with B's center `between` away from A's.
template <Scalar S> BoxPair<S> box_pair(const Obb<S>& a, const Obb<S>& b, const Vec3<S>& between) {
  return {a.half_extents, b.half_extents, into(a, between), without_underflow<S>(a.axes.transpose() * b.axes)};
}
template <Scalar S> BoxPair<S> box_pair(const Aabb<S>& a, const Obb<S>& b, const Vec3<S>& between) {
  return {a.half_extents, b.half_extents, between, without_underflow(b.axes)};
}
template <class A, Scalar S> BoxPair<S> box_pair(const A& a, const Obb<S>& b) {
  return box_pair<S>(a, b, b.center - a.center);
}

/// Whether two boxes overlap, by their edges as given, whatever those lean: the fifteen axes are each across two of the six.
template <Scalar W, class A, Scalar S> bool edges_overlap(const A& a, const Obb<S>& b) {
  const Obb<W> wide_a = cast<W>(to_obb(a)), wide_b = cast<W>(b);
  const Vec3<W> between = wide_b.center - wide_a.center;
  const auto edge = [&](int k) -> Vec3<W> { return k < 3 ? wide_a.axes.col(k) : wide_b.axes.col(k - 3); };
  for (int i = 1; i < 6; ++i) {
    for (int j = 0; j < i; ++j) {
      const Vec3<W> n = cross(edge(i), edge(j));
      W reach = 0;
      for (int k = 0; k < 6; ++k)
        reach += (k < 3 ? wide_a.half_extents[k] : wide_b.half_extents[k - 3]) * largest(W(n.dot(edge(k))));
      if (largest(W(between.dot(n))) > reach) return false;
    }
  }
  return true;
}

/// Where roundings decide, as the wider scalar has it.
template <class A, Scalar S> bool boxes_within(const A& a, const Obb<S>& b, const S& reach) {
  const BoxPair<S> pair = box_pair(a, b);
  const BoxesOverlap answer = boxes_overlap(pair);
  const S distance = answer.overlap || reach == S(0) ? S(0) : box_gap(pair).distance;
  if constexpr (has_wider<S>) {
    using W = Wider<S>;
    if (reach == S(0) && answer.in_doubt) return edges_overlap<W>(a, b);
    if (distance > S(0) && largest(S(distance - reach)) <= box_noise(pair))
      return box_gap(box_pair(widened<W>(a), widened<W>(b))).distance <= W(reach);
  }
  return answer.overlap || (reach > S(0) && distance <= reach);
}
template <Scalar S> bool cores_within(const Obb<S>& a, const Obb<S>& b, const S& reach) {
  return boxes_within(a, b, reach);
}
template <Scalar S> bool cores_within(const Obb<S>& a, const Aabb<S>& b, const S& reach) {
  return boxes_within(b, a, reach);
}

template <Scalar S> CoreGap<S> core_gap(const Obb<S>& a, const Obb<S>& b) { return out_of(a, box_gap(box_pair(a, b))); }
template <Scalar S> CoreGap<S> core_gap(const Obb<S>& a, const Aabb<S>& b) { return flipped(box_gap(box_pair(b, a))); }

template <Scalar S> std::optional<RayHit<S>> ray_entry(const Ray<S>& ray, const Obb<S>& box) {
  const NearPath<S> path(ray.origin - box.center, ray.direction, box.half_extents.sum(), S(64));
  const S max_t = path.base_time > S(0) ? std::numeric_limits<S>::infinity() : ray.max_t;
  const Vec3<S> squares =
      box.axes.colwise().squaredNorm();  // what is h along an axis of length a is h a^2 in these axes
  auto hit = ray_entry(Ray<S>{into(box, path.start), into(box, ray.direction), max_t},
                       Aabb<S>{Vec3<S>::Zero(), box.half_extents.cwiseProduct(squares)});
  if (!hit || !(hit->t + path.base_time <= ray.max_t)) return std::nullopt;
  hit->t += path.base_time;
  hit->point = hit->normal == Vec3<S>::Zero() ? ray.origin
                                              : Vec3<S>(box.center + out_of<S>(box, hit->point.cwiseQuotient(squares)));
  hit->normal = normal_out_of(box, hit->normal);
  return hit;
}

// ---- The clear rung (clear/clear_entry.hpp).

/// Two boxes whose centers are `between` apart in the first one's axes, along which `rows` are the other's numbers; `orthonormal` if all axes
/// are clear: what two of them span is then the third but for 5 * 2^-48, and no product need be told to more than noise of all sizes. Axes within
/// 2^-48 of parallel have a product that parts nothing else by as much.
THINWALL_HOT ClearOverlap clear_boxes_overlap(const packed::Vectors<packed::Lanes>& rows, const packed::Lanes& ha,
                                              const packed::Lanes& hb, const packed::Lanes& between,
                                              const packed::Lanes& size, const packed::LanesMask& orthonormal) {
  using packed::Lanes, packed::LanesMask, packed::all, packed::both;
  const packed::Vectors<Lanes> wide = abs(rows), A = spread(ha), d = spread(between);
  const Lanes noise = size * all(0x1p-44), b1 = yzx(hb), b2 = yzx(b1);
  const auto product = [&](const Lanes& along, const Lanes& x, const Lanes& y, const Lanes& z, const Lanes& ay,
                           const Lanes& az) {
    const Lanes next = yzx(x), reach = (ay * z + az * y) + (b1 * yzx(next) + b2 * next);
    return select(y + z <= all(0x1p-48), noise, reach - abs(along));
  };
  const Lanes of_a = (ha + dot(packed::transposed(wide.x, wide.y, wide.z), spread(hb))) - abs(between);
  const Lanes of_b = (hb + dot(A, wide)) - abs(dot(d, rows));
  const Lanes x = product(d.z * rows.y - d.y * rows.z, wide.x, wide.y, wide.z, A.y, A.z);
  const Lanes y = product(d.x * rows.z - d.z * rows.x, wide.y, wide.z, wide.x, A.z, A.x);
  const Lanes z = product(d.y * rows.x - d.x * rows.y, wide.z, wide.x, wide.y, A.x, A.y);
  const Lanes least = min(min(of_a, of_b), min(min(x, y), z));
  const LanesMask in_range =
      (all(0) <= min(ha, hb)) & (size <= all(packed::most_length)) & (all(1 / packed::most_length) <= size);
  const bool within = all_of(noise <= least), apart = any_of(least < all(0) - noise);
  return {both(all_of(in_range & orthonormal), within != apart), within};
}
THINWALL_HOT ClearOverlap clear_overlap(const Obb<double>& a, const Obb<double>& b) {
  const ClearFrame of_a(a.axes), of_b(b.axes);
  const packed::Lanes between = packed::lanes(b.center) - packed::lanes(a.center), ha = packed::lanes(a.half_extents);
  const packed::Lanes hb = packed::lanes(b.half_extents), size = all(sum(abs(between) + (ha + hb)));
  return clear_boxes_overlap(of_b.into(of_a), ha, hb, of_a.into(between), size, of_a.clear() & of_b.clear());
}
THINWALL_HOT ClearOverlap clear_overlap(const Obb<double>& b, const Aabb<double>& a) {
  const packed::Lanes between = packed::lanes(b.center) - packed::lanes(a.center), ha = packed::lanes(a.half_extents);
  const packed::Lanes hb = packed::lanes(b.half_extents), size = all(sum(abs(between) + (ha + hb)));
  const ClearFrame of_b(b.axes);
  return clear_boxes_overlap(of_b.rows, ha, hb, between, size, of_b.clear());
}

THINWALL_HOT ClearOverlap clear_overlap(const Obb<double>& box, const Sphere<double>& sphere) {
  using packed::Lanes, packed::Pair, packed::all, packed::both;
  const ClearFrame frame(box.axes);
  const Lanes from_box = packed::lanes(sphere.center) - packed::lanes(box.center);
  const Lanes x = frame.into(from_box), h = packed::lanes(box.half_extents), excess = x - held_within(x, h);
  const Pair r = both(sphere.radius), distance = root(dot(excess, excess)), size = sum(abs(from_box) + h) + r;
  const packed::PairMask in_range = (size <= both(packed::most_length)) & (both(1 / packed::most_length) <= size);
  const packed::PairMask decided = size * both(0x1p-46) < abs(distance - r);
  return {both(both(all_of(in_range & decided), all_of(frame.clear() & (all(0) <= h))), sphere.radius >= 0),
          all_of(distance < r)};
}
/// In the box's own axes, made of unit length. Clear where no rounding of turning decides, nor says which way out is shortest, or where the
/// box faces.
THINWALL_HOT ClearContact clear_contact(const Obb<double>& box, const Sphere<double>& sphere) {
  using packed::Lanes, packed::Pair, packed::PairMask, packed::all, packed::both;
  const ClearFrame frame(box.axes);
  const Lanes per_length = frame.per_length(), from_box = packed::lanes(sphere.center) - packed::lanes(box.center);
  const Lanes x = frame.into(from_box) * per_length, h = packed::lanes(box.half_extents) / per_length;
  ClearContact contact = clear_contact_in_box(x, h, sphere.radius);
  const Pair r = both(sphere.radius), noise = sum(abs(from_box) + h) * both(0x1p-46);
  const PairMask decided = noise + r * both(0x1p-46) < abs(contact.depth);
  const PairMask wide = noise * both(0x1p26) < r - contact.depth;  // the distance from the box
  const Lanes depths = h - abs(x);
  const unsigned ways_out = bits(depths <= all(smallest_of(depths) + noise));
  const bool one_way = both(both(all_of(all(noise) < depths), (ways_out & (ways_out - 1)) == 0),
                            all_of(noise < abs(dot(x, contact.normal))));
  contact.clear = both(both(contact.clear, all_of(frame.clear())), both(all_of(decided), all_of(wide) || one_way));
  contact.normal = nearer_unit(frame.out_of(contact.normal * per_length));
  contact.local_a = frame.out_of(contact.local_a * per_length);
  contact.local_b = (all(0) - contact.normal) * all(r);
  return contact;
}

THINWALL_HOT ClearTwoBoxes<ClearFrame> clear_two_boxes(const Obb<double>& a, const Obb<double>& b) {
  const ClearFrame of_a(a.axes), of_b(b.axes);
  return {of_a, ClearBoxPair(of_a, a.half_extents, of_b, b.half_extents, of_b.into(of_a),
                             packed::lanes(b.center) - packed::lanes(a.center))};
}
THINWALL_HOT ClearTwoBoxes<ClearUpright> clear_two_boxes(const Aabb<double>& a, const Obb<double>& b) {
  const ClearFrame of_b(b.axes);
  return {{},
          ClearBoxPair(ClearUpright{}, a.half_extents, of_b, b.half_extents, of_b.rows,
                       packed::lanes(b.center) - packed::lanes(a.center))};
}
THINWALL_HOT ClearContact clear_contact(const Obb<double>& a, const Obb<double>& b) {
  return clear_boxes_gap<false>(clear_two_boxes(a, b));
}
THINWALL_HOT ClearContact clear_gap(const Obb<double>& a, const Obb<double>& b) {
  return clear_boxes_gap<true>(clear_two_boxes(a, b));
}
/// Its contact acts at the center of the one that is not turned.
THINWALL_HOT ClearContact clear_contact(const Aabb<double>& a, const Obb<double>& b) {
  ClearContact contact = clear_boxes_gap<false>(clear_two_boxes(a, b));
  contact.local_a = packed::all(0);
  return contact;
}
THINWALL_HOT ClearContact clear_gap(const Aabb<double>& a, const Obb<double>& b) {
  return clear_boxes_gap<true>(clear_two_boxes(a, b));
}

/// A ray in the axes of the box that it may meet.
struct ClearTurnedRay {
  ClearFrame frame;
  packed::Lanes center, h;
  packed::Vectors<packed::Lanes> start;
  packed::Lanes p, v, noise;
  packed::Lanes P, W, reach, near, far, enter;  ///< as ClearSlabs
  packed::Pair first;

  THINWALL_HOT ClearTurnedRay(const Ray<double>& ray, const Obb<double>& box)
      : frame(box.axes),
        center(packed::lanes(box.center)),
        h(packed::lanes(box.half_extents)),
        start(packed::spread(ray.origin) - packed::spread(box.center)),
        p(dot(frame.rows, start)),
        v(frame.into(ray.direction)),
        noise(((abs(start.x) + abs(start.y)) + (abs(start.z) + h)) * packed::all(0x1p-48)),
        P(against(p, v)),
        W(abs(v)),
        reach(h * frame.squares),
        near(P - reach),
        far(P + reach),
        enter(near / W),
        first(largest_of(max(enter, packed::all(0)))) {}
  /// What it meets by the one face that `axis` names: when, by the face's own normal, from which its axis leans.
  THINWALL_HOT ClearRayHit hit(bool clear, bool meets, const packed::LanesMask& axis) const {
    using packed::all, packed::both;
    const packed::LanesMask in_range = (all(0x1p-48 / packed::most_length) <= noise) & (all(0) <= h) &
                                       (max(noise * all(0x1p48), W) <= all(packed::most_length));
    const packed::Lanes on_box = select(axis, against(h, v), held_within(p + v * all(first), h));
    const packed::Lanes later = frame.leaning(on_box) / v;
    return {both(all_of(frame.clear() & in_range), clear), meets, first + sum(keep(axis, later)),
            center + frame.out_of(on_box), frame.out_of(keep(axis, against(frame.per_length(), v)))};
  }
};

/// With the noise of turning.
inline ClearRayHit clear_raycast(const Ray<double>& ray, const Obb<double>& box) {
  using packed::both;
  const ClearTurnedRay r(ray, box);
  const packed::Lanes off = r.noise / r.W;
  const unsigned may_be_last = bits(all(largest_of(r.enter - off)) <= r.enter + off);
  const ClearOrder order(r.near, r.far, r.W, r.noise, ray.max_t);
  const bool meets = both(both(order.meets, !order.misses), any_of(r.noise + r.noise < abs(r.p) - r.h));
  const bool decided = packed::either(order.misses, both(meets, (may_be_last & (may_be_last - 1)) == 0));
  const bool in_range = both(ray.max_t >= 0, all_of(both(ClearOrder::least_motion) <= largest_of(r.W)));
  return r.hit(both(decided, in_range), meets, packed::all(r.first) <= r.enter);
}

/// What is told from afar (clear_entry.hpp) and need not be asked by clear_raycast(), as nearly always.
THINWALL_HOT ClearRayHit raycast_from_afar(const Ray<double>& ray, const Obb<double>& box) {
  using packed::Pair, packed::all, packed::both;
  const ClearTurnedRay r(ray, box);
  const packed::LanesMask from_afar = r.noise * all(packed::from_afar) <= min(abs(r.near), abs(r.far));
  const Pair last = min(smallest_of(r.far / r.W), both(ray.max_t)), in_order = firsts(last, r.first);
  const Pair later = swapped(in_order) * both(packed::clearly_earlier);
  const unsigned verdict = bits(in_order < min(both(ClearOrder::most_time), later));  // 1: a miss, 2: it meets
  const packed::LanesMask axis = all(firsts(later)) <= r.enter;
  const unsigned decided = verdict & (1U | packed::is_one_axis(bits(axis)) << 1U);
  return r.hit(both(all_of(from_afar), decided != 0), verdict == 2U, axis);
}

}  // namespace thinwall

#ifdef THINWALL_COMPILED
#include <thinwall/discrete/compiled.hpp>
#endif
