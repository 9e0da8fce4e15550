// Sphere and sphere, lane by lane. Columns: 0-2 center, 3 radius, 4-6 displacement, of either.

#if defined(THINWALL_BATCH_BALL_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef THINWALL_BATCH_BALL_LANES
#undef THINWALL_BATCH_BALL_LANES
#else
#define THINWALL_BATCH_BALL_LANES
#endif

#include <thinwall/swept/batch/lanes.inl>

HWY_BEFORE_NAMESPACE();
namespace thinwall::batch::HWY_NAMESPACE {

struct SphereSphere {
  static constexpr std::size_t columns_a = 7, columns_b = 7;

  template <class D, class A, class B> HWY_INLINE Verdict<D> operator()(D d, const A& a, const B& b) const {
    const Vec3Lanes<hn::Vec<D>> p = minus(vector_at(b, 0), vector_at(a, 0));
    const Vec3Lanes<hn::Vec<D>> v = minus(vector_at(b, 4), vector_at(a, 4));
    Verdict<D> out = verdict_of(d, chord_lanes(d, p, v, hn::Add(a(3), b(3))));
    out.clear = hn::And(out.clear, hn::Ge(hn::Min(a(3), b(3)), hn::Zero(d)));
    return out;
  }
};

}  // namespace thinwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
