// A box and a sphere, lane by lane: the box rounded by the sphere's radius, and the sphere's center on its way.
//
// The walk of swept/closed_form/rounded_box_entry.hpp: the region in which the center enters the widened slabs, then the next.
// Columns of a box: 0-2 center, 3-5 half extents, then 9 of axes where it is turned, then displacement; of a sphere: 0-2 center,
// 3 radius, 4-6 displacement.

#if defined(THINWALL_BATCH_ROUNDED_BOX_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef THINWALL_BATCH_ROUNDED_BOX_LANES
#undef THINWALL_BATCH_ROUNDED_BOX_LANES
#else
#define THINWALL_BATCH_ROUNDED_BOX_LANES
#endif

#include <thinwall/swept/batch/slab_lanes.inl>

HWY_BEFORE_NAMESPACE();
namespace thinwall::batch::HWY_NAMESPACE {

/// Where one axis stands when the center enters the widened slabs.
template <class D> struct AxisLanes {
  hn::Vec<D> q, u;      ///< from the nearest corner, and its motion; 0 on an axis that takes no part
  hn::Vec<D> next;      ///< [1] when that changes
  hn::Mask<D> outside;  ///< takes part
};

template <class D> HWY_INLINE AxisLanes<D> axis_lanes(D d, const SlabLanes<D>& slab, hn::Vec<D> v, hn::Vec<D> start) {
  const auto before = hn::Lt(start, slab.own_enter), after = hn::Ge(start, slab.own_leave);
  const auto outside = hn::Or(before, after);
  const auto never = hn::Set(d, std::numeric_limits<hn::TFromD<D>>::infinity());
  return {hn::IfThenElseZero(outside, hn::IfThenElse(before, slab.before, slab.after)), hn::IfThenElseZero(outside, v),
          hn::IfThenElse(before, slab.own_enter, hn::IfThenElse(after, never, slab.own_leave)), outside};
}

/// How far x lies outside [-h, h].
template <class D> HWY_INLINE hn::Vec<D> excess_lanes(D d, hn::Vec<D> x, hn::Vec<D> h) {
  return hn::Max(hn::Sub(hn::Abs(x), h), hn::Zero(d));
}

/// What one region says of the lanes that go through it.
template <class D> struct RegionLanes {
  hn::Mask<D> hit, apart, onward;  ///< onward: free until `next`, and still nearing the box
  hn::Mask<D> beyond_edge;         ///< two axes take part, or three: an edge's or a corner's region
  hn::Vec<D> time, next;
};

/// The region at `start`: a ball around its corner or along its edge.
template <class D>
HWY_INLINE RegionLanes<D> region_lanes(D d, const BoxLanes<D>& box, const Vec3Lanes<hn::Vec<D>>& v, hn::Vec<D> R,
                                       hn::Vec<D> blur, hn::Vec<D> start) {
  const auto zero = hn::Zero(d), one = hn::Set(d, hn::TFromD<D>(1));
  const auto x = axis_lanes(d, box.x, v.x, start), y = axis_lanes(d, box.y, v.y, start),
             z = axis_lanes(d, box.z, v.z, start);
  const auto chord = chord_lanes<true>(d, {x.q, y.q, z.q}, {x.u, y.u, z.u}, R, blur);
  RegionLanes<D> out;
  out.beyond_edge = hn::Or(hn::And(x.outside, y.outside), hn::And(z.outside, hn::Or(x.outside, y.outside)));
  out.next = hn::Min(x.next, hn::Min(y.next, z.next));
  out.time = hn::Max(chord.time, start);
  const auto solvable = hn::And(chord.ordinary, chord.outside);
  const auto leave = hn::Sub(chord.half, chord.recess);
  const auto in_region = hn::And(hn::Le(chord.time, out.next), hn::Ge(leave, hn::Mul(start, chord.speed_square)));
  const auto crosses = hn::And(chord.chord, hn::And(in_region, hn::Lt(chord.recess, zero)));
  // Past its closest approach before the region ends; the distance is convex, so it never comes nearer.
  const auto passed = hn::Ge(hn::MulAdd(chord.speed_square, out.next, chord.recess), zero);
  const auto over = hn::Or(passed, hn::Ge(out.next, one));
  const auto late = hn::Or(hn::And(crosses, chord.after_end), hn::Ge(chord.recess, zero));
  const auto later = hn::Or(chord.none, hn::And(chord.chord, hn::Gt(chord.time, out.next)));
  out.hit = hn::And(solvable, hn::And(crosses, chord.before_end));
  out.apart = hn::And(solvable, hn::Or(hn::And(chord.none, over), late));
  out.onward = hn::AndNot(over, hn::And(solvable, later));
  return out;
}

template <class D>
HWY_INLINE Verdict<D> rounded_box(D d, const Vec3Lanes<hn::Vec<D>>& p, const Vec3Lanes<hn::Vec<D>>& v,
                                  const Vec3Lanes<hn::Vec<D>>& h, hn::Vec<D> R, hn::Vec<D> blur) {
  using S = hn::TFromD<D>;
  using B = Bounds<S>;
  const auto zero = hn::Zero(d), one = hn::Set(d, S(1));
  const auto box = box_lanes(d, p, v, h, R, blur, one);
  const auto none = hn::Lt(one, zero);
  Verdict<D> out{none, hn::And(box.ordinary, box.unreached), none, one};
  if (hn::AllTrue(d, out.apart)) return out;

  const Vec3Lanes<hn::Vec<D>> excess{excess_lanes(d, p.x, h.x), excess_lanes(d, p.y, h.y), excess_lanes(d, p.z, h.z)};
  const auto gap = dot(excess, excess), RR = hn::Mul(R, R);
  const auto lengths = hn::Add(hn::Add(largest(p), blur), hn::Add(largest(h), R));
  const auto length_noise = hn::Mul(hn::Set(d, B::length), lengths);
  const auto reach = hn::Add(hn::Add(excess.x, excess.y), hn::Add(excess.z, R));
  const auto touch = hn::Mul(hn::Set(d, B::touch), hn::Mul(reach, lengths));
  const auto starts_out = hn::Or(box.starts_out, hn::Gt(hn::Sub(gap, RR), touch));
  const auto depth_x = hn::Sub(h.x, hn::Abs(p.x)), depth_y = hn::Sub(h.y, hn::Abs(p.y)),
             depth_z = hn::Sub(h.z, hn::Abs(p.z));
  const auto deep = hn::Gt(hn::Min(depth_x, hn::Min(depth_y, depth_z)), length_noise);
  const auto starts_in = hn::Or(deep, hn::Gt(hn::Sub(RR, gap), touch));
  out.overlapping = hn::And(box.ordinary, starts_in);
  const auto candidate = hn::AndNot(starts_in, hn::And(box.ordinary, starts_out));

  // Where each axis stands when the widened slabs are entered, whenever in its noise that truly is.
  const auto from = hn::Max(box.earliest, zero), to = hn::Max(box.latest, zero);
  const auto inside_of = [&](const SlabLanes<D>& slab) HWY_ATTR {
    return hn::And(hn::Ge(hn::Sub(from, slab.noise), slab.own_enter), hn::Lt(hn::Add(to, slab.noise), slab.own_leave));
  };
  const auto outside_of = [&](const SlabLanes<D>& slab) HWY_ATTR {
    return hn::Or(hn::Lt(hn::Add(to, slab.noise), slab.own_enter), hn::Ge(hn::Sub(from, slab.noise), slab.own_leave));
  };
  const auto two_of = [](hn::Mask<D> x, hn::Mask<D> y, hn::Mask<D> z)
                          HWY_ATTR { return hn::Or(hn::And(x, y), hn::And(z, hn::Or(x, y))); };
  const auto in_x = inside_of(box.x), in_y = inside_of(box.y), in_z = inside_of(box.z);
  const auto out_x = outside_of(box.x), out_y = outside_of(box.y), out_z = outside_of(box.z);

  // Most hits are on a face, at the time it is met at.
  out.hit = hn::And(two_of(in_x, in_y, in_z), hn::And(candidate, box.reached));
  out.time = hn::IfThenElse(out.hit, box.first, one);

  // The others, region by region.
  const auto known = hn::And(hn::Or(in_x, out_x), hn::And(hn::Or(in_y, out_y), hn::Or(in_z, out_z)));
  const auto entered = hn::And(known, hn::Or(box.reached, box.starts_in));
  auto going = hn::AndNot(out.apart, hn::And(entered, hn::And(candidate, two_of(out_x, out_y, out_z))));
  auto start = hn::Max(box.first, zero);
  for (int round = 0; round < 3 && !hn::AllFalse(d, going); ++round) {
    const auto region = region_lanes(d, box, v, R, length_noise, start);
    const auto there = hn::And(going, region.beyond_edge);
    const auto hit = hn::And(there, region.hit);
    out.hit = hn::Or(out.hit, hit);
    out.apart = hn::Or(out.apart, hn::And(there, region.apart));
    out.time = hn::IfThenElse(hit, region.time, out.time);
    going = hn::And(there, region.onward);
    start = hn::IfThenElse(going, region.next, start);
  }
  return out;
}

struct AabbSphere {
  static constexpr std::size_t columns_a = 9, columns_b = 7;

