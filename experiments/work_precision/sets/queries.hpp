#pragma once
/// The sets of queries that methods are raced on, each query with its true answer: at 50 digits where nothing turns, in long double where
/// something does.

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include <thinwall/experiments/accuracy/model.hpp>
#include <thinwall/experiments/work_precision/model.hpp>
#include <thinwall/experiments/work_precision/sets/turning_truth.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>

namespace thinwall {

/// A and B move straight, or turn.
template <class A, class B> struct TimedQuery {
  A a;
  B b;
  bool touches;         ///< during the step; never at its start
  long double time;     ///< [1] of first contact, where they touch
  double conditioning;  ///< [1] kappa t, where they touch; infinite of what turns, which no closed form answers
  double path;          ///< [m] length of the relative displacement; of what turns, the speed bound over a step
};

/// As it is on a stretch of a pass: of `length` [m], `from` [m] on. `spin` [rad/m] turns it, if anything turns.
template <bool turns, class A>
auto on_stretch(const A& shape, const Vec3<double>& spin, double from, double length, const Vec3<double>& start,
                const Vec3<double>& displacement) {
  if constexpr (turns) {
    const A there = turned(shape, rotation_about<double>(safe_unit(spin), safe_norm(spin) * from));
    return Turning<A>{moved(there, start), displacement, spin * length};
  } else {
    return Moving<A>{moved(shape, start), displacement};
  }
}

inline Vec3<double> random_half_extents(QueryNumbers& u) {
  const double x = u.between(0.1, 1), y = u.between(0.1, 1), z = u.between(0.1, 1);
  return {x, y, z};
}

/// A straight pass of A beside B, whose center rests at the origin. Both may turn on the way, and are `a` and `b` where A is nearest.
template <class Set> struct Pass {
  using A = typename Set::A;
  using B = typename Set::B;
  static constexpr double before = -2, length = 4;  // of `reach`: from where to where nothing touches before and after

  A a;
  B b;
  Vec3<double> along;                          ///< [1] unit, A's direction
  Vec3<double> aside;                          ///< [m] across it, from B's center to A's line
  double reach;                                ///< [m] farther apart than this, centers have no contact
  Vec3<double> spin_a = Vec3<double>::Zero();  ///< [rad/m] of A's path
  Vec3<double> spin_b = Vec3<double>::Zero();  ///< [rad/m] of the same

  /// [m] From the place nearest to B's center to first contact, along the line; nothing if there is none.
  std::optional<double> contact(double share) const {
    const Vec3<double> start = aside * share + along * (before * reach), none = Vec3<double>::Zero();
    const auto moving_a =
        on_stretch<Set::turns>(a, spin_a, before * reach, length * reach, start, along * (length * reach));
    const auto moving_b = on_stretch<Set::turns>(b, spin_b, before * reach, length * reach, none, none);
    Toi<double> toi;
    if constexpr (Set::turns) {
      toi = time_of_impact(ConservativeAdvancement<double>{1e-10}, moving_a, moving_b);
    } else {
      toi = time_of_impact(moving_a, moving_b);
    }
    if (toi.status == ToiStatus::apart) return {};
    return (length * toi.time + before) * reach;
  }
};

/// The share of `aside` at which the pass just touches.
template <class Set> double touching_share(const Pass<Set>& pass) {
  double hit = 0, miss = 4;
  for (int i = 0; i < 50; ++i) (pass.contact((hit + miss) / 2) ? hit : miss) = (hit + miss) / 2;
  return hit;
}

/// [rad] Up to `most`, about any axis.
inline Vec3<double> turn_of_a_step(QueryNumbers& u, double most) {
  const Vec3<double> axis = u.direction();
  return axis * u.between(0, most);
}

/// One query of the class; both bodies move, and lie anywhere within ten times their size of the origin.
template <class Set> auto draw_of_class(QueryNumbers& u, QueryClass kind, double digits) {
  for (;;) {
    Pass<Set> pass;
    pass.a = Set::draw_a(u);
    pass.b = Set::draw_b(u);
    pass.along = u.direction();
    pass.reach = safe_norm(half_widths(pass.a)) + safe_norm(half_widths(pass.b));
    const double off = kind == QueryClass::graze ? 1 : (kind == QueryClass::miss ? 2 : 1) * std::sqrt(u());
    pass.aside = safe_unit(cross<double>(pass.along, u.direction())) * (off * pass.reach);
    double path = 0;
    const auto draw_path = [&] { path = pass.reach * u.decades(-0.5, 1.5); };
    if constexpr (Set::turns) {
      draw_path();
      pass.spin_a = turn_of_a_step(u, Set::most_turn_a) / path;
      pass.spin_b = turn_of_a_step(u, Set::most_turn_b) / path;
    }
    double share = 1;
    std::optional<double> place = pass.contact(share);
    if (kind == QueryClass::graze) {
      const double threshold = touching_share(pass);
      place = pass.contact(threshold);
      const bool inside = u.one_in(2);
      share = threshold * (1 + (inside ? -1 : 1) * u.decades(-digits, -2));
    } else if (place.has_value() != (kind == QueryClass::hit)) {
      continue;
    }
    if constexpr (!Set::turns) draw_path();
    const double phase = u();
    const double distance = pass.reach * u.between(0, 10), speed = path * u();
    const Vec3<double> origin = u.direction() * distance;
    const Vec3<double> drift = u.direction() * speed;
    const double from = place.value_or(0) - phase * path;
    const Vec3<double> start = origin + pass.aside * share + pass.along * from;
    return std::pair(
        on_stretch<Set::turns>(pass.a, pass.spin_a, from, path, start, Vec3<double>(pass.along * path + drift)),
        on_stretch<Set::turns>(pass.b, pass.spin_b, from, path, origin, drift));
  }
}

/// Nothing touches at the start, what hits does so later, and what misses never; a graze may do either.
inline bool is_of_class(oracle::Verdict verdict, QueryClass kind) {
  if (verdict == oracle::Verdict::overlapping) return false;
  return kind == QueryClass::graze || (verdict == oracle::Verdict::hit) == (kind == QueryClass::hit);
}

/// The truth, from the shapes' own numbers. Nothing if they overlap at the start, or are not of the class.
template <class A, class B>
std::optional<TimedQuery<Moving<A>, Moving<B>>> with_truth(const Moving<A>& a, const Moving<B>& b, QueryClass kind) {
  const Digits50 tolerance = ldexp(Digits50(1), -140);
  const auto problem = oracle::pose<Digits50>(a, b);
  const auto truth = oracle::first_contact(problem, Digits50(0), tolerance);
  if (!is_of_class(truth.verdict, kind)) return {};
  using S = typename A::Scalar;
  const Vec3<S> path = a.displacement - b.displacement;
  return TimedQuery<Moving<A>, Moving<B>>{a,
                                          b,
                                          truth.verdict == oracle::Verdict::hit,
                                          static_cast<long double>(truth.time),
                                          static_cast<double>(truth.conditioning),
                                          static_cast<double>(safe_norm(path))};
}
template <class A, class B>
std::optional<TimedQuery<Turning<A>, Turning<B>>> with_truth(const Turning<A>& a, const Turning<B>& b,
                                                             QueryClass kind) {
  const oracle::TurningTruth truth(a, b);
  if (!is_of_class(truth.verdict, kind)) return {};
  return TimedQuery<Turning<A>, Turning<B>>{a,
                                            b,
                                            truth.verdict == oracle::Verdict::hit,
                                            truth.time,
                                            std::numeric_limits<double>::infinity(),
                                            static_cast<double>(truth.speed)};
}

/// Query `i` of the stream, in S.
template <class Set, class S> auto timed_query(const RandomStream& stream, std::uint64_t i, QueryClass kind) {
  QueryNumbers numbers(stream, i);
  for (;;) {
    const auto [a, b] = draw_of_class<Set>(numbers, kind, std::is_same_v<S, float> ? 3 : Set::turns ? 6 : 8);
    if (const auto query = with_truth(cast<S>(a), cast<S>(b), kind)) return *query;
  }
}

/// What a set is of.
template <class ShapeA, class ShapeB> struct Straight {
  using A = ShapeA;
  using B = ShapeB;
  static constexpr bool turns = false;
};
constexpr double quarter_turn = std::numbers::pi / 2;  // [rad]
struct QuarterTurns {
  static constexpr bool turns = true;
  static constexpr double most_turn_a = quarter_turn, most_turn_b = quarter_turn;
};

/// A ball of 1 to 10 cm and a wall of 2 m by 2 m, 0.1 mm to 10 cm thick.
struct SphereWall : Straight<Sphere<double>, Aabb<double>> {
  static constexpr std::string_view name = "sphere_wall", title = "a small ball and a thin wall";
  static constexpr double key = 1;  // of its random numbers

