#pragma once
/// The front door of the queries at one instant. Puts the later shape first (and flips the answer back), keeps
/// coordinates near the largest number from overflowing, and turns the gap between cores into the answer asked for.
///
/// Every query counts touching as contact: shapes are closed sets. (The tutorial these rules come from compares with
/// `<`; the two differ on a set of measure zero.) Every query wants valid() shapes, and says false, nothing or NaN of others.

#include <algorithm>
#include <optional>
#include <type_traits>

#include <thinwall/discrete/clear/clear_answers.hpp>
#include <thinwall/discrete/results.hpp>
#include <thinwall/discrete/shape.hpp>

namespace thinwall {

/// The sum of all the numbers that the largest query is given, fewer than 64, is ordinary once they are divided by 2 to this power.
inline constexpr int huge_exponent = 12;

/// What a front door makes of what it is given, `size` being the sum of its magnitudes. It asks the kernels about ordinary ones
/// as they are, about huge ones divided by 2^huge_exponent, which need not be done twice, and about nothing that is not valid.
enum class Magnitudes { ordinary, huge, invalid };
template <Scalar S, class... Given> THINWALL_HOT Magnitudes magnitudes_of(const S& size, const Given&... given) {
  if (is_ordinary(size) && (has_valid_sizes(given) && ...) && (has_valid_axes(given) && ...))
    return Magnitudes::ordinary;
  return (valid(given) && ...) ? Magnitudes::huge : Magnitudes::invalid;
}

/// overlaps_within() of shapes that a front door has found valid and made ordinary: what a method asks of its poses. A float
/// box that was promoted to double has axes that are orthonormal to float only, and would be refused a second time.
template <Shape A, Shape B> bool overlaps_unchecked(const A& a, const B& b, const typename A::Scalar& margin) {
  using S = typename A::Scalar;
  if constexpr (A::rank < B::rank) {
    return overlaps_unchecked(b, a, margin);
  } else {
    return cores_within(a, b, S(skin_radius(a) + skin_radius(b) + margin));
  }
}

/// True if the shapes come within `margin` [length] >= 0 of each other. False if a shape or the margin is not valid.
/// Error: decides as if the gap were off by a few units of round-off of the coordinates involved.
template <Shape A, Shape B> bool overlaps_within(const A& a, const B& b, const typename A::Scalar& margin) {
  using S = typename A::Scalar;
  static_assert(std::same_as<S, typename B::Scalar>, "both shapes must have the same scalar");
  static_assert(ServedPair<A, B>, "this pair of shapes is not served: include its header, or see docs/pairs.md");
  if (!(margin >= S(0)) || !is_finite(margin)) return false;
  switch (magnitudes_of(S(magnitude(a) + magnitude(b) + margin), a, b)) {
    case Magnitudes::ordinary: return overlaps_unchecked(a, b, margin);
    case Magnitudes::huge: {
      const S small = times_power_of_two(margin, -huge_exponent);
      return overlaps_unchecked(scaled(a, -huge_exponent), scaled(b, -huge_exponent), small);
    }
    case Magnitudes::invalid: break;
  }
  return false;
}

/// The gap between the cores of A and B, whichever of the two has the overload.
template <Shape A, Shape B> CoreGap<typename A::Scalar> core_gap_either_way(const A& a, const B& b) {
  if constexpr (A::rank < B::rank) {
    return flipped(core_gap(b, a));
  } else {
    return core_gap(a, b);
  }
}

/// The careful rung of a separation, of valid shapes of ordinary size.
template <Shape A, Shape B> Separation<typename A::Scalar> separation_of_cores(const A& a, const B& b) {
  using S = typename A::Scalar;
  const CoreGap<S> gap = core_gap_either_way(a, b);
  const Vec3<S> normal = gap.normal == Vec3<S>::Zero() ? arbitrary_normal(gap.along) : gap.normal;
  return {gap.distance - (skin_radius(a) + skin_radius(b)), normal, center(a) + (gap.local_a + normal * skin_radius(a)),
          center(b) + (gap.local_b - normal * skin_radius(b))};
}

/// contact() of valid shapes of ordinary size.
template <Shape A, Shape B> std::optional<Contact<typename A::Scalar>> contact_unchecked(const A& a, const B& b) {
  using S = typename A::Scalar;
  if (!overlaps_unchecked(a, b, S(0))) return std::nullopt;
  const CoreGap<S> gap = core_gap_either_way(a, b);
  const Vec3<S> normal = gap.normal == Vec3<S>::Zero() ? arbitrary_normal(gap.along) : gap.normal;
  const S penetration = std::max(S(0), S(skin_radius(a) + skin_radius(b) - gap.distance));
  return Contact<S>{contact_point(a, gap.local_a, normal), contact_point(b, gap.local_b, Vec3<S>(-normal)), normal,
                    penetration};
}

template <class A, class B> THINWALL_HOT ClearContact clear_contact_either_way(const A& a, const B& b) {
  if constexpr (HasClearContact<A, B>) {
    return clear_contact(a, b);
  } else {
    return flipped(clear_contact(b, a));
  }
}

/// The clear rung tells whether they share a point, by a question of its own or by a contact's.
template <class A, class B>
inline constexpr bool has_clear_overlap =
    HasClearOverlap<A, B> || HasClearOverlap<B, A> || HasClearContact<A, B> || HasClearContact<B, A>;
template <class A, class B> THINWALL_HOT ClearOverlap clear_overlap_either_way(const A& a, const B& b) {
  if constexpr (HasClearOverlap<A, B>) {
    return clear_overlap(a, b);
  } else if constexpr (HasClearOverlap<B, A>) {
    return clear_overlap(b, a);
  } else {
    const ClearContact answer = clear_contact_either_way(a, b);
    return {answer.clear, answer.touching};
  }
}

/// What ask(a, b, e), a front door, says of a shape and another or a ray, of doubles or floats, divided by 2^e to a size near 1, where no product
/// underflows or overflows, so that the unit of length changes no bit. Nothing where the size is near 1 as it is or 0, one is not valid, or a
/// division would not be exact.
template <class A, Shape B, class Ask>
std::optional<std::invoke_result_t<Ask, A, B, int>> asked_near_one(const A& a, const B& b, const Ask& ask) {
  using S = typename B::Scalar;
  if constexpr (std::is_same_v<S, double> || std::is_same_v<S, float>) {
    const Vec3<S> at = center(a);
    const S size = extent(moved<S>(a, -at)) + extent(moved<S>(b, -at));  // wherever the origin is
    const bool is_none = size == 0 || !is_finite(size);
    if ((size >= S(0x1p-32) && size <= S(0x1p32)) || is_none || !valid(a) || !valid(b)) return std::nullopt;
    const int e = binary_exponent(size);
    if (divides_exactly(a, e) && divides_exactly(b, e)) return ask(scaled(a, -e), scaled(b, -e), e);
  }
  return std::nullopt;
}

/// The careful rung of overlaps(): any input, at any scale.
template <Shape A, Shape B> [[gnu::noinline]] bool careful_overlaps(const A& a, const B& b) {
  const auto near = asked_near_one(a, b, [](const A& x, const B& y, int) { return overlaps(x, y); });
  return near ? *near : overlaps_within(a, b, typename A::Scalar(0));
}

/// True if the shapes share a point; touching counts.
template <Shape A, Shape B> THINWALL_HOT bool overlaps(const A& a, const B& b) {
  if constexpr (has_clear_overlap<A, B>) {
    const ClearOverlap answer = clear_overlap_either_way(a, b);
    if (answer.clear) [[likely]]
      return answer.overlaps;
  }
  return careful_overlaps(a, b);
}

/// The careful rung of contact(): any input, at any scale.
template <Shape A, Shape B>
[[gnu::noinline]] std::optional<Contact<typename A::Scalar>> careful_contact(const A& a, const B& b) {
  using S = typename A::Scalar;
  const auto ask = [](const A& x, const B& y, int e) { return scaled(contact(x, y), e); };
  if (const auto near = asked_near_one(a, b, ask)) return *near;
  switch (magnitudes_of(S(magnitude(a) + magnitude(b)), a, b)) {
    case Magnitudes::ordinary: return contact_unchecked(a, b);
    case Magnitudes::huge:
      return scaled(contact_unchecked(scaled(a, -huge_exponent), scaled(b, -huge_exponent)), huge_exponent);
    case Magnitudes::invalid: break;
  }
  return std::nullopt;
}

/// One point of contact data, only when touching or overlapping: exactly where overlaps() is true.
template <Shape A, Shape B> THINWALL_HOT std::optional<Contact<typename A::Scalar>> contact(const A& a, const B& b) {
  static_assert(std::same_as<typename A::Scalar, typename B::Scalar>, "both shapes must have the same scalar");
  static_assert(ServedPair<A, B>, "this pair of shapes is not served: include its header, or see docs/pairs.md");
  if constexpr (HasClearContact<A, B> || HasClearContact<B, A>) {
    const ClearContact answer = clear_contact_either_way(a, b);
    if (answer.clear) [[likely]]
      return answer.contact();
  }
  return careful_contact(a, b);
}

/// What the clear rung says of a separation, or otherwise().
template <Shape A, Shape B, class Otherwise>
THINWALL_HOT Separation<typename A::Scalar> clear_separation_or(const A& a, const B& b, const Otherwise& otherwise) {
  if constexpr (HasClearContact<A, B>) {
    const ClearContact answer = clear_gap(a, b);
    if (answer.clear) [[likely]]
      return answer.separation(center(b));
  } else if constexpr (HasClearContact<B, A>) {
    const ClearContact answer = clear_gap(b, a);
    if (answer.clear) [[likely]]
      return flipped(answer.separation(center(a)));
  }
  return otherwise();
}

/// separation() at a size near 1, or nothing: asked_near_one().
template <Shape A, Shape B> auto separation_near_one(const A& a, const B& b) {
  return asked_near_one(a, b, [](const A& x, const B& y, int e) { return scaled(separation(x, y), e); });
}

/// separation() of valid shapes of ordinary size, as overlaps_unchecked().
template <Shape A, Shape B> Separation<typename A::Scalar> separation_unchecked(const A& a, const B& b) {
  return clear_separation_or(a, b, [&] {
    const auto near = separation_near_one(a, b);
    return near ? *near : separation_of_cores(a, b);
  });
}

/// The careful rung of separation(): any input, at any scale.
template <Shape A, Shape B>
[[gnu::noinline]] Separation<typename A::Scalar> careful_separation(const A& a, const B& b) {
  using S = typename A::Scalar;
  if (const auto near = separation_near_one(a, b)) return *near;
  switch (magnitudes_of(S(magnitude(a) + magnitude(b)), a, b)) {
    case Magnitudes::ordinary: return separation_of_cores(a, b);
    case Magnitudes::huge:
      return scaled(separation_of_cores(scaled(a, -huge_exponent), scaled(b, -huge_exponent)), huge_exponent);
    case Magnitudes::invalid: break;
  }
  return {nan_vector<S>()[0], nan_vector<S>(), nan_vector<S>(), nan_vector<S>()};
}

/// Signed distance, normal, and a closest point on each. NaN throughout if a shape is not valid.
/// Degenerate: where the cores touch, the normal is the one of least penetration; where several serve, the lowest axis
/// and the positive side (boxes), or the one nearest to +x (rounded shapes).
template <Shape A, Shape B> THINWALL_HOT Separation<typename A::Scalar> separation(const A& a, const B& b) {
  static_assert(std::same_as<typename A::Scalar, typename B::Scalar>, "both shapes must have the same scalar");
  static_assert(ServedPair<A, B>, "this pair of shapes is not served: include its header, or see docs/pairs.md");
  return clear_separation_or(a, b, [&] { return careful_separation(a, b); });
}

/// The careful rung of raycast(): any input, at any scale.
template <Scalar S, Shape A>
[[gnu::noinline]] std::optional<RayHit<S>> careful_raycast(const Ray<S>& ray, const A& shape) {
  const auto ask = [&](const Ray<S>& near_ray, const A& near_shape, int e) {
    auto hit = scaled(raycast(near_ray, near_shape), e);
    if (hit && hit->normal == Vec3<S>::Zero()) hit->point = ray.origin;
    return hit;
  };
  if (const auto near = asked_near_one(ray, shape, ask)) return *near;
  // An infinite t or point: t overflows, or a triangle seems to be hit because lengths 2^500 apart underflow beside each other.
  const auto finite = [](const std::optional<RayHit<S>>& hit) {
    return hit && is_finite(hit->t) && is_finite(hit->point) ? hit : std::nullopt;
  };
  const auto divided_by_power = [&](int e) {  // huge, or so tiny that a start nearer by would lose its digits
    auto hit = ray_entry(scaled(ray, -e), scaled(shape, -e));
    if (hit) hit->point = hit->normal == Vec3<S>::Zero() ? ray.origin : times_power_of_two(hit->point, e);
    return finite(hit);
  };
  switch (magnitudes_of(S(magnitude(ray) + magnitude(shape)), ray, shape)) {
    case Magnitudes::ordinary: {
      const S size = extent(shape) + ray.origin.cwiseAbs().sum() + ray.direction.cwiseAbs().sum();
      const bool is_tiny = size < constant_power_of_two<S, std::numeric_limits<S>::min_exponent / 2>();
      if (is_tiny && size > S(0)) return divided_by_power(binary_exponent(size));
      constexpr int lower = std::numeric_limits<S>::min_exponent + 2 * std::numeric_limits<S>::digits;
      const S longest = largest(ray.direction);
      if (!(longest > S(0) && longest < constant_power_of_two<S, lower>())) return finite(ray_entry(ray, shape));
      const int e = binary_exponent(longest);  // turned as it is it would lose digits
      const Vec3<S> direction = times_power_of_two(ray.direction, -e);
      auto hit = ray_entry({ray.origin, direction, times_power_of_two(ray.max_t, e)}, shape);
      if (hit) hit->t = times_power_of_two(hit->t, -e);
      return finite(hit);
    }
    case Magnitudes::huge: return divided_by_power(huge_exponent);
    case Magnitudes::invalid: break;
  }
  return std::nullopt;
}

template <class A>
concept HasRaycastFromAfar = requires(const Ray<double>& ray, const A& shape) { raycast_from_afar(ray, shape); };

/// What was not told from afar.
template <Scalar S, Shape A>
[[gnu::noinline]] std::optional<RayHit<S>> raycast_close_by(const Ray<S>& ray, const A& shape) {
  const ClearRayHit answer = clear_raycast(ray, shape);
  return answer.clear ? answer.ray_hit() : careful_raycast(ray, shape);
}

/// Where the ray first meets the shape; nothing if it does not within max_t, at no t or point that S holds, or if the ray or the
/// shape is not valid.
/// Error: forward error of t a few u * kappa * t (docs/closed_forms.md).
/// Degenerate: a start inside or touching hits at 0 with a zero normal; a ray of no direction hits only there.
template <Scalar S, Shape A> THINWALL_HOT std::optional<RayHit<S>> raycast(const Ray<S>& ray, const A& shape) {
  static_assert(std::same_as<S, typename A::Scalar>, "the ray and the shape must have the same scalar");
  if constexpr (HasRaycastFromAfar<A>) {
    const ClearRayHit answer = raycast_from_afar(ray, shape);
    if (answer.clear) [[likely]]
      return answer.ray_hit();
    return raycast_close_by(ray, shape);
  } else if constexpr (HasClearRaycast<A>) {
    const ClearRayHit answer = clear_raycast(ray, shape);
    if (answer.clear) [[likely]]
      return answer.ray_hit();
  }
  return careful_raycast(ray, shape);
}

}  // namespace thinwall
