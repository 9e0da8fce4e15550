#pragma once
/// The foil: the closed forms of models/textbook.hpp in the form of a method, so that they are asked what methods are.

#include <string_view>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/experiments/models/textbook.hpp>
#include <thinwall/swept/serves.hpp>

namespace thinwall {

template <Scalar S> struct Textbook {
  static constexpr std::string_view name = "textbook";
  S min_separation = 0;  ///< [length] not looked at
};

namespace textbook {

/// Time and verdict alone: a foil has no normal.
template <Scalar S> Toi<S> answer(bool at_start, const S& time) {
  if (at_start || time == S(0)) return {ToiStatus::overlapping, 1, S(0)};
  if (!(time == time)) return {ToiStatus::invalid, 1, time};
  if (!(time <= S(1))) return {ToiStatus::apart, 1};
  return {ToiStatus::hit, 1, time};
}

}  // namespace textbook

template <Scalar S> Toi<S> impact(const Textbook<S>&, const Moving<Sphere<S>>& a, const Moving<Sphere<S>>& b) {
  const Vec3<S> p = a.shape.center - b.shape.center, v = relative_displacement(a, b);
  const S R = a.shape.radius + b.shape.radius;
  return textbook::answer<S>(p.squaredNorm() <= R * R, textbook::ball<S>(p, v, R));
}

template <Scalar S> Toi<S> impact(const Textbook<S>&, const Moving<Aabb<S>>& box, const Moving<Sphere<S>>& sphere) {
  const Vec3<S> p = sphere.shape.center - box.shape.center, v = relative_displacement(sphere, box);
  const Vec3<S>& h = box.shape.half_extents;
  const S R = sphere.shape.radius;
  return textbook::answer<S>(excess_of<S>(p, h).squaredNorm() <= R * R, textbook::rounded_box<S>(p, v, h, R));
}

template <Scalar S> Toi<S> impact(const Textbook<S>&, const Moving<Aabb<S>>& a, const Moving<Aabb<S>>& b) {
  const Vec3<S> p = a.shape.center - b.shape.center, v = relative_displacement(a, b);
  return textbook::answer<S>(false, textbook::slabs<S>(p, v, a.shape.half_extents + b.shape.half_extents));
}

template <Scalar S> Toi<S> impact(const Textbook<S>&, const Moving<Obb<S>>& a, const Moving<Obb<S>>& b) {
  return textbook::answer<S>(false, textbook::boxes<S>(a.shape, b.shape, relative_displacement(b, a)));
}

template <Scalar S>
Toi<S> impact(const Textbook<S>&, const Moving<Capsule<S>>& capsule, const Moving<Sphere<S>>& sphere) {
  const Vec3<S> p = sphere.shape.center - capsule.shape.a, v = relative_displacement(sphere, capsule);
  const Vec3<S> d = capsule.shape.b - capsule.shape.a;
  const S R = sphere.shape.radius + capsule.shape.radius;
  return textbook::answer<S>(textbook::square_to_segment<S>(p, d) <= R * R, textbook::rounded_segment<S>(p, v, d, R));
}

}  // namespace thinwall
