#pragma once
/// Times of impact known exactly: touches, grazes by one unit in the last place, extreme scales, thin walls.
///
/// Inputs are written as doubles. A scalar that does not hold one takes its nearest value, and then the oracle alone
/// says what is right; a scalar in which one overflows or vanishes leaves the case out.

#include <optional>
#include <string>
#include <vector>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "support/real.hpp"

namespace thinwall::testing {

template <class A, class B> struct ExactCase {
  std::string name;
  Moving<A> a;
  Moving<B> b;
  ToiStatus status;
  std::optional<double> listed;  ///< the time in double, from rational arithmetic
  bool as_written;               ///< the scalar holds every input: `status` must come out
};

/// Collects cases, and notes which inputs a scalar could not hold.
template <class S, class B> class CaseTable {
 public:
  using Case = ExactCase<Sphere<S>, B>;

  /// The scalar's value for x.
  S operator()(double x) {
    const S value = static_cast<S>(x);
    if (value - value != S(0) || (value == S(0) && x != 0)) out_of_range_ = true;
    if (oracle::Real(value) != oracle::Real(x)) as_written_ = false;
    return value;
  }
  Vec3<S> operator()(double x, double y, double z) { return {(*this)(x), (*this)(y), (*this)(z)}; }
  Sphere<S> ball(const Vec3<S>& center, double radius) { return {center, (*this)(radius)}; }

  void add(std::string name, const Moving<Sphere<S>>& a, const Moving<B>& b, ToiStatus status,
           std::optional<double> listed = {}) {
    if (!out_of_range_) cases_.push_back({std::move(name), a, b, status, listed, as_written_});
    out_of_range_ = false;
    as_written_ = true;
  }
  const std::vector<Case>& cases() const { return cases_; }

 private:
  bool out_of_range_ = false;
  bool as_written_ = true;
  std::vector<Case> cases_{};
};

// ---- Two balls: the exact cases 1 to 27 and 41.

template <class S> std::vector<ExactCase<Sphere<S>, Sphere<S>>> sphere_cases() {
  using enum ToiStatus;
  CaseTable<S, Sphere<S>> in;
  const S two_up = next_up(S(2)), two_down = next_down(S(2));
  const Moving<Sphere<S>> target = at_rest(Sphere<S>{in(0, 0, 0), S(1)});
  const auto shoot = [&](std::string name, const Vec3<S>& from, const Vec3<S>& move, ToiStatus status,
                         std::optional<double> listed = {}) {
    in.add(std::move(name), {in.ball(from, 1), move}, target, status, listed);
  };
  const auto among = [&](std::string name, const Sphere<S>& a, const Vec3<S>& move, const Sphere<S>& b,
                         ToiStatus status, std::optional<double> listed = {}) {
    in.add(std::move(name), {a, move}, at_rest(b), status, listed);
  };

  shoot("1 head on", in(-4, 0, 0), in(4, 0, 0), hit, .5);
  shoot("2 exact graze", in(-4, 2, 0), in(8, 0, 0), hit, .5);
  shoot("3 graze missed by one ulp", {S(-4), two_up, S(0)}, in(8, 0, 0), apart);
  shoot("4 graze met by one ulp", {S(-4), two_down, S(0)}, in(8, 0, 0), hit, .4999999962747097);
  shoot("5 touch at the end", in(-4, 0, 0), in(2, 0, 0), hit, 1);
  shoot("6 one ulp short of the end", in(-4, 0, 0), {two_down, S(0), S(0)}, apart);
  shoot("7 touch, leaving", in(-2, 0, 0), in(-1, 0, 0), overlapping, 0);
  shoot("8 touch, closing", in(-2, 0, 0), in(1, 0, 0), overlapping, 0);
  shoot("9 touch, sliding", in(-2, 0, 0), in(0, 1, 0), overlapping, 0);
  shoot("10 same center", in(0, 0, 0), in(1, 0, 0), overlapping, 0);
  shoot("11 apart, at rest", in(-4, 0, 0), in(0, 0, 0), apart);
  shoot("12 touch, at rest", in(-2, 0, 0), in(0, 0, 0), overlapping, 0);

  const Sphere<S> origin{in(0, 0, 0), S(0)};
  among("13 points meet", in.ball(in(-1, 0, 0), 0), in(2, 0, 0), origin, hit, .5);
  const S least = std::max(power<S>(-1074), std::numeric_limits<S>::denorm_min());
  among("14 points pass at the least double", in.ball({S(-1), least, S(0)}, 0), in(2, 0, 0), origin, apart);
  in.add("15 same motion", {in.ball({S(in(-2) - in(1e-9)), S(0), S(0)}, 1), in(1e6, 0, 0)},
         {in.ball(in(0, 0, 0), 1), in(1e6, 0, 0)}, apart);

  shoot("16 far shot", in(-1e8, .5, 0), in(2e8, 0, 0), hit, .49999999031754163);
  shoot("17 far graze, met", in(-1e8, 1.9999999, 0), in(2e8, 0, 0), hit, .49999999999683772);
  shoot("18 far graze, missed", in(-1e8, 2.0000001, 0), in(2e8, 0, 0), apart);

  const auto units = [&](std::string name, const S& unit, int width, ToiStatus status, double listed) {
    const S start = S(-width) * unit, move = S(2 * width) * unit;
    among(std::move(name), {{start, S(0), S(0)}, unit}, {move, S(0), S(0)}, {in(0, 0, 0), unit}, status, listed);
  };
  among("19 huge", in.ball(in(-1e200, 0, 0), 1e199), in(2e200, 0, 0), in.ball(in(0, 0, 0), 1e199), hit, .4);
  among("20 tiny", in.ball(in(-4e-200, 0, 0), 1e-200), in(4e-200, 0, 0), in.ball(in(0, 0, 0), 1e-200), hit, .5);
  among("21 least double as the unit", {{S(-4 * least), S(0), S(0)}, least}, {S(4 * least), S(0), S(0)},
        {in(0, 0, 0), least}, hit, .5);
  using Limits = std::numeric_limits<S>;
  if (Limits::max_exponent < 20000) {  // beyond, the oracle's own range ends
    units("19a near the largest number", power<S>(Limits::max_exponent - 8), 8, hit, .375);
    units("20a near the least normal number", power<S>(Limits::min_exponent + 2), 8, hit, .375);
  }
  shoot("22 negative zeros", {S(-4), S(-S(0)), S(0)}, {S(4), S(-S(0)), S(-S(0))}, hit, .5);
  among("23 one in a billion billion", in.ball({S(in(-1e9) - S(1)), S(0), S(0)}, 1e-9), in(2, 0, 0),
        in.ball(in(0, 0, 0), 1e9), hit, .4999999995);

  const S far = power<S>(Limits::digits - 13);
  among("24 far from the origin", in.ball({S(far - 4), far, far}, 1), in(4, 0, 0), in.ball({far, far, far}, 1), hit,
        .5);
  const S drift = power<S>(20);
  in.add("25 both drift", {in.ball(in(-4, 0, 0), 1), {S(drift + 4), drift, drift}},
         {in.ball(in(0, 0, 0), 1), {drift, drift, drift}}, hit, .5);
  shoot("26 fast", in(-5e11, 0, 0), in(1e12, 0, 0), hit, .499999999998);
  shoot("27 one ulp away", {S(-two_up), S(0), S(0)}, in(1, 0, 0), hit, power<double>(-51));
  const S last = power<S>(Limits::digits - 1);
  among("41 at the end of the integers", in.ball({S(last - 4), S(0), S(0)}, 1), in(4, 0, 0),
        in.ball({last, S(0), S(0)}, 1), hit, .5);
  return in.cases();
}

// ---- A ball and a box: the exact cases 29 to 43.

template <class S> std::vector<ExactCase<Sphere<S>, Aabb<S>>> box_cases() {
  using enum ToiStatus;
  CaseTable<S, Aabb<S>> in;
  const auto shoot = [&](std::string name, double radius, const Vec3<S>& half, const Vec3<S>& from, const Vec3<S>& move,
                         ToiStatus status, std::optional<double> listed = {}) {
    in.add(std::move(name), {in.ball(from, radius), move}, at_rest(Aabb<S>{in(0, 0, 0), half}), status, listed);
  };
  const Vec3<S> cube = in(1, 1, 1);
  const S graze = S(1.5), four = S(4);

  shoot("29 thin wall", .25, in(power<double>(-10), 8, 8), in(-10, 0, 0), in(1000, 0, 0), hit, .0097490234375);
  shoot("30 corner on", 1, cube, in(-4, -4, -4), in(8, 8, 8), hit, .30283121635129678);
  shoot("31 exact graze of an edge", 5, cube, in(-10, 4, 5), in(20, 0, 0), hit, .45);
  shoot("32 edge missed by one ulp", 5, cube, {S(-10), next_up(four), S(5)}, in(20, 0, 0), apart);
  shoot("33 slides along a face", .5, cube, in(-10, 1.5, 0), in(20, 0, 0), hit, .45);
  shoot("34 face missed by one ulp", .5, cube, {S(-10), next_up(graze), S(0)}, in(20, 0, 0), apart);
  shoot("35 face met by one ulp", .5, cube, {S(-10), next_down(graze), S(0)}, in(20, 0, 0), hit, .4499999992549419);
  shoot("36 center inside", .5, cube, in(.25, 0, 0), in(1, 0, 0), overlapping, 0);
  shoot("36a center at the center", .5, cube, in(0, 0, 0), in(1, 0, 0), overlapping, 0);
  shoot("37 wall without thickness", .25, in(0, 8, 8), in(-1, 0, 0), in(2, 0, 0), hit, .375);
  shoot("38 touch, leaving", .5, cube, in(-1.5, 0, 0), in(-1, 0, 0), overlapping, 0);
  shoot("38 touch, closing", .5, cube, in(-1.5, 0, 0), in(1, 0, 0), overlapping, 0);
  shoot("39 both end poses are free", .25, in(.005, 10, 10), in(-1, 0, 0), in(2, 0, 0), hit, .3725);
  shoot("40 touch at the end", .5, cube, in(-3, 0, 0), in(1.5, 0, 0), hit, 1);
  shoot("40 one ulp short of the end", .5, cube, in(-3, 0, 0), {next_down(graze), S(0), S(0)}, apart);
  const S last = power<S>(std::numeric_limits<S>::digits - 1);
  in.add("41 at the end of the integers", {in.ball({S(last - 4), S(0), S(0)}, 1), in(4, 0, 0)},
         at_rest(Aabb<S>{{last, S(0), S(0)}, cube}), hit, .5);
  shoot("42 entry and contact in different octants", 1, in(1, 1, .25), in(3, -2, 1), in(-9, 1, -8), hit,
        .16182502523937555);
  shoot("43 grazes a corner", 1, in(1, 1, .25), in(1, -1, -1.5), in(8, 1, 6), hit, .075);
  return in.cases();
}

// ---- Boxes and capsules: the exact cases 44, 45 and 47 to 50.

template <class S> std::vector<ExactCase<Aabb<S>, Aabb<S>>> box_pair_cases() {
  using enum ToiStatus;
  const Vec3<S> half(1, 1, 1);
  const Moving<Aabb<S>> target = at_rest(Aabb<S>{{0, 0, 0}, half});
  const auto box = [&](const Vec3<S>& from, const Vec3<S>& move) { return Moving<Aabb<S>>{{from, half}, move}; };
  return {
      {"44 corner on", box({-4, -4, -4}, {4, 4, 4}), target, hit, .5, true},
      {"45 slides along a face", box({-4, 2, 0}, {8, 0, 0}), target, hit, .25, true},
      {"45 face missed by one ulp", box({-4, next_up(S(2)), 0}, {8, 0, 0}), target, apart, {}, true},
  };
}

template <class S> std::vector<ExactCase<Capsule<S>, Capsule<S>>> capsule_pair_cases() {
  using enum ToiStatus;
  const auto rod = [](const Vec3<S>& middle, const Vec3<S>& half) {
    return Capsule<S>{middle - half, middle + half, S(0.5)};
  };
  const Vec3<S> zero(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const S three_down = next_down(S(3));
  return {
      {"47 parallel", {rod({-4, 0, 0}, y), {4, 0, 0}}, at_rest(rod(zero, y)), hit, .75, true},
      {"48 crossed", {rod({-4, 0, 0}, z), {4, 0, 0}}, at_rest(rod(zero, y)), hit, .75, true},
      {"49 collinear", {rod({-6, 0, 0}, x), {6, 0, 0}}, at_rest(rod(zero, x)), hit, .5, true},
      {"49 one ulp short", {rod({-6, 0, 0}, x), {three_down, 0, 0}}, at_rest(rod(zero, x)), apart, {}, true},
  };
}

template <class S> std::vector<ExactCase<Capsule<S>, Aabb<S>>> capsule_box_cases() {
  using enum ToiStatus;
  const S r(0.5);
  const auto cube = at_rest(Aabb<S>{{0, 0, 0}, {1, 1, 1}});
  return {
      {"50 slanted beside a face", {{{-4, -1, -1}, {-4, 1, 1}, r}, {4, 0, 0}}, cube, hit, .625, true},
      {"50a end on", {{{-6, 0, 0}, {-4, 0, 0}, r}, {4, 0, 0}}, cube, hit, .625, true},
  };
}

/// Calls check(case) on every case of every table.
template <class S, class Check> void for_each_exact_case(const Check& check) {
  const auto run = [&](const auto& cases) {
    for (const auto& c : cases) {
      SCOPED_TRACE(c.name);
      check(c);
    }
  };
  run(sphere_cases<S>());
  run(box_cases<S>());
  run(box_pair_cases<S>());
  run(capsule_pair_cases<S>());
  run(capsule_box_cases<S>());
}

}  // namespace thinwall::testing
