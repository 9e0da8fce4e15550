#pragma once
/// A face of one box laid over a face of another: clipping, and the choice of four corners out of up to eight. Seen in the other face's
/// coordinates: x and y across it from its middle, z the depth below it.
/// Source: derived here. No order of a polygon's corners is asked, so that each is found by itself, without a jump.

#include <algorithm>
#include <array>
#include <cstddef>

#include <thinwall/discrete/clear/lanes.hpp>
#include <thinwall/discrete/numbers/range.hpp>
#include <thinwall/discrete/scalar.hpp>

namespace thinwall {

/// Corners of a convex polygon, in no order: what a parallelogram and a rectangle share has eight at most, and four more of which rounding may
/// make two of one: two on each edge of the parallelogram, and the rectangle's.
template <Scalar S> struct FacePolygon {
  std::array<Vec3<S>, 13> points;  ///< [length] the first `count` are corners; the last is written to alone
  int count = 0;

  const Vec3<S>& operator[](int i) const { return points[static_cast<std::size_t>(i)]; }
  void add(const Vec3<S>& point, bool is_corner) {
    points[static_cast<std::size_t>(count)] = point;
    count += static_cast<int>(is_corner);
  }
};

/// The parallelogram middle +- e1 +- e2, clipped to |x| <= half_x and |y| <= half_y. A corner beyond a side by no more than rounding is on it,
/// `noise` [length], so that faces that touch in a point keep that point; corners nearer to each other than that are one. Requires lengths whose
/// products of two are in range.
template <Scalar S>
FacePolygon<S> parallelogram_over_face(const Vec3<S>& middle, const Vec3<S>& e1, const Vec3<S>& e2, const S& half_x,
                                       const S& half_y, const S& noise) {
  const auto smaller = [](S x, S y) { return x < y ? x : y; };  // by value: of references compilers make jumps
  const auto greater = [](S x, S y) { return x > y ? x : y; };
  FacePolygon<S> polygon;

  // Each edge, from middle + a + b on along -2 a: where it begins within the rectangle, and where it leaves it before its end. Whether a
  // corner is in is asked once, for the edge that ends there and the one that begins.
  const auto is_in = [&](const Vec3<S>& p) {
    return packed::both(largest(p[0]) <= half_x + noise, largest(p[1]) <= half_y + noise);
  };
  Vec3<S> a = e1, b = e2, start = middle + a + b;
  bool starts_in = is_in(start);
  for (int k = 0; k < 4; ++k) {
    const Vec3<S> end = middle + b - a;
    const bool ends_in = is_in(end);
    S first(0), last(2);
    const auto keep_within = [&](S x, S v, S h) {
      const S per = S(1) / v, to_low = (x + (h + noise)) * per, to_high = (x - (h + noise)) * per;
      first = greater(smaller(to_low, to_high), first);  // of what is not a number, where v is 0, nothing
      last = smaller(greater(to_low, to_high), last);
    };
    keep_within(start[0], a[0], half_x);
    keep_within(start[1], a[1], half_y);
    const bool is_long = (last - first) * (largest(a[0]) + largest(a[1])) > 4 * noise;
    S t = starts_in ? S(0) : first;
    for (const bool is_corner : {starts_in || first <= last, packed::both(!ends_in, is_long)}) {
      const S x = start[0] - a[0] * t, y = start[1] - a[1] * t;
      polygon.add({greater(-half_x, smaller(half_x, x)), greater(-half_y, smaller(half_y, y)), start[2] - a[2] * t},
                  is_corner);
      t = last;
    }
    start = end;
    starts_in = ends_in;
    const Vec3<S> next = b;
    b = -a;
    a = next;
  }

  // The corners of the rectangle, in the parallelogram's own coordinates times its area.
  const S area = e1[0] * e2[1] - e1[1] * e2[0], per_area = S(1) / area;
  const S within_e1 = largest(area) - noise / 2 * (largest(e2[0]) + largest(e2[1]));
  const S within_e2 = largest(area) - noise / 2 * (largest(e1[0]) + largest(e1[1]));
  for (int k = 0; k < 4; ++k) {
    const S x = k < 2 ? half_x : -half_x, y = k % 2 == 0 ? half_y : -half_y;
    const S dx = x - middle[0], dy = y - middle[1], on_e1 = dx * e2[1] - dy * e2[0], on_e2 = dy * e1[0] - dx * e1[1];
    polygon.add({x, y, middle[2] + (on_e1 * per_area * e1[2] + on_e2 * per_area * e2[2])},
                packed::both(largest(on_e1) < within_e1, largest(on_e2) < within_e2));
  }
  return polygon;
}

/// The corners less than `noise` [length] above the face, which is at z = 0.
template <Scalar S> FacePolygon<S> corners_below(const FacePolygon<S>& polygon, const S& noise) {
  FacePolygon<S> below;
  for (int i = 0; i < polygon.count; ++i) {
    below.add(polygon[i], polygon[i][2] >= -noise);
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
