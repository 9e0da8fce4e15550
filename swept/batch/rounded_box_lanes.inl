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

/// One axis, seen from the region that the center is in at a time.
template <class D> struct AxisLanes {
  hn::Vec<D> q, w;  ///< from the nearest corner, and its speed downwards; 0 on an axis that takes no part
  hn::Vec<D> next;  ///< [1] when that changes
};

template <class D> HWY_INLINE AxisLanes<D> axis_lanes(D d, const SlabLanes<D>& slab, hn::Vec<D> time) {
  const auto enter = hn::Mul(slab.low, slab.per_speed), leave = hn::Mul(slab.high, slab.per_speed);
  const auto before = hn::Lt(time, enter), after = hn::Ge(time, leave), outside = hn::Or(before, after);
  const auto never = hn::Set(d, std::numeric_limits<hn::TFromD<D>>::infinity());
  return {hn::IfThenElseZero(outside, hn::IfThenElse(before, slab.low, slab.high)),
          hn::IfThenElseZero(outside, slab.speed), hn::IfThenElse(before, enter, hn::IfThenElse(after, never, leave))};
}

/// The region at a time: the part of the box that is nearest then, and until when.
template <class D> struct RegionLanes {
  using M = hn::Mask<D>;
  AxisLanes<D> x, y, z;
  hn::Vec<D> next;

  HWY_INLINE RegionLanes(D d, const BoxLanes<D>& box, hn::Vec<D> time)
      : x(axis_lanes(d, box.x, time)),
        y(axis_lanes(d, box.y, time)),
        z(axis_lanes(d, box.z, time)),
        next(hn::Min(x.next, hn::Min(y.next, z.next))) {}

  /// When the region ends, before the step does, the center is clearly farther than R and nearing; or nearer or not is not clear.
  struct End {
    M goes_on, is_close;
  };
  HWY_INLINE End end(D d, hn::Vec<D> R, hn::Vec<D> noise) const {
    // 0 on the axis that changes: what that is rounded to would drown a slow axis's part in whether it nears.
    const auto then_of = [&](const AxisLanes<D>& axis) HWY_ATTR {
      return hn::IfThenElseZero(hn::Gt(axis.next, next), hn::NegMulAdd(axis.w, next, axis.q));
    };
    const Vec3Lanes<hn::Vec<D>> then{then_of(x), then_of(y), then_of(z)};
    const auto beyond = hn::Sub(dot(then, then), hn::Mul(R, R)), least = hn::Mul(noise, hn::Add(sum(then), R));
    const auto in_step = hn::Lt(next, hn::Set(d, hn::TFromD<D>(1)));
    const auto nears = hn::Gt(dot(then, {x.w, y.w, z.w}), hn::Zero(d));
    return {hn::And(in_step, hn::And(hn::Gt(beyond, least), nears)), hn::And(in_step, hn::Le(hn::Abs(beyond), least))};
  }
};

/// A sphere's center and its motion as its box sees them, in its own axes.
template <class D> struct SeenFromBox {
  Vec3Lanes<hn::Vec<D>> p, v, h;
  hn::Vec<D> R, blur;      ///< [length] `blur`: as of box_lanes
  hn::Mask<D> is_upright;  ///< the axes are unit and at right angles, as `blur` reckons with
};

/// The second of the three by size.
template <class V> HWY_INLINE V median(const Vec3Lanes<V>& a) {
  return hn::Max(hn::Min(a.x, a.y), hn::Min(hn::Max(a.x, a.y), a.z));
}

/// The center's path, a segment, is clearly apart from the box widened by R on one of six axes: the box's, or their products with the
/// path. Source: Ericson, Real-Time Collision Detection (2005), 5.3.3.
template <class D> HWY_INLINE hn::Mask<D> parts(D d, const SeenFromBox<D>& seen) {
  using S = hn::TFromD<D>;
  using Vector = Vec3Lanes<hn::Vec<D>>;
  const auto half = hn::Set(d, S(0.5));
  const Vector &v = seen.v, H{hn::Add(seen.h.x, seen.R), hn::Add(seen.h.y, seen.R), hn::Add(seen.h.z, seen.R)};
  const Vector W{hn::Abs(v.x), hn::Abs(v.y), hn::Abs(v.z)};
  const Vector m{hn::MulAdd(half, v.x, seen.p.x), hn::MulAdd(half, v.y, seen.p.y), hn::MulAdd(half, v.z, seen.p.z)};
  const Vector M{hn::Abs(m.x), hn::Abs(m.y), hn::Abs(m.z)}, moment = cross(m, v);
  const auto path = sum(v);
  const auto lengths = hn::Add(hn::Add(hn::Add(M.x, H.x), hn::Add(M.y, H.y)), hn::Add(hn::Add(M.z, H.z), path));
  const auto noise = hn::Mul(hn::Set(d, Bounds<S>::length), hn::Add(lengths, seen.blur));
  const auto along = [&](hn::Vec<D> at, hn::Vec<D> reach, hn::Vec<D> w)
                         HWY_ATTR { return hn::Sub(at, hn::MulAdd(half, w, reach)); };
  const auto across = [](hn::Vec<D> turn, hn::Vec<D> Hi, hn::Vec<D> Wj, hn::Vec<D> Hj, hn::Vec<D> Wi)
                          HWY_ATTR { return hn::Sub(hn::Abs(turn), hn::MulAdd(Hi, Wj, hn::Mul(Hj, Wi))); };
  const auto beyond = hn::Max(along(M.x, H.x, W.x), hn::Max(along(M.y, H.y, W.y), along(M.z, H.z, W.z)));
  const auto beside = hn::Max(across(moment.x, H.y, W.z, H.z, W.y),
                              hn::Max(across(moment.y, H.z, W.x, H.x, W.z), across(moment.z, H.x, W.y, H.y, W.x)));
  const auto least = hn::Set(d, Bounds<S>::least_reach);
  const auto is_apart = hn::Or(hn::Gt(beyond, noise), hn::Gt(beside, hn::MulAdd(noise, path, least)));
  return hn::And(hn::And(ordinary(d, seen.h, seen.R, lengths), seen.is_upright), is_apart);
}

