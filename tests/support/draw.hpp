#pragma once
/// Shapes and motions of a Shaker, as a property draws them.

#include <algorithm>
#include <array>
#include <utility>

#include <rapidcheck.h>

#include "support/numbers_of.hpp"
#include "support/property.hpp"
#include "support/shaker.hpp"

namespace thinwall::testing {

inline std::ostream& operator<<(std::ostream& out, Style style) {
  constexpr const char* names[] = {"mixed", "lattice", "plain", "decades"};
  return out << names[static_cast<int>(style)];
}

inline Style draw_style() { return *rc::gen::element(Style::mixed, Style::lattice, Style::plain, Style::decades); }

/// Of one case: every call has another.
template <class S> Shaker<S> draw_shaker(Style style = draw_style()) {
  return Shaker<S>(static_cast<unsigned>(draw_integer(0, 1 << 30)), style);
}

/// The factors 2^k at which nothing of what is drawn leaves the range, its ends among them.
template <class S> std::array<int, 8> all_scales() {
  using Limits = std::numeric_limits<S>;
  const int low = std::max(Limits::min_exponent + Limits::digits + 10, -20000);
  const int high = std::min(Limits::max_exponent - 6, 20000);
  return {low, low * 5 / 8, -60, -1, 1, 60, high * 5 / 8, high};
}
template <class S> int draw_scale() { return *rc::gen::elementOf(all_scales<S>()); }

/// Two shapes at rest, a third of them all but touching.
template <class P> std::pair<typename P::A, typename P::B> draw_pair(Style style = draw_style()) {
  using S = typename P::S;
  auto draw = draw_shaker<S>(style);
  const auto a = drawn(draw, TypeTag<typename P::A>{});
  auto b = drawn(draw, TypeTag<typename P::B>{});
  const Separation<S> gap = separation(a, b);
  if (draw.pick(0, 2) == 0) b = moved(b, Vec3<S>(gap.normal * -gap.distance));
  RC_LOG() << describe(a) << "\n" << describe(b) << "\n";
  return {a, b};
}

template <class P> Motion<typename P::A, typename P::B> draw_moving_pair(Style style = draw_style()) {
  auto draw = draw_shaker<typename P::S>(style);
  const auto motion = drawn_motion<typename P::A, typename P::B>(draw);
  RC_LOG() << describe(motion.a) << "\n" << describe(motion.b) << "\n";
  return motion;
}

}  // namespace thinwall::testing