  static A draw_a(QueryNumbers& u) { return {Vec3<double>::Zero(), u.between(0.01, 0.1)}; }
  static B draw_b(QueryNumbers& u) { return {Vec3<double>::Zero(), {u.decades(-4, -1) / 2, 1, 1}}; }
};

/// Two balls of 0.1 to 1 m.
struct SphereSphere : Straight<Sphere<double>, Sphere<double>> {
  static constexpr std::string_view name = "sphere_sphere", title = "two balls";
  static constexpr double key = 2;  // of its random numbers

  static A draw_a(QueryNumbers& u) { return {Vec3<double>::Zero(), u.between(0.1, 1)}; }
  static B draw_b(QueryNumbers& u) { return draw_a(u); }
};

/// A capsule with a core of 0.2 to 2 m and a radius of 5 to 30 cm, and a box of 0.2 to 2 m a side, both turned any way.
struct CapsuleBox : Straight<Capsule<double>, Obb<double>> {
  static constexpr std::string_view name = "capsule_box", title = "a capsule and a box";
  static constexpr double key = 3;  // of its random numbers

  static A draw_a(QueryNumbers& u) {
    const double half_length = u.between(0.1, 1);
    const Vec3<double> half = u.direction() * half_length;
    return {-half, half, u.between(0.05, 0.3)};
  }
  static B draw_b(QueryNumbers& u) {
    const Vec3<double> half = random_half_extents(u);
    return {Vec3<double>::Zero(), half, random_axes(u)};
  }
};

/// Two boxes of 0.2 to 2 m a side, turned any way.
struct BoxBox : Straight<Obb<double>, Obb<double>> {
  static constexpr std::string_view name = "box_box", title = "two boxes";
  static constexpr double key = 4;  // of its random numbers

