#include <thinwall/experiments/swept_bounds/steiner.hpp>

#include <cmath>
#include <numbers>

namespace thinwall {

SteinerNumbers steiner_numbers(const std::vector<Vec3<double>>& segments) {
  SteinerNumbers sum = {0, 0, 0};
  for (std::size_t i = 0; i < segments.size(); ++i) {
    sum.mean_curvature += std::numbers::pi * segments[i].norm();
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3<double> face = cross(segments[i], segments[j]);
      sum.area += 2 * face.norm();
      for (std::size_t k = 0; k < j; ++k) sum.volume += std::abs(face.dot(segments[k]));
    }
  }
  return sum;
}

double volume(const RoundedZonotope& body) {
  const SteinerNumbers of = steiner_numbers(body.segments);
  const double r = body.radius;
  return of.volume + r * (of.area + r * (of.mean_curvature + r * (4 * std::numbers::pi / 3)));
}

RoundedZonotope grown(RoundedZonotope body, double by) {
  body.radius += by;
  return body;
}

double half_width(const RoundedZonotope& body, const Vec3<double>& along) {
  double sum = body.radius;
  for (const Vec3<double>& segment : body.segments) sum += std::abs(segment.dot(along)) / 2;
  return sum;
}

}  // namespace thinwall
