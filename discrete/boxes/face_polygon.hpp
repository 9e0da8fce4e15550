#pragma once
/// A face of one box laid over a face of another: clipping, and the choice of four corners out of up to eight. Seen in
/// the other face's coordinates: x and y across it from its middle, z the depth below it.
/// Source: the clipping is Sutherland and Hodgman's, one side after the other; the choice is derived here.

#include <algorithm>
#include <array>
#include <cstddef>

#include <thinwall/discrete/numbers/range.hpp>
#include <thinwall/discrete/scalar.hpp>

namespace thinwall {

/// A convex polygon; a square clipped by four lines has at most eight corners.
template <Scalar S> struct FacePolygon {
  std::array<Vec3<S>, 8> points;  ///< [length] the first `count` are corners, in order around it
  int count = 0;

  const Vec3<S>& operator[](int i) const { return points[static_cast<std::size_t>(i)]; }
  void add(const Vec3<S>& point) { points[static_cast<std::size_t>(count++)] = point; }
};

/// The part of the polygon where side * p[axis] <= limit, for side 1 or -1. A corner beyond the line by no more than
/// `noise` [length] is on it, so that faces that touch in a point keep that point.
template <Scalar S>
FacePolygon<S> clipped(const FacePolygon<S>& polygon, int axis, const S& side, const S& limit, const S& noise) {
  FacePolygon<S> kept;
  for (int i = 0; i < polygon.count; ++i) {
    const Vec3<S>& p = polygon[i];
    const Vec3<S>& q = polygon[i + 1 < polygon.count ? i + 1 : 0];
    const S p_beyond = (side * p[axis] - limit) - noise, q_beyond = (side * q[axis] - limit) - noise;
    if (p_beyond <= S(0)) kept.add(p);
    if ((p_beyond < S(0) && q_beyond > S(0)) || (p_beyond > S(0) && q_beyond < S(0))) {
      Vec3<S> crossing = p + (q - p) * (p_beyond / (p_beyond - q_beyond));
      crossing[axis] = side * limit;
      kept.add(crossing);
    }
  }
  return kept;
}

/// The parallelogram middle +- e1 +- e2, clipped to |x| <= half_x and |y| <= half_y.
template <Scalar S>
FacePolygon<S> parallelogram_over_face(const Vec3<S>& middle, const Vec3<S>& e1, const Vec3<S>& e2, const S& half_x,
                                       const S& half_y) {
  FacePolygon<S> polygon;
  polygon.add(middle + e1 + e2);
  polygon.add(middle - e1 + e2);
  polygon.add(middle - e1 - e2);
  polygon.add(middle + e1 - e2);
  const S noise = gap_noise(largest(middle, e1, e2));
  for (const S& side : {S(1), S(-1)}) {
    polygon = clipped(polygon, 0, side, half_x, noise);
    polygon = clipped(polygon, 1, side, half_y, noise);
  }
  return polygon;
}

/// The corners less than `noise` [length] above the face, which is at z = 0.
template <Scalar S> FacePolygon<S> corners_below(const FacePolygon<S>& polygon, const S& noise) {
  FacePolygon<S> below;
  for (int i = 0; i < polygon.count; ++i) {
    if (polygon[i][2] >= -noise) below.add(polygon[i]);
  }
  return below;
}

/// The mean of the deepest corners: of those less than `noise` [length] above the deepest. The polygon has a corner.
template <Scalar S> Vec3<S> middle_of_deepest(const FacePolygon<S>& polygon, const S& noise) {
  S depth = polygon[0][2];
  for (int i = 1; i < polygon.count; ++i) depth = std::max(depth, polygon[i][2]);
  Vec3<S> sum = Vec3<S>::Zero();
  int deepest = 0;
  for (int i = 0; i < polygon.count; ++i) {
    if (polygon[i][2] < depth - noise) continue;
    sum += polygon[i];
    ++deepest;
  }
  return sum / S(deepest);
}

/// Up to four of the corners, by index: the deepest; the one farthest from it, seen along the depth; the one farthest
/// from the line of these two; the one farthest outside the triangle. Ties go to the first, and what adds less than
/// `noise` [length] is left out.
template <Scalar S> struct CornerChoice {
  std::array<int, 4> index{};
  int count = 0;
};

template <Scalar S> CornerChoice<S> chosen_corners(const FacePolygon<S>& polygon, const S& noise) {
  CornerChoice<S> choice;
  if (polygon.count == 0) return choice;
  int deepest = 0;
  for (int i = 1; i < polygon.count; ++i) {
    if (polygon[i][2] > polygon[deepest][2]) deepest = i;
  }
  const auto keep = [&](int i) { choice.index[static_cast<std::size_t>(choice.count++)] = i; };
  const auto squared_length = [&](int i, int j) -> S {
    const S x = polygon[j][0] - polygon[i][0], y = polygon[j][1] - polygon[i][1];
    return x * x + y * y;
  };
  const auto area = [&](int i, int j, int k) -> S {  // twice, > 0 if k lies to the left of the way from i to j
    return (polygon[j][0] - polygon[i][0]) * (polygon[k][1] - polygon[i][1]) -
           (polygon[j][1] - polygon[i][1]) * (polygon[k][0] - polygon[i][0]);
  };
  // The corner of largest value(i), kept if that is more than `least`.
  const auto keep_largest = [&](S least, const auto& value) {
    int best = -1;
    for (int i = 0; i < polygon.count; ++i) {
      const S here = value(i);
      if (!(here > least)) continue;
      least = here;
      best = i;
    }
    if (best >= 0) keep(best);
    return best;
  };
  keep(deepest);
  const int second = keep_largest(noise * noise, [&](int i) { return squared_length(deepest, i); });
  if (second < 0) return choice;
  const S length =
      safe_norm<S>({polygon[second][0] - polygon[deepest][0], polygon[second][1] - polygon[deepest][1], 0});
  const int third = keep_largest(noise * length, [&](int i) { return largest(area(deepest, second, i)); });
  if (third < 0) return choice;
  const S turn = area(deepest, second, third) > S(0) ? S(-1) : S(1);
  keep_largest(noise * length, [&](int i) {
    return std::max(S(turn * area(deepest, second, i)),
                    std::max(S(turn * area(second, third, i)), S(turn * area(third, deepest, i))));
  });
  return choice;
}

}  // namespace thinwall