  static A draw_a(QueryNumbers& u) {
    const Vec3<double> half = random_half_extents(u);
    return {Vec3<double>::Zero(), half, random_axes(u)};
  }
  static B draw_b(QueryNumbers& u) { return draw_a(u); }
};

/// A rod with a core of 0.2 to 1 m and a radius of 1 to 5 cm, and a wall that stands: of 2 m by 2 m, 0.1 mm to 10 cm thick.
struct TurningRodWall {
  using A = Capsule<double>;
  using B = Obb<double>;
  static constexpr std::string_view name = "turning_rod_wall", title = "a rod that turns and a thin wall";
  static constexpr bool turns = true;
  static constexpr double most_turn_a = quarter_turn, most_turn_b = 0;
  static constexpr double key = 5;  // of its random numbers

  static A draw_a(QueryNumbers& u) {
    const double half_length = u.between(0.1, 0.5);
    const Vec3<double> half = u.direction() * half_length;
    return {-half, half, u.between(0.01, 0.05)};
  }
  static B draw_b(QueryNumbers& u) { return to_obb(SphereWall::draw_b(u)); }
};

/// The same capsules and boxes as where nothing turns.
struct TurningCapsuleBox : CapsuleBox, QuarterTurns {
  static constexpr std::string_view name = "turning_capsule_box", title = "a capsule and a box that turn";
  using QuarterTurns::turns;
  static constexpr double key = 6;  // of its random numbers
};

/// The same boxes as where nothing turns.
struct TurningBoxBox : BoxBox, QuarterTurns {
  static constexpr std::string_view name = "turning_box_box", title = "two boxes that turn";
  using QuarterTurns::turns;
  static constexpr double key = 7;  // of its random numbers
};

}  // namespace thinwall
