// The kernels of sharp boxes, lane by lane: AABB and AABB, and rays at an AABB.
// Columns of a box: 0-2 center, 3-5 half extents, 6-8 displacement; of a ray: 0-2 origin, 3-5 direction, 6 max_t.

#if defined(THINWALL_BATCH_BOX_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef THINWALL_BATCH_BOX_LANES
#undef THINWALL_BATCH_BOX_LANES
#else
#define THINWALL_BATCH_BOX_LANES
#endif

#include <thinwall/swept/batch/slab_lanes.inl>

HWY_BEFORE_NAMESPACE();
namespace thinwall::batch::HWY_NAMESPACE {

template <class D> using VectorOf = Vec3Lanes<hn::Vec<D>>;

/// A point's verdict, and its time of entry, where the box has sharp edges. Slabs that may be the last one entered may differ in
/// conditioning, and then the one with less noise tells the time: such rows are not clear.
template <class D> HWY_INLINE Verdict<D> sharp_box(D d, const BoxLanes<D>& box, hn::Vec<D> until) {
  using S = hn::TFromD<D>;
  const auto zero = hn::Zero(d), never = hn::Set(d, std::numeric_limits<S>::infinity());
  const auto contending = [&](const SlabLanes<D>& slab) HWY_ATTR {
    return hn::IfThenElse(hn::Ge(slab.enter_most, box.earliest), hn::Sub(slab.enter_most, slab.enter), never);
  };
  const auto least_noise = hn::Min(contending(box.x), hn::Min(contending(box.y), contending(box.z)));
  const auto is_sharp = hn::Le(hn::Sub(box.latest, box.earliest), hn::Mul(hn::Set(d, S(4)), least_noise));
  const auto before = hn::Min(box.earliest_out, hn::Min(until, hn::Set(d, Bounds<S>::latest)));
  Verdict<D> out;
  out.hit = hn::And(is_sharp, hn::And(hn::Gt(box.earliest, zero), hn::Lt(box.latest, before)));
  out.overlapping = hn::And(hn::Lt(box.latest, zero), hn::Gt(box.earliest_out, zero));
  out.clear = hn::And(box.ordinary, hn::Or(box.never, hn::Or(out.hit, out.overlapping)));
  out.time = hn::IfThenElse(out.hit, box.first, until);
  return out;
}

struct AabbAabb {
  static constexpr std::size_t columns_a = 9, columns_b = 9;

  template <class D, class A, class B> HWY_INLINE Verdict<D> operator()(D d, const A& a, const B& b) const {
    const auto zero = hn::Zero(d), one = hn::Set(d, hn::TFromD<D>(1));
    const VectorOf<D> p = minus(vector_at(b, 0), vector_at(a, 0));
    const VectorOf<D> v = minus(vector_at(b, 6), vector_at(a, 6));
    const VectorOf<D> h{hn::Add(a(3), b(3)), hn::Add(a(4), b(4)), hn::Add(a(5), b(5))};
    auto out = sharp_box(d, box_lanes(d, p, v, h, zero, no_blur(d), one), one);
    const VectorOf<D> halves{hn::Min(a(3), b(3)), hn::Min(a(4), b(4)), hn::Min(a(5), b(5))};
    out.clear = hn::And(out.clear, hn::Ge(smallest(halves), zero));
    return out;
  }
};

struct AabbRay {
  static constexpr std::size_t columns_a = 6, columns_b = 7;

  template <class D, class A, class B> HWY_INLINE Verdict<D> operator()(D d, const A& box, const B& ray) const {
    const auto zero = hn::Zero(d), until = ray(6);
    const VectorOf<D> p = minus(vector_at(ray, 0), vector_at(box, 0));
    const VectorOf<D> v = vector_at(ray, 3), h = vector_at(box, 3);
    auto out = sharp_box(d, box_lanes(d, p, v, h, zero, no_blur(d), until), until);
    const auto counts = [&](hn::Vec<D> x) HWY_ATTR {  // in any time that the ray may take
      return hn::Or(hn::Ge(hn::Abs(x), hn::Set(d, Bounds<hn::TFromD<D>>::still)), hn::Eq(x, zero));
    };
    const auto all_count = hn::And(counts(v.x), hn::And(counts(v.y), counts(v.z)));
    out.clear = hn::And(hn::And(out.clear, all_count), hn::Ge(until, zero));
    return out;
  }
};

}  // namespace thinwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