/// The start: clearly outside the rounded box, or inside.
template <class D> struct StartLanes {
  hn::Mask<D> outside, overlapping;

  /// `noise` [length] of the place on every axis.
  HWY_INLINE StartLanes(D d, const SeenFromBox<D>& seen, hn::Vec<D> noise) {
    const auto &p = seen.p, &h = seen.h;
    const auto zero = hn::Zero(d), R = seen.R;
    const auto x = hn::Sub(hn::Abs(p.x), h.x), y = hn::Sub(hn::Abs(p.y), h.y), z = hn::Sub(hn::Abs(p.z), h.z);
    const Vec3Lanes<hn::Vec<D>> excess{hn::Max(x, zero), hn::Max(y, zero), hn::Max(z, zero)};
    const auto gap = hn::Sub(dot(excess, excess), hn::Mul(R, R));
    const auto reach = hn::Add(hn::Add(excess.x, excess.y), hn::Add(excess.z, R));
    const auto touch = hn::Mul(hn::Mul(hn::Set(d, hn::TFromD<D>(2)), noise), reach);
    outside = hn::Gt(gap, touch);
    const auto in_box = hn::Lt(hn::Max(x, hn::Max(y, z)), hn::Neg(noise));
    overlapping = hn::Or(in_box, hn::Lt(gap, hn::Neg(touch)));
  }
};

/// How the widened slabs are entered during the step, whenever in its noise that truly is.
template <class D> struct EntryLanes {
  hn::Vec<D> from;          ///< [1] at the earliest
  hn::Mask<D> on_face;      ///< beyond the box on one axis at most, and not from the start: it meets the face then
  hn::Mask<D> beside_edge;  ///< beyond it on two axes or three

  HWY_INLINE EntryLanes(D d, const BoxLanes<D>& box) {
    const auto zero = hn::Zero(d), one = hn::Set(d, hn::TFromD<D>(1));
    from = hn::Max(box.earliest, zero);
    const auto to = hn::Max(box.latest, zero), first = hn::Max(box.first, zero);
    const auto beyond = [&](const SlabLanes<D>& slab) HWY_ATTR {
      return hn::Sub(hn::Abs(hn::NegMulAdd(first, slab.speed, slab.place)), slab.half);
    };
    const auto off = [&](const SlabLanes<D>& slab)
                         HWY_ATTR { return hn::MulAdd(hn::Sub(to, from), slab.speed, slab.noise); };
    const Vec3Lanes<hn::Vec<D>> at{beyond(box.x), beyond(box.y), beyond(box.z)}, by{off(box.x), off(box.y), off(box.z)};
    const auto enters = hn::Lt(to, hn::Min(box.earliest_out, one));
    on_face = hn::And(hn::And(enters, hn::Gt(box.earliest, zero)), hn::Lt(median(plus(at, by)), zero));
    beside_edge = hn::And(enters, hn::Gt(median(minus(at, by)), zero));
  }
};

/// From time `from` on to the region in which the center touches, or passes: a ball around its corner or along its edge. It nears, or
/// never did: on the widened slab that is entered last the distance is R or more, so where it grows the line has not been nearer before.
/// Asked of the lanes in `who`.
template <class D>
HWY_INLINE Verdict<D> walk_lanes(D d, const SeenFromBox<D>& seen, const BoxLanes<D>& box, hn::Vec<D> noise,
                                 hn::Vec<D> from, hn::Mask<D> who) {
  const auto four_noises = hn::Mul(hn::Set(d, hn::TFromD<D>(4)), noise);
  auto now = from;
  RegionLanes<D> region(d, box, now);
  auto end = region.end(d, seen.R, four_noises);
  auto on = hn::And(who, end.goes_on), unsure = end.is_close;
  for (int round = 0; round < 2 && !hn::AllFalse(d, on); ++round) {
    now = hn::IfThenElse(on, region.next, now);
    region = RegionLanes<D>(d, box, now);
    end = region.end(d, seen.R, four_noises);
    on = hn::And(on, end.goes_on);
    unsure = hn::Or(unsure, end.is_close);
  }
  const Blur<D> blur{noise, sum(seen.v)};
  const auto &x = region.x, &y = region.y, &z = region.z;
  const Vec3Lanes<hn::Vec<D>> down{hn::Neg(x.w), hn::Neg(y.w), hn::Neg(z.w)};
  Verdict<D> out = verdict_of(d, chord_lanes(d, {x.q, y.q, z.q}, down, seen.R, &blur));
  out.clear = hn::AndNot(hn::Or(on, hn::Or(unsure, out.overlapping)), hn::And(who, out.clear));
  return out;
}

