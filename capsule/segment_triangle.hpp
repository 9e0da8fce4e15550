#pragma once
/// A segment and a triangle: the closest points while they are apart, the least way out once they cross.
///
/// Apart, the closest points are an end of the segment and the inside of the face, or the segment and an edge. As the
/// start of the segment moves, it meets the prism that the triangle sweeps along the segment backwards: its caps are the
/// triangle, its sides are spanned by an edge and the segment. Source: derived here.

#include <algorithm>
#include <array>
#include <limits>

#include <thinwall/capsule/segment.hpp>
#include <thinwall/discrete/entry/flat_entry.hpp>
#include <thinwall/discrete/shape.hpp>
#include <thinwall/discrete/triangle.hpp>

namespace thinwall {

/// The part of { y - s * d : y in the triangle (0, e1, e2), s in [0, 1] } that is closest to x, the start of a segment.
/// `on_triangle` is the closest point of the triangle, `s` names that of the segment.
template <Scalar S> struct PrismPart {
  CorePart<S> part;
  Vec3<S> on_triangle = Vec3<S>::Zero();
  S s = 0;
};

/// The faces of the prism decide exactly whether it is met.
template <Scalar S> bool prism_is_exact(const Vec3<S>& x, const Vec3<S>& d, const Vec3<S>& e1, const Vec3<S>& e2) {
  const S size = largest(x, d, e1, e2);
  return counts_beside(largest(d), size) && counts_beside(largest(e1, e2), size);
}

/// True if the segment x + s * d, s in [0, 1], meets the triangle (0, e1, e2), whose prism is exact.
template <Scalar S>
bool segment_meets_triangle(const Vec3<S>& x, const Vec3<S>& d, const Vec3<S>& e1, const Vec3<S>& e2) {
  const Entry<S> along = flat_entry<S>(FlatShape::triangle, x, d, e1, e2, S(1));
  return along.inside || along.time <= S(1);
}

/// How far apart the direction of `gap` shows the segment x + s * d and the triangle (0, e1, e2) to be, times its length.
template <Scalar S>
S parted_along(const Vec3<S>& gap, const Vec3<S>& x, const Vec3<S>& d, const Vec3<S>& e1, const Vec3<S>& e2) {
  const S start = gap.dot(x);
  return std::min(start, S(start + gap.dot(d))) - std::max({S(0), S(gap.dot(e1)), S(gap.dot(e2))});
}

/// Of candidates as near as each other, to rounding, the one whose direction parts the two best is taken: distances tell
/// directions apart only to the square root of a rounding. Requires lengths whose products of four are in range.
template <Scalar S>
PrismPart<S> closest_on_swept_triangle(const Vec3<S>& x, const Vec3<S>& d, const Vec3<S>& e1, const Vec3<S>& e2) {
  const std::array<Vec3<S>, 3> from{Vec3<S>::Zero(), e1, e2}, along{e1, e2 - e1, -e2};
  const Vec3<S> normal = accurate_cross(e1, e2);
  const S rounding = gap_noise(largest(x, d, e1, e2)) / 4;
  PrismPart<S> best;
  S least = std::numeric_limits<S>::infinity();
  const auto becomes_best = [&](const Vec3<S>& gap) {
    const S distance = gap.norm();
    const bool ties = largest(S(distance - least)) <= rounding && std::min(distance, least) > 16 * rounding;
    const bool better =
        ties ? parted_along(gap, x, d, e1, e2) * least > parted_along(best.part.gap, x, d, e1, e2) * distance
             : distance < least;
    if (better) least = distance;
    return better;
  };
  const std::array<Vec3<S>, 2> tips{x, x + d};
  const std::array<CorePart<S>, 2> beside{closest_on_triangle(tips[0], e1, e2), closest_on_triangle(tips[1], e1, e2)};
  for (std::size_t end = 0; end < 2; ++end) {
    const Vec3<S>& tip = tips[end];
    const CorePart<S>& face = beside[end];
    if (face.kind != CorePart<S>::face || !becomes_best(face.gap)) continue;
    best = {{static_cast<int>(end), CorePart<S>::face, end == 0 ? Vec3<S>::Zero() : Vec3<S>(-d), normal, face.gap},
            tip - face.gap,
            S(end)};
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const SegmentPair<S> pair = closest_on_segments<S>(x - from[k], along[k], d);
    if (!becomes_best(pair.gap)) continue;
    CorePart<S> side = closest_on_parallelogram<S>(x - from[k], along[k], d);
    side.origin += from[k];
    side.id += 10 * (static_cast<int>(k) + 1);
    best = {side, from[k] + along[k] * pair.s, pair.t};
  }
  const std::array<S, 2> height{tips[0].dot(normal), tips[1].dot(normal)};
  if ((height[0] < S(0)) == (height[1] < S(0)) || least == S(0)) return best;
  const S s = height[0] / (height[0] - height[1]);
  const Vec3<S> crossing = x + d * s;
  bool inside = true;
  for (std::size_t k = 0; k < 3; ++k) inside = inside && cross<S>(along[k], crossing - from[k]).dot(normal) >= S(0);
  // Past a tip all three signs are roundings.
  if (!inside || largest(closest_on_triangle(crossing, e1, e2).gap) > 4 * rounding) return best;
  // The segment pierces the face: out past an end along the normal, or past an edge along its product with d. The shortest way ends in the
  // inside of its face of the prism: among ways as short as each other, to rounding, the one whose points meet is taken.
  const S length = safe_norm(normal);
  const Vec3<S> up = normal / length;
  least = std::numeric_limits<S>::infinity();
  const auto consider = [&](const Vec3<S>& out, const S& depth, const Vec3<S>& on_triangle, const S& at) {
    const S apart = largest(Vec3<S>((x + d * at) + out * depth - on_triangle));
    if (!(depth + apart < least)) return;
    least = depth + apart;
    best = {{-1, CorePart<S>::face, x + out * depth, out, out, depth}, on_triangle, at};
  };
  for (std::size_t end = 0; end < 2; ++end) {
    const Vec3<S> out = height[end] > S(0) ? Vec3<S>(-up) : up;
    consider(out, S(largest(height[end]) / length), tips[end] - beside[end].gap, S(end));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3<S> side = safe_unit(cross(along[k], d));
    if (side == Vec3<S>::Zero()) continue;
    const SegmentPair<S> closest = closest_on_segments<S>(x - from[k], along[k], d);
    const bool inwards = side.dot(from[(k + 2) % 3] - from[k]) > S(0);  // the offset's sign may be a rounding
    consider(inwards ? Vec3<S>(-side) : side, largest(S((crossing - from[k]).dot(side))),
             from[k] + along[k] * closest.s, closest.t);
  }
  return best;
}

/// The unit normal, from the segment x + s * d to the triangle (0, e1, e2) it touches, along which they part soonest: the
/// plane's normal, or that of an edge and the segment where it leads out sooner by more than `noise` [length]. Zero where
/// both lie on one line.
template <Scalar S>
Vec3<S> parting_normal(const Vec3<S>& x, const Vec3<S>& d, const Vec3<S>& e1, const Vec3<S>& e2, const S& noise) {
  const Vec3<S> core = safe_unit(d);
  Vec3<S> best = Vec3<S>::Zero();
  S least = std::numeric_limits<S>::infinity();
  const auto consider = [&](const Vec3<S>& n) {
    if (n == Vec3<S>::Zero()) return;
    const auto [low, high] = std::minmax({S(0), S(n.dot(e1)), S(n.dot(e2))});
    const auto [start, end] = std::minmax({S(n.dot(x)), S(n.dot(x) + n.dot(d))});
    const S ahead = end - low, behind = high - start;
    if (!(std::min(ahead, behind) < least - noise)) return;
    least = std::min(ahead, behind);
    best = behind < ahead ? Vec3<S>(-n) : n;
  };
  consider(towards_positive<S>(safe_unit(cross(safe_unit(e1), safe_unit(e2)))));
  for (const Vec3<S>& edge : {e1, Vec3<S>(e2 - e1), e2})
    consider(towards_positive<S>(safe_unit(cross(safe_unit(edge), core))));
  return best;
}

}  // namespace thinwall
