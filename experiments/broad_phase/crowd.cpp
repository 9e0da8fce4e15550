#include <thinwall/experiments/broad_phase/crowd.hpp>

#include <array>
#include <cmath>

#include <thinwall/experiments/random.hpp>
#include <thinwall/swept/swept_volume.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

namespace {

constexpr double heap_size = 100, heap_contrast = 10;

/// `speed` long, every direction as likely: a point of the ball, drawn by rejection from its cube.
Vec3<double> random_path(double speed, const RandomStream& stream, std::uint64_t trial) {
  for (std::uint64_t draw = 2;; ++draw) {
    const RandomWords words = random_words(stream, trial, draw);
    const Vec3<double> v = {2 * uniform(words[0]) - 1, 2 * uniform(words[1]) - 1, 2 * uniform(words[2]) - 1};
    const double length = v.norm();
    if (length <= 1 && length > 0x1p-10) return v * (speed / length);
  }
}

Vec3<double> random_place(const RandomWords& words, double side) {
  return {side * uniform(words[0]), side * uniform(words[1]), side * uniform(words[2])};
}

}  // namespace

Crowd make_crowd(const CrowdFactors& f, std::uint64_t seed) {
  const std::array<double, 4> key = {f.clustered ? 1.0 : 0.0, f.speed, f.density, static_cast<double>(f.count)};
  const RandomStream stream{seed, stream_of(key)}, heaps{seed, stream_of(key) + 1};
  const double side = std::cbrt(static_cast<double>(f.count) / f.density);
  const double heap_side = std::cbrt(heap_size / (heap_contrast * f.density));
  const auto heap_count = static_cast<std::uint64_t>(std::ceil(static_cast<double>(f.count) / heap_size));
  Crowd crowd;
  crowd.reserve(static_cast<std::size_t>(f.count));
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(f.count); ++i) {
    Vec3<double> place = random_place(random_words(stream, i, 0), side);
    if (f.clustered) {
      const RandomWords words = random_words(stream, i, 1);
      place = random_place(random_words(heaps, words[3] % heap_count, 0), side) + random_place(words, heap_side);
    }
    crowd.push_back({Sphere<double>{place, crowd_radius}, random_path(f.speed, stream, i)});
  }
  return crowd;
}

Crowd next_step(const Crowd& crowd) {
  Crowd next = crowd;
  for (auto& ball : next) ball.shape.center += ball.displacement;
  return next;
}

std::vector<Proxy> proxies_of(const Crowd& crowd) {
  std::vector<Proxy> proxies(crowd.size());
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    const Aabb<double> bounds = swept_bounds(crowd[i]);
    proxies[i].low = bounds.center - bounds.half_extents;
    proxies[i].high = bounds.center + bounds.half_extents;
  }
  return proxies;
}

std::int64_t count_meetings(const Crowd& crowd, const std::vector<ProxyPair>& pairs) {
  std::int64_t meetings = 0;
  for (const ProxyPair& pair : pairs) {
    const ToiStatus status = time_of_impact(crowd[pair.first], crowd[pair.second]).status;
    if (status == ToiStatus::hit || status == ToiStatus::overlapping) ++meetings;
  }
  return meetings;
}

std::string placement_name(const CrowdFactors& factors) { return factors.clustered ? "clustered" : "uniform"; }

}  // namespace thinwall