  template <class D, class A, class B> HWY_INLINE Verdict<D> operator()(D d, const A& box, const B& sphere) const {
    return rounded_box<D>(d, {hn::Sub(sphere(0), box(0)), hn::Sub(sphere(1), box(1)), hn::Sub(sphere(2), box(2))},
                          {hn::Sub(sphere(4), box(6)), hn::Sub(sphere(5), box(7)), hn::Sub(sphere(6), box(8))},
                          {box(3), box(4), box(5)}, sphere(3), hn::Zero(d));
  }
};

struct ObbSphere {
  static constexpr std::size_t columns_a = 18, columns_b = 7;

  template <class D, class A, class B> HWY_INLINE Verdict<D> operator()(D d, const A& box, const B& sphere) const {
    using Vector = Vec3Lanes<hn::Vec<D>>;
    const Vector p{hn::Sub(sphere(0), box(0)), hn::Sub(sphere(1), box(1)), hn::Sub(sphere(2), box(2))};
    const Vector v{hn::Sub(sphere(4), box(15)), hn::Sub(sphere(5), box(16)), hn::Sub(sphere(6), box(17))};
    const Vector ax{box(6), box(7), box(8)}, ay{box(9), box(10), box(11)}, az{box(12), box(13), box(14)};
    const auto sum = [](const Vector& a)
                         HWY_ATTR { return hn::Add(hn::Add(hn::Abs(a.x), hn::Abs(a.y)), hn::Abs(a.z)); };
    auto out = rounded_box<D>(d, {dot(ax, p), dot(ay, p), dot(az, p)}, {dot(ax, v), dot(ay, v), dot(az, v)},
                              {box(3), box(4), box(5)}, sphere(3), hn::Add(sum(p), sum(v)));
    // Axes that are off by more than the roundings reckoned with are the scalar code's to judge. NaN: off.
    const auto one = hn::Set(d, hn::TFromD<D>(1));
    const auto off = hn::Add(sum({hn::Sub(dot(ax, ax), one), hn::Sub(dot(ay, ay), one), hn::Sub(dot(az, az), one)}),
                             sum({dot(ax, ay), dot(ay, az), dot(az, ax)}));
    const auto upright = hn::Le(off, hn::Set(d, 4 * Bounds<hn::TFromD<D>>::length));
    out.hit = hn::And(upright, out.hit);
    out.apart = hn::And(upright, out.apart);
    out.overlapping = hn::And(upright, out.overlapping);
    return out;
  }
};

}  // namespace thinwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
