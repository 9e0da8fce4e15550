#pragma once
/// Boxes and capsules: the exact cases 44, 45 and 47 to 50.

#include <thinwall/capsule/capsule.hpp>

#include "support/exact_cases.hpp"

namespace thinwall::testing {

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

}  // namespace thinwall::testing
