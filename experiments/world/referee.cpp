#include <thinwall/experiments/world/referee.hpp>

#include <algorithm>
#include <limits>

#include <thinwall/discrete/broad_phase/uniform_grid.hpp>
#include <thinwall/experiments/world/pairs.hpp>
#include <thinwall/swept/dispatch.hpp>

namespace thinwall {

namespace {

/// [rad] How far a body that nothing touched turned in a step of dt [s].
Vec3<double> rotation_of(const Body& after, double dt) {
  return can_turn(after) ? Vec3<double>(after.angular_velocity * dt) : Vec3<double>(Vec3<double>::Zero());
}

/// [m] From one place to the other: the way at the velocity, where the places are roundings of it. Two that pass flush would seem to meet.
Vec3<double> flown(const Body& before, const Body& after, double dt) {
  const Vec3<double> from = position(before), to = position(after), way = after.velocity * dt;
  const Vec3<double> rounding =
      4 * std::numeric_limits<double>::epsilon() * (from.cwiseAbs() + to.cwiseAbs() + way.cwiseAbs());
  const bool is_it = ((to - from - way).cwiseAbs().array() <= rounding.array()).all();
  return is_it ? way : Vec3<double>(to - from);
}

/// The box of the whole way, as the pair is asked about.
Proxy way_of(const Body& before, const Body& after, double dt) {
  BodyMotion motion;
  motion.velocity = flown(before, after, dt);
  Spin spin;
  spin.velocity = rotation_of(after, dt);
  return proxy_of(before, motion, can_turn(after) ? &spin : nullptr, 1);
}

/// When two first touch that turn.
Toi<double> impact_of_spinning(const Moving<AnyShape>& a, const Moving<AnyShape>& b, const Vec3<double>& spin_a,
                               const Vec3<double>& spin_b) {
  return visit_shapes(a.shape, b.shape, Toi<double>{}, [&]<class A, class B>(const A& x, const B& y) {
    return time_of_impact(spin_sweep, spinning(Moving<A>{x, a.displacement}, spin_a),
                          spinning(Moving<B>{y, b.displacement}, spin_b));
  });
}

/// True if two that fly straight go into each other by more than rounding: not if one lies on the other, or slides along it.
bool goes_in(const Toi<double>& toi, const Moving<AnyShape>& a, const Moving<AnyShape>& b) {
  const auto size = [](const Moving<AnyShape>& m) {
    return of_shape(m.shape, 0.0, [](const auto& s) { return magnitude(s); }) + m.displacement.cwiseAbs().sum();
  };
  const double way = toi.normal.dot(Vec3<double>(a.displacement - b.displacement)) * (1 - toi.time);
  return way > 16 * std::numeric_limits<double>::epsilon() * (size(a) + size(b));
}

}  // namespace

std::vector<Meeting> Referee::missed_by(const World& world, double dt) {
  const std::vector<Body>& after = world.bodies();
  std::vector<bool> touched(after.size());
  const auto index_of = [&after](std::uint32_t id) {
    return static_cast<std::size_t>(std::ranges::lower_bound(after, id, {}, &Body::id) - after.begin());
  };
  for (const Hit& hit : world.hits()) {
    for (const std::uint32_t id : {hit.first, hit.second}) {
      const std::size_t i = index_of(id);
      if (i < after.size() && can_move(after[i])) touched[i] = true;
    }
  }
  proxies_.clear();
  for (std::size_t i = 0; i < after.size(); ++i) {
    Proxy& proxy = proxies_.emplace_back(way_of(before_[i], after[i], dt));
    proxy.skipped |= touched[i];
  }
  find_pairs(UniformGrid{}, proxies_, pairs_);
  std::vector<Meeting> missed;
  const double start = world.time() - dt;
  for (const ProxyPair& pair : pairs_) {
    const Body &a = before_[pair.first], &b = before_[pair.second];
    const Moving<AnyShape> first{a.shape, flown(a, after[pair.first], dt)},
        second{b.shape, flown(b, after[pair.second], dt)};
    const Vec3<double> spin_a = rotation_of(after[pair.first], dt), spin_b = rotation_of(after[pair.second], dt);
    const bool turns = spin_a != Vec3<double>::Zero() || spin_b != Vec3<double>::Zero();
    const Toi<double> toi = turns ? impact_of_spinning(first, second, spin_a, spin_b) : time_of_impact(first, second);
    if (toi.status != ToiStatus::hit || (!turns && !goes_in(toi, first, second))) continue;
    if (overlaps(after[pair.first].shape, after[pair.second].shape)) continue;
    missed.push_back({a.id, b.id, start + toi.time * dt});
  }
  before_ = after;
  return missed;
}

}  // namespace thinwall
