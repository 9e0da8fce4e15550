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

/// Of a chord whose line is walked from time 0.
template <class D> HWY_INLINE Verdict<D> verdict_of(D d, const ChordLanes<D>& chord) {
  const auto zero = hn::Zero(d);
  const auto toward = hn::Lt(chord.recess, zero);
  const auto hit = hn::And(hn::And(chord.chord, chord.before_end), toward);
  const auto miss = hn::Or(chord.none, hn::Or(hn::And(chord.chord, chord.after_end), hn::Ge(chord.recess, zero)));
  const auto outside = hn::And(chord.ordinary, chord.outside);
  const auto time = hn::IfThenElse(hit, chord.time, hn::Set(d, hn::TFromD<D>(1)));
  return {hn::And(outside, hit), hn::And(outside, miss), hn::And(chord.ordinary, chord.inside), time};
}

struct SphereSphere {
  static constexpr std::size_t columns_a = 7, columns_b = 7;

  template <class D, class A, class B> HWY_INLINE Verdict<D> operator()(D d, const A& a, const B& b) const {
    const Vec3Lanes<hn::Vec<D>> p{hn::Sub(b(0), a(0)), hn::Sub(b(1), a(1)), hn::Sub(b(2), a(2))};
    const Vec3Lanes<hn::Vec<D>> v{hn::Sub(b(4), a(4)), hn::Sub(b(5), a(5)), hn::Sub(b(6), a(6))};
    Verdict<D> out = verdict_of(d, chord_lanes(d, p, v, hn::Add(a(3), b(3)), hn::Zero(d)));
    const auto valid = hn::Ge(hn::Min(a(3), b(3)), hn::Zero(d));
    out.hit = hn::And(out.hit, valid);
    out.apart = hn::And(out.apart, valid);
    out.overlapping = hn::And(out.overlapping, valid);
    return out;
  }
};

}  // namespace thinwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