template <class D> HWY_INLINE Verdict<D> rounded_box(D d, const SeenFromBox<D>& seen) {
  const auto one = hn::Set(d, hn::TFromD<D>(1));
  const auto box = box_lanes(d, seen.p, seen.v, seen.h, seen.R, seen.blur, one);
  const auto noise = hn::Max(box.x.noise, hn::Max(box.y.noise, box.z.noise));
  const StartLanes<D> start(d, seen, noise);
  const EntryLanes<D> entry(d, box);
  const auto on_face = hn::And(start.outside, entry.on_face);
  Verdict<D> out = walk_lanes(d, seen, box, noise, entry.from, hn::And(start.outside, entry.beside_edge));
  out.hit = hn::Or(on_face, hn::And(out.clear, out.hit));
  out.overlapping = start.overlapping;
  const auto told = hn::Or(hn::Or(on_face, out.clear), hn::Or(start.overlapping, box.never));
  out.clear = hn::And(hn::And(box.ordinary, seen.is_upright), told);
  out.time = hn::IfThenElse(on_face, box.first, hn::IfThenElse(out.hit, out.time, one));
  return out;
}

/// A box and a sphere.
template <class See> struct RoundedBox : See {
  static constexpr bool looks_first = true;
  template <class D, class A, class B> static HWY_INLINE hn::Mask<D> parts(D d, const A& box, const B& sphere) {
    return batch::HWY_NAMESPACE::parts(d, See::of(d, box, sphere));
  }
  template <class D, class A, class B> HWY_INLINE Verdict<D> operator()(D d, const A& box, const B& sphere) const {
    return rounded_box(d, See::of(d, box, sphere));
  }
};

struct SeeUpright {
  static constexpr std::size_t columns_a = 9, columns_b = 7;

  template <class D, class A, class B> static HWY_INLINE SeenFromBox<D> of(D d, const A& box, const B& sphere) {
    const auto zero = hn::Zero(d);
    return {minus(vector_at(sphere, 0), vector_at(box, 0)),
            minus(vector_at(sphere, 4), vector_at(box, 6)),
            vector_at(box, 3),
            sphere(3),
            no_blur(d),
            hn::Eq(zero, zero)};
  }
};

struct SeeTurned {
  static constexpr std::size_t columns_a = 18, columns_b = 7;

  template <class D, class A, class B> static HWY_INLINE SeenFromBox<D> of(D d, const A& box, const B& sphere) {
    using Vector = Vec3Lanes<hn::Vec<D>>;
    const Vector p = minus(vector_at(sphere, 0), vector_at(box, 0));
    const Vector v = minus(vector_at(sphere, 4), vector_at(box, 15));
    const Vector ax = vector_at(box, 6), ay = vector_at(box, 9), az = vector_at(box, 12);
    const auto zero = hn::Zero(d), one = hn::Set(d, hn::TFromD<D>(1));
    const auto half_radius = hn::Mul(hn::Set(d, hn::TFromD<D>(0.5)), sphere(3));
    const Vector longer{hn::Sub(dot(ax, ax), one), hn::Sub(dot(ay, ay), one), hn::Sub(dot(az, az), one)};
    const auto off = hn::Add(sum(longer), sum(Vector{dot(ax, ay), dot(ay, az), dot(az, ax)}));
    // in axes of length a, R is R a and h is h a^2
    const Vector h = vector_at(box, 3);
    const auto seen = [&](hn::Vec<D> half, hn::Vec<D> more)
                          HWY_ATTR { return hn::Max(hn::MulAdd(hn::Add(half, half_radius), more, half), zero); };
    return {{dot(ax, p), dot(ay, p), dot(az, p)},
            {dot(ax, v), dot(ay, v), dot(az, v)},
            {seen(h.x, longer.x), seen(h.y, longer.y), seen(h.z, longer.z)},
            sphere(3),
            hn::Add(no_blur(d), hn::Add(sum(p), sum(v))),
            hn::And(ordinary(d, h, sphere(3), sum(h)), hn::Le(off, hn::Set(d, Bounds<hn::TFromD<D>>::upright)))};
  }
};

using AabbSphere = RoundedBox<SeeUpright>;
using ObbSphere = RoundedBox<SeeTurned>;

}  // namespace thinwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
