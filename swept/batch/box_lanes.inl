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

struct AabbAabb {
  static constexpr std::size_t columns_a = 9, columns_b = 9;

  template <class D, class A, class B> HWY_INLINE Verdict<D> operator()(D d, const A& a, const B& b) const {
    const auto zero = hn::Zero(d), one = hn::Set(d, hn::TFromD<D>(1));
    const VectorOf<D> p{hn::Sub(b(0), a(0)), hn::Sub(b(1), a(1)), hn::Sub(b(2), a(2))};
    const VectorOf<D> v{hn::Sub(b(6), a(6)), hn::Sub(b(7), a(7)), hn::Sub(b(8), a(8))};
    const VectorOf<D> h{hn::Add(a(3), b(3)), hn::Add(a(4), b(4)), hn::Add(a(5), b(5))};
    const auto box = box_lanes(d, p, v, h, zero, zero, one);
    const auto smallest = hn::Min(hn::Min(hn::Min(a(3), b(3)), hn::Min(a(4), b(4))), hn::Min(a(5), b(5)));
    const auto valid = hn::And(box.ordinary, hn::Ge(smallest, zero));
    return {hn::And(valid, box.reached), hn::And(valid, box.unreached), hn::And(valid, box.starts_in),
            hn::IfThenElse(box.reached, box.first, one)};
  }
};

struct AabbRay {
  static constexpr std::size_t columns_a = 6, columns_b = 7;

  template <class D, class A, class B> HWY_INLINE Verdict<D> operator()(D d, const A& box, const B& ray) const {
    const auto zero = hn::Zero(d), until = ray(6);
    const VectorOf<D> p{hn::Sub(ray(0), box(0)), hn::Sub(ray(1), box(1)), hn::Sub(ray(2), box(2))};
    const VectorOf<D> v{ray(3), ray(4), ray(5)}, h{box(3), box(4), box(5)};
    const auto lanes = box_lanes(d, p, v, h, zero, zero, until);
    const auto counts = [&](hn::Vec<D> x) HWY_ATTR {  // in any time that the ray may take
      return hn::Or(hn::Ge(hn::Abs(x), hn::Set(d, Bounds<hn::TFromD<D>>::still)), hn::Eq(x, zero));
    };
    const auto all_count = hn::And(counts(v.x), hn::And(counts(v.y), counts(v.z)));
    const auto valid = hn::And(hn::And(lanes.ordinary, all_count), hn::Ge(until, zero));
    const auto apart = hn::And(valid, lanes.unreached);
    return {hn::And(valid, lanes.reached), apart, hn::And(valid, lanes.starts_in),
            hn::IfThenElse(apart, until, lanes.first)};
  }
};

}  // namespace thinwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
