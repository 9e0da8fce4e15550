#include <thinwall/experiments/scenes/missed.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <thinwall/discrete/broad_phase/uniform_grid.hpp>
#include <thinwall/experiments/scenes/bodies.hpp>
#include <thinwall/swept/dispatch.hpp>

namespace thinwall {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The box of both poses, rounded outward.
Proxy way_of(const Body& before, const Body& after) {
  const Aabb<double> a = box_of(before), b = box_of(after);
  Proxy proxy;
  for (int i = 0; i < 3; ++i) {
    const double low = std::min(a.center[i] - a.half_extents[i], b.center[i] - b.half_extents[i]);
    const double high = std::max(a.center[i] + a.half_extents[i], b.center[i] + b.half_extents[i]);
    const double room = 4 * std::numeric_limits<double>::epsilon() *
                        (std::abs(a.center[i]) + std::abs(b.center[i]) + a.half_extents[i] + b.half_extents[i]);
    proxy.low[i] = std::nextafter(low - room, -infinity);
    proxy.high[i] = std::nextafter(high + room, infinity);
  }
  proxy.group = after.group;
  proxy.mask = after.mask;
  proxy.is_static = after.is_static;
  proxy.skipped = std::holds_alternative<std::monostate>(after.shape);
  return proxy;
}

}  // namespace

struct MissedContacts::Memory {
  std::vector<Body> before;
  std::vector<Proxy> proxies;
  std::vector<ProxyPair> pairs;
};

MissedContacts::MissedContacts(const World& world) : memory_(std::make_unique<Memory>()) {
  memory_->before = world.bodies();
}
MissedContacts::~MissedContacts() = default;

std::vector<MissedContact> MissedContacts::after_step(const World& world, double dt) {
  const std::vector<Body>& after = world.bodies();
  std::vector<Body>& before = memory_->before;
  std::vector<bool> touched(after.size());
  const auto index_of = [&after](std::uint32_t id) {
    const auto found = std::lower_bound(after.begin(), after.end(), id,
                                        [](const Body& body, std::uint32_t wanted) { return body.id < wanted; });
    return static_cast<std::size_t>(found - after.begin());
  };
  for (const Hit& hit : world.hits()) {
    for (const std::uint32_t id : {hit.first, hit.second}) {
      const std::size_t i = index_of(id);
      if (i < after.size() && can_move(after[i])) touched[i] = true;
    }
  }
  memory_->proxies.clear();
  for (std::size_t i = 0; i < after.size(); ++i) {
    Proxy& proxy = memory_->proxies.emplace_back(way_of(before[i], after[i]));
    proxy.skipped |= touched[i];
  }
  find_pairs(UniformGrid{}, memory_->proxies, memory_->pairs);
  std::vector<MissedContact> missed;
  const double start = world.time() - dt;
  for (const ProxyPair& pair : memory_->pairs) {
    const Body &a = before[pair.first], &b = before[pair.second];
    const auto way = [&](std::size_t i) { return Vec3<double>(box_of(after[i]).center - box_of(before[i]).center); };
    const Moving<AnyShape> first{a.shape, way(pair.first)}, second{b.shape, way(pair.second)};
    const Toi<double> toi = time_of_impact(first, second);
    if (toi.status != ToiStatus::hit || overlaps(after[pair.first].shape, after[pair.second].shape)) continue;
    missed.push_back({a.id, b.id, start + toi.time * dt});
  }
  before = after;
  return missed;
}

}  // namespace thinwall
