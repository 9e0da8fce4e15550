// A line p + v t and the box [-h, h] widened by R, lane by lane: discrete/entry's slab times, with what is clear.

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

/// One axis of the widened box.
template <class D> struct SlabLanes {
  using V = hn::Vec<D>;
  V enter, leave;  ///< [1] when p is in the widened slab
  V noise;         ///< [1] how far both may be off
  V own_enter, own_leave;
  V before, after;  ///< [length] p beyond the face met first, and beyond the opposite one, along the axis
};

/// `blur` [length] is what p and v t are known to have been rounded from.
/// A speed so low that it cannot count is put up to one that cannot either, so that nothing is divided by zero.
template <class D>
HWY_INLINE SlabLanes<D> slab_lanes(D d, hn::Vec<D> p, hn::Vec<D> v, hn::Vec<D> h, hn::Vec<D> R, hn::Vec<D> blur) {
  using B = Bounds<hn::TFromD<D>>;
  const auto still = hn::Set(d, B::still);
  const auto speed = hn::IfThenElse(hn::Lt(hn::Abs(v), still), hn::CopySign(still, v), v);
  const auto per_speed = hn::Div(hn::Set(d, hn::TFromD<D>(1)), speed);
  const auto face = hn::CopySign(h, v), radius = hn::CopySign(R, v);
  SlabLanes<D> out;
  out.before = hn::Add(p, face);
  out.after = hn::Sub(p, face);
  out.enter = hn::Mul(hn::Neg(hn::Add(out.before, radius)), per_speed);
  out.leave = hn::Mul(hn::Sub(radius, out.after), per_speed);
  out.own_enter = hn::Mul(hn::Neg(out.before), per_speed);
  out.own_leave = hn::Mul(hn::Neg(out.after), per_speed);
  const auto least =
      hn::Set(d, B::least_length);  // without it a flat box and a point in its plane would leave no noise
  const auto lengths = hn::Add(hn::Add(hn::Abs(p), blur), hn::Add(hn::Add(h, R), least));
  out.noise = hn::Mul(hn::Set(d, B::length), hn::Mul(lengths, hn::Abs(per_speed)));
  return out;
}

/// All three.
template <class D> struct BoxLanes {
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  SlabLanes<D> x, y, z;
  V first;               ///< [1] when p enters the last of the widened slabs
  V earliest, latest;    ///< [1] between which that truly lies
  M starts_out;          ///< clearly outside one of them at the start
  M starts_in;           ///< clearly inside all of them
  M reached, unreached;  ///< in all of them during the step from `first` on, or never, clearly
  M ordinary;
};

template <class D>
HWY_INLINE BoxLanes<D> box_lanes(D d, const Vec3Lanes<hn::Vec<D>>& p, const Vec3Lanes<hn::Vec<D>>& v,
                                 const Vec3Lanes<hn::Vec<D>>& h, hn::Vec<D> R, hn::Vec<D> blur, hn::Vec<D> until) {
  using B = Bounds<hn::TFromD<D>>;
  const auto zero = hn::Zero(d);
  BoxLanes<D> out;
  out.x = slab_lanes(d, p.x, v.x, h.x, R, blur);
  out.y = slab_lanes(d, p.y, v.y, h.y, R, blur);
  out.z = slab_lanes(d, p.z, v.z, h.z, R, blur);
  const auto &x = out.x, &y = out.y, &z = out.z;
  out.first = hn::Max(x.enter, hn::Max(y.enter, z.enter));
  const auto earliest_in =
      hn::Max(hn::Sub(x.enter, x.noise), hn::Max(hn::Sub(y.enter, y.noise), hn::Sub(z.enter, z.noise)));
  const auto latest_in =
      hn::Max(hn::Add(x.enter, x.noise), hn::Max(hn::Add(y.enter, y.noise), hn::Add(z.enter, z.noise)));
  const auto earliest_out =
      hn::Min(hn::Sub(x.leave, x.noise), hn::Min(hn::Sub(y.leave, y.noise), hn::Sub(z.leave, z.noise)));
  const auto latest_out =
      hn::Min(hn::Add(x.leave, x.noise), hn::Min(hn::Add(y.leave, y.noise), hn::Add(z.leave, z.noise)));
  out.earliest = earliest_in;
  out.latest = latest_in;
  out.starts_out = hn::Or(hn::Gt(earliest_in, zero), hn::Lt(latest_out, zero));
  out.starts_in = hn::And(hn::Lt(latest_in, zero), hn::Gt(earliest_out, zero));
  // Slabs that may be the last one entered may differ in conditioning, and then the one with less noise tells the time.
  const auto never = hn::Set(d, std::numeric_limits<hn::TFromD<D>>::infinity());
  const auto contending = [&](const SlabLanes<D>& slab) HWY_ATTR {
    return hn::IfThenElse(hn::Ge(hn::Add(slab.enter, slab.noise), earliest_in), slab.noise, never);
  };
  const auto least_noise = hn::Min(contending(x), hn::Min(contending(y), contending(z)));
  const auto is_sharp = hn::Le(hn::Sub(latest_in, earliest_in), hn::Mul(hn::Set(d, hn::TFromD<D>(4)), least_noise));
  const auto in_time = hn::Lt(latest_in, hn::Min(until, hn::Set(d, B::latest)));
  out.reached =
      hn::And(hn::And(is_sharp, hn::Gt(earliest_in, zero)), hn::And(hn::Lt(latest_in, earliest_out), in_time));
  const auto passed = hn::And(hn::Gt(earliest_in, latest_out), hn::Lt(latest_out, hn::Set(d, B::latest)));
  out.unreached = hn::Or(passed, hn::Or(hn::Gt(earliest_in, until), hn::Lt(latest_out, zero)));
  const auto most = hn::Set(d, B::most_length), least = hn::Set(d, B::least_length);
  const auto sizes = hn::Max(largest(p), hn::Max(largest(h), R));
  const auto smallest = hn::Min(hn::Min(h.x, h.y), hn::Min(h.z, R));
  const auto lengths = hn::And(hn::And(hn::Le(sizes, most), hn::Ge(sizes, least)), hn::Ge(smallest, zero));
  // Max and Min pass over a NaN on some machines; a sum does not.
  const auto all = hn::Add(hn::Add(hn::Add(p.x, p.y), hn::Add(p.z, h.x)), hn::Add(hn::Add(h.y, h.z), R));
  const auto speeds = hn::Add(hn::Add(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
  out.ordinary = hn::And(hn::And(lengths, hn::Eq(all, all)), hn::Le(speeds, most));
  return out;
}

}  // namespace thinwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
