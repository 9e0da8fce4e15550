#pragma once
/// A ball and a box: the exact cases 29 to 43.

#include "support/exact_cases.hpp"

namespace thinwall::testing {

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

}  // namespace thinwall::testing
