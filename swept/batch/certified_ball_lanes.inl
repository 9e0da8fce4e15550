// Sphere and sphere, lane by lane and proven: swept/certified/filters.hpp, with its bounds (docs/certified.md derives them; a
// fused multiply-add rounds less often than they allow for). Columns: 0-2 center, 3 radius, 4-6 displacement, of either.

#if defined(THINWALL_BATCH_CERTIFIED_BALL_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef THINWALL_BATCH_CERTIFIED_BALL_LANES
#undef THINWALL_BATCH_CERTIFIED_BALL_LANES
#else
#define THINWALL_BATCH_CERTIFIED_BALL_LANES
#endif

#include <thinwall/swept/batch/lanes.inl>

HWY_BEFORE_NAMESPACE();
namespace thinwall::batch::HWY_NAMESPACE {

/// A verdict with both bounds; `time` is the lower one.
template <class D> struct CertifiedVerdict : Verdict<D> {
  hn::Vec<D> upper;
};

struct CertifiedSphereSphere {
  static constexpr std::size_t columns_a = 7, columns_b = 7;

  template <class D, class A, class B> HWY_INLINE CertifiedVerdict<D> operator()(D d, const A& a, const B& b) const {
    const auto set = [d](double x) HWY_ATTR { return hn::Set(d, x); };
    constexpr double u = 0x1p-53;
    const auto zero = hn::Zero(d), one = set(1), least = set(0x1p-400), most = set(0x1p400);
    const Vec3Lanes<hn::Vec<D>> p = minus(vector_at(a, 0), vector_at(b, 0));
    const Vec3Lanes<hn::Vec<D>> v = minus(vector_at(a, 4), vector_at(b, 4));
    const auto R = hn::Add(a(3), b(3)), RR = hn::Mul(R, R);
    const auto pp = dot(p, p), vv = dot(v, v), size = hn::Add(pp, RR);

    const auto c = hn::Sub(pp, RR), c_error = hn::Mul(set(8 * u), size);
    const auto px = hn::Mul(p.x, v.x), py = hn::Mul(p.y, v.y), pz = hn::Mul(p.z, v.z);
    const auto along = hn::Add(hn::Add(px, py), pz);
    const auto along_size = hn::Add(hn::Add(hn::Abs(px), hn::Abs(py)), hn::Abs(pz));
    const auto along_error = hn::MulAdd(set(6 * u), along_size, set(0x1p-1022));

    auto mm = zero, products = zero;  // of p x v: its square, and its components times the magnitudes they are made of
    const auto add_moment = [&](hn::Vec<D> first, hn::Vec<D> second) HWY_ATTR {
      const auto m = hn::Sub(first, second);
      mm = hn::MulAdd(m, m, mm);
      products = hn::MulAdd(hn::Abs(m), hn::Add(hn::Abs(first), hn::Abs(second)), products);
    };
    add_moment(hn::Mul(p.y, v.z), hn::Mul(p.z, v.y));
    add_moment(hn::Mul(p.z, v.x), hn::Mul(p.x, v.z));
    add_moment(hn::Mul(p.x, v.y), hn::Mul(p.y, v.x));
    const auto reach = hn::Mul(vv, RR), discriminant = hn::Sub(reach, mm);
    const auto rounds = hn::MulAdd(set(14), reach, hn::MulAdd(set(6), mm, hn::Mul(set(9), products)));
    const auto error = hn::MulAdd(set(u), rounds, hn::Mul(set(64 * u * u), hn::Mul(vv, pp)));

    const auto root = [&](hn::Vec<D> x) HWY_ATTR { return hn::Sqrt(hn::Max(x, zero)); };
    const auto lower =
        hn::Mul(hn::Div(hn::Sub(c, c_error), hn::Add(hn::Sub(along_error, along), root(hn::Add(discriminant, error)))),
                set(1 - 8 * u));
    const auto upper = hn::Mul(
        hn::Div(hn::Add(c, c_error), hn::Add(hn::Neg(hn::Add(along, along_error)), root(hn::Sub(discriminant, error)))),
        set(1 + 8 * u));

    const auto valid = hn::Ge(hn::Min(a(3), b(3)), zero);
    const auto sized = hn::And(valid, hn::And(hn::Ge(size, least), hn::Le(size, most)));
    const auto outside = hn::And(sized, hn::Gt(c, c_error)), moving = hn::And(hn::Ge(vv, least), hn::Le(vv, most));
    const auto still = hn::And(hn::Eq(v.x, zero), hn::And(hn::Eq(v.y, zero), hn::Eq(v.z, zero)));
    const auto recedes = hn::Ge(along, along_error), passes = hn::Lt(discriminant, hn::Neg(error));
    const auto meets =
        hn::And(hn::And(outside, moving), hn::And(hn::Gt(discriminant, error), hn::Lt(along, hn::Neg(along_error))));
    const auto narrow = hn::Le(hn::Sub(upper, lower), hn::Mul(set(0x1p-26), upper));
    CertifiedVerdict<D> out;
    out.overlapping = hn::And(sized, hn::And(hn::Lt(c, hn::Neg(c_error)), hn::Le(vv, most)));
    out.hit = hn::And(meets, hn::And(narrow, hn::Le(upper, one)));
    const auto never = hn::And(outside, hn::Or(still, hn::And(moving, hn::Or(recedes, passes))));
    const auto apart = hn::Or(never, hn::And(meets, hn::Gt(lower, one)));
    out.clear = hn::Or(apart, hn::Or(out.hit, out.overlapping));
    out.time = hn::IfThenElse(out.hit, lower, one);
    out.upper = hn::IfThenElse(out.hit, upper, one);
    return out;
  }
};

}  // namespace thinwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
