// A line p + v t and the box [-h, h] widened by R, lane by lane: the slab times of swept/closed_form/rounded_box_entry.hpp, with what is clear.

#if defined(THINWALL_BATCH_SLAB_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef THINWALL_BATCH_SLAB_LANES
#undef THINWALL_BATCH_SLAB_LANES
#else
#define THINWALL_BATCH_SLAB_LANES
#endif

#include <limits>

#include <thinwall/swept/batch/lanes.inl>

HWY_BEFORE_NAMESPACE();
namespace thinwall::batch::HWY_NAMESPACE {

/// One axis of the widened box, seen so that the point moves downwards.
template <class D> struct SlabLanes {
  using V = hn::Vec<D>;
  V place, speed, half;
  V low, high;                ///< [length] to where the slab begins and ends, not widened
  V per_speed;                ///< 1 / speed
  V noise;                    ///< [length] how far the place may be off
  V enter;                    ///< [1] when p is in the widened slab
  V enter_least, enter_most;  ///< [1] at the earliest and at the latest
  V leave_least, leave_most;
};

/// `room` [length] is the radius and what else p and v t are known to have been rounded from.
/// A speed so low that it cannot count is put up to one that cannot either, so that nothing is divided by zero.
template <class D>
HWY_INLINE SlabLanes<D> slab_lanes(D d, hn::Vec<D> p, hn::Vec<D> v, hn::Vec<D> h, hn::Vec<D> R, hn::Vec<D> room) {
  using B = Bounds<hn::TFromD<D>>;
  SlabLanes<D> out;
  out.place = hn::Xor(p, hn::AndNot(v, hn::SignBit(d)));
  out.speed = hn::Max(hn::Abs(v), hn::Set(d, B::still));
  out.half = h;
  out.low = hn::Sub(out.place, h);
  out.high = hn::Add(out.place, h);
  out.per_speed = hn::Div(hn::Set(d, hn::TFromD<D>(1)), out.speed);
  out.noise = hn::Mul(hn::Set(d, B::length), hn::Add(hn::Add(hn::Abs(p), h), room));
  const auto near = hn::Sub(out.low, R), far = hn::Add(out.high, R), off = hn::Mul(out.noise, out.per_speed);
  out.enter = hn::Mul(near, out.per_speed);
  out.enter_least = hn::MulSub(near, out.per_speed, off);
  out.enter_most = hn::MulAdd(near, out.per_speed, off);
  out.leave_least = hn::MulSub(far, out.per_speed, off);
  out.leave_most = hn::MulAdd(far, out.per_speed, off);
  return out;
}

/// No size is negative, and `lengths`, the sum of all, is a number and not so large that a product of four overflows. Max and Min pass
/// over a NaN on some machines; a sum does not.
template <class D>
HWY_INLINE hn::Mask<D> ordinary(D d, const Vec3Lanes<hn::Vec<D>>& h, hn::Vec<D> R, hn::Vec<D> lengths) {
  const auto sized = hn::Ge(hn::Min(smallest(h), R), hn::Zero(d));
  return hn::And(sized, hn::Le(lengths, hn::Set(d, Bounds<hn::TFromD<D>>::most_length)));
}

/// All three.
template <class D> struct BoxLanes {
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  SlabLanes<D> x, y, z;
  V first;                     ///< [1] when p enters the last of the widened slabs
  V earliest, latest;          ///< [1] between which that truly lies
  V earliest_out, latest_out;  ///< [1] between which it leaves the first of them
  M never;                     ///< clearly not in all of them during the step
  M ordinary;                  ///< as ordinary()
};

/// A length that is none where places are exact, for `blur`: a flat box and a point in its plane have noise too, and so have numbers
/// whose roundings underflow.
template <class D> HWY_INLINE hn::Vec<D> no_blur(D d) { return hn::Set(d, Bounds<hn::TFromD<D>>::least_length); }

/// `blur` [length]: as of slab_lanes, beside the radius; at least no_blur().
template <class D>
HWY_INLINE BoxLanes<D> box_lanes(D d, const Vec3Lanes<hn::Vec<D>>& p, const Vec3Lanes<hn::Vec<D>>& v,
                                 const Vec3Lanes<hn::Vec<D>>& h, hn::Vec<D> R, hn::Vec<D> blur, hn::Vec<D> until) {
  using B = Bounds<hn::TFromD<D>>;
  const auto zero = hn::Zero(d), room = hn::Add(R, blur);
  BoxLanes<D> out;
  out.x = slab_lanes(d, p.x, v.x, h.x, R, room);
  out.y = slab_lanes(d, p.y, v.y, h.y, R, room);
  out.z = slab_lanes(d, p.z, v.z, h.z, R, room);
  const auto &x = out.x, &y = out.y, &z = out.z;
  out.first = hn::Max(x.enter, hn::Max(y.enter, z.enter));
  out.earliest = hn::Max(x.enter_least, hn::Max(y.enter_least, z.enter_least));
  out.latest = hn::Max(x.enter_most, hn::Max(y.enter_most, z.enter_most));
  out.earliest_out = hn::Min(x.leave_least, hn::Min(y.leave_least, z.leave_least));
  out.latest_out = hn::Min(x.leave_most, hn::Min(y.leave_most, z.leave_most));
  const auto passed = hn::Lt(out.latest_out, hn::Min(out.earliest, hn::Set(d, B::latest)));
  out.never = hn::Or(passed, hn::Or(hn::Gt(out.earliest, until), hn::Lt(out.latest_out, zero)));
  out.ordinary = ordinary(d, h, R, hn::Add(sum(p), hn::Add(sum(h), hn::Add(R, sum(v)))));
  return out;
}

}  // namespace thinwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
