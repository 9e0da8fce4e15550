// A capsule and a sphere, lane by lane: the capsule widened by the sphere's radius, and the sphere's center on its way.
//
// The center enters the endless cylinder around the axis beside the segment, and touches there, or beyond one end, and then it can
// touch only the ball around that end. With m the place from end a, d the axis, w = v x d:
//
//   t = (|m x d|^2 - R^2 d.d) / (-(m x d).w + sqrt(d.d (R^2 w.w - ((m x d).v)^2))).
//
// Columns of a capsule: 0-2 a, 3-5 b, 6 radius, 7-9 displacement; of a sphere: 0-2 center, 3 radius, 4-6 displacement.

#if defined(THINWALL_BATCH_CAPSULE_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef THINWALL_BATCH_CAPSULE_LANES
#undef THINWALL_BATCH_CAPSULE_LANES
#else
#define THINWALL_BATCH_CAPSULE_LANES
#endif

#include <thinwall/swept/batch/ball_lanes.inl>

HWY_BEFORE_NAMESPACE();
namespace thinwall::batch::HWY_NAMESPACE {

struct CapsuleSphere {
  static constexpr std::size_t columns_a = 10, columns_b = 7;

  template <class D, class A, class B> HWY_INLINE Verdict<D> operator()(D d, const A& capsule, const B& sphere) const {
    using S = hn::TFromD<D>;
    using Limits = Bounds<S>;
    using Vector = Vec3Lanes<hn::Vec<D>>;
    const auto zero = hn::Zero(d), one = hn::Set(d, S(1));
    const Vector a = vector_at(capsule, 0), b = vector_at(capsule, 3);
    const Vector c = vector_at(sphere, 0);
    const Vector m = minus(c, a), axis = minus(b, a);
    const Vector v = minus(vector_at(sphere, 4), vector_at(capsule, 7));
    const auto R = hn::Add(capsule(6), sphere(3)), RR = hn::Mul(R, R);
    const auto dd = dot(axis, axis), mm = dot(m, m), vv = dot(v, v);

    // The endless cylinder. A place is known to a rounding of the whole capsule, as the scalar code sees it from the middle of the segment.
    const Vector k = cross(m, axis), w = cross(v, axis);
    const auto kk = dot(k, k), ww = dot(w, w), offset = dot(k, v), path = sum(v);
    const auto whole = hn::Add(sum(m), sum(axis)), place = hn::Mul(hn::Mul(whole, whole), dd);
    const auto reach = hn::Mul(RR, ww), discriminant = hn::NegMulAdd(offset, offset, reach);
    const auto noise =
        hn::MulAdd(hn::Set(d, Limits::graze), reach, hn::Mul(hn::Set(d, Limits::far * 16), hn::Mul(place, vv)));
    const auto within = hn::Mul(RR, dd), excess = hn::Sub(kk, within), square = hn::Add(place, within);
    const auto denominator = hn::Sub(hn::Sqrt(hn::Mul(dd, hn::Max(discriminant, zero))), dot(k, w));
    const auto entry = hn::Div(excess, denominator), late = hn::Sub(excess, denominator);
    const auto roundings =
        hn::Mul(hn::Mul(hn::Set(d, Limits::end_of_blur * Limits::length / 8), whole), hn::Mul(path, dd));
    const auto end = hn::MulAdd(hn::Set(d, Limits::end), hn::Add(square, hn::Abs(denominator)), roundings);
    // Rounding leans w along the axis, which counts by the way to its end. A hit is clear if the normal's share along w is at most 8 times the
    // sine between path and axis; of what passes less is asked.
    const auto leans = hn::Mul(hn::Sub(reach, hn::Abs(discriminant)), hn::Mul(vv, dd));
    const auto steady = hn::MulSub(hn::Mul(hn::Set(d, S(64)), reach), ww, leans);
    const auto sure = hn::Min(hn::Min(hn::Sub(hn::Abs(discriminant), noise), steady), hn::Sub(hn::Abs(late), end));
    const auto touch = hn::Mul(hn::Set(d, Limits::touch), square);
    const auto starts_clear = hn::Gt(hn::Abs(excess), touch);
    const auto inside = hn::Lt(excess, zero);
    const auto crosses = hn::AndNot(inside, hn::And(hn::Gt(denominator, zero), hn::Gt(discriminant, zero)));

    // Where along the axis: at the start, where that is in the cylinder, else at its entry.
    const auto from_start = hn::IfThenZeroElse(inside, entry), advance = dot(v, axis);
    const auto along = hn::MulAdd(advance, from_start, dot(m, axis));
    const auto beyond_b = hn::Gt(along, dd), beyond = hn::Or(hn::Lt(along, zero), beyond_b);
    const auto to_junction = hn::Min(hn::Abs(along), hn::Abs(hn::Sub(along, dd)));
    const auto beside_noise = hn::Mul(hn::Set(d, Limits::length), hn::Mul(whole, whole));
    const auto off = hn::Add(hn::Add(touch, roundings), hn::Mul(hn::Set(d, Limits::length), denominator));
    const auto entry_noise = hn::IfThenZeroElse(inside, hn::Div(hn::Mul(hn::Abs(advance), off), denominator));
    const auto known =
        hn::Or(hn::Not(hn::Or(inside, crosses)), hn::Gt(to_junction, hn::Add(beside_noise, entry_noise)));
    const Vector from_b = minus(c, b);
    const Vector q{hn::IfThenElse(beyond_b, from_b.x, m.x), hn::IfThenElse(beyond_b, from_b.y, m.y),
                   hn::IfThenElse(beyond_b, from_b.z, m.z)};
    const Blur<D> blur{hn::Mul(hn::Set(d, Limits::length), hn::Add(largest(m), largest(axis))), path};
    const auto at_end = verdict_of(d, chord_lanes(d, q, v, R, &blur));

    const auto most = hn::Set(d, Limits::most_capsule), least = hn::Set(d, Limits::least_capsule);
    const auto size = hn::Max(hn::Max(largest(m), largest(axis)), hn::Max(largest(v), R));
    const auto smallest = hn::Min(hn::Min(largest(m), largest(axis)), largest(v));
    const auto sums = hn::Add(hn::Add(mm, dd), vv);
    const auto valid = hn::And(hn::Ge(hn::Min(capsule(6), sphere(3)), zero), hn::Eq(sums, sums));
    const auto ordinary = hn::And(hn::And(valid, hn::Gt(smallest, least)), hn::Le(size, most));

    const auto by_ball = hn::And(beyond, hn::Or(inside, crosses));
    const auto side = hn::And(hn::And(starts_clear, known), hn::Or(inside, hn::Gt(sure, zero)));
    const auto meets_side = hn::AndNot(by_ball, hn::And(crosses, hn::Lt(late, zero)));
    Verdict<D> out;
    out.hit = hn::Or(meets_side, hn::And(by_ball, at_end.hit));
    out.overlapping = hn::AndNot(by_ball, inside);
    out.overlapping = hn::Or(out.overlapping, hn::And(by_ball, at_end.overlapping));
    out.clear = hn::And(hn::And(ordinary, side), hn::Or(hn::Not(by_ball), at_end.clear));
    out.time = hn::IfThenElse(meets_side, entry, hn::IfThenElse(by_ball, at_end.time, one));
    return out;
  }
};

}  // namespace thinwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
