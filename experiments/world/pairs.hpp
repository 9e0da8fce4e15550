#pragma once
/// What a step is made of: how bodies turn, boxes, pairs, contacts, impulses.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <set>
#include <span>
#include <string_view>
#include <type_traits>
#include <unordered_map>
#include <vector>

#include <thinwall/discrete/broad_phase/proxy.hpp>
#include <thinwall/experiments/world/world.hpp>
#include <thinwall/swept/swept_volume.hpp>
#include <thinwall/swept/turning/turning_bounds.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>

namespace thinwall {

// ---- Which bodies turn: a ball looks the same however it does, and its normals pass through its center.

template <class A>
inline constexpr bool looks_turned = std::is_same_v<A, Obb<double>> || std::is_same_v<A, Capsule<double>>;

/// True if its orientation can change in a step, for anyone to see.
inline bool can_turn(const Body& body) {
  return body.turns && can_move(body) && !std::holds_alternative<Sphere<double>>(body.shape);
}

/// How a body turns within a step, beside its motion: at what rate, and how far it has at that motion's `anchor`.
struct Spin {
  Vec3<double> velocity = Vec3<double>::Zero();    ///< [rad/s] about its center, constant until the next contact
  Mat3<double> turned = Mat3<double>::Identity();  ///< from the start of the step to the anchor
  int looks = 0;                                   ///< at contacts that it was in already
};

/// The spin of body `which`, or nothing if it cannot turn. `spins`: one a body, or none at all where nothing turns.
template <class Spins> auto spin_of(Spins& spins, const Body& body, std::size_t which) -> decltype(spins.data()) {
  return !spins.empty() && can_turn(body) ? &spins[which] : nullptr;
}

/// The shape turned about its center, its axes made true again and its length kept: else rounding would add up from step to step.
AnyShape turned_true(const AnyShape& shape, const Mat3<double>& turn);

// ---- What resists: the inertia of a solid of uniform density.

/// [m^2] The squared radii of gyration about the center: one along each axis. Times the mass they are moments of inertia.
/// Source: the sphere, box, cylinder and hemisphere of any table; a capsule is added up in docs/world.md.
struct Gyration {
  Mat3<double> axes = Mat3<double>::Identity();  ///< unit columns
  Vec3<double> squares = Vec3<double>::Zero();
};
Gyration gyration_of(const AnyShape& shape);

/// [1/(kg m^2)] What a unit of angular momentum does to the angular velocity of a body with this shape. Zero about an axis about which it
/// has no extent, for none can be had there, and for a body that nothing moves.
Mat3<double> inverse_inertia(const AnyShape& shape, double inverse_mass);

/// [J]
long double energy_of_turning(const Body& body);

/// [m] How far the farthest point of it is from its center.
double farthest_point(const AnyShape& shape);

// ---- How two are asked.

/// What a world asks of those that turn: never late, and as near to the exact time as costs no more than a few looks.
inline constexpr ConservativeAdvancement<double> spin_sweep = {.tolerance = 0x1p-40, .max_evaluations = 4096};

/// A straight motion that turns as well, if such a shape can.
template <class A> auto spinning(const Moving<A>& m, const Vec3<double>& rotation) {
  if constexpr (looks_turned<A>) {
    return Turning<A>{m.shape, m.displacement, rotation};
  } else {
    return without_spin(m);
  }
}

// ---- How thin a body is.

inline double least_half_width(const Sphere<double>& s) { return s.radius; }
inline double least_half_width(const Aabb<double>& b) { return b.half_extents.minCoeff(); }
inline double least_half_width(const Obb<double>& b) { return b.half_extents.minCoeff(); }
inline double least_half_width(const Capsule<double>& c) { return c.radius; }

/// [m] Of what has no shape, infinity.
inline double least_half_width(const AnyShape& shape) {
  return of_shape(shape, std::numeric_limits<double>::infinity(), [](const auto& s) { return least_half_width(s); });
}

// ---- What two bodies in contact do to each other: an impulse along the normal, with restitution, and no friction.

/// A body's part of what parts it from another: with masses m_a and m_b, m_b / (m_a + m_b) for A. Neither overflows.
/// At least one of the two must be moved by impulses.
inline double share_of(const Body& a, const Body& b) {
  if (inverse_mass(a) == 0) return 0;
  return inverse_mass(b) == 0 ? 1 : 1 / (1 + a.mass / b.mass);
}
inline bool is_moved_by_impulses(const Body& body) { return inverse_mass(body) > 0; }

/// How a body moves within a step: where it is at `anchor`, relative to its place at the start, and at what velocity.
struct BodyMotion {
  Vec3<double> offset = Vec3<double>::Zero();    ///< [m] at `anchor`
  Vec3<double> velocity = Vec3<double>::Zero();  ///< [m/s]
  double anchor = 0;                             ///< [1] part of the step
  double speed = 0;           ///< [m/s] the largest |v_x| + |v_y| + |v_z| so far: what rounding is of
  std::uint32_t version = 0;  ///< changes with the motion
  std::uint32_t arrived = 0;  ///< the version that came to `anchor`: those after it turned there
  int events = 0;             ///< hits so far
  bool waiting = false;       ///< does not move any more in this step
};

/// [m/s] In effect: zero while it waits.
inline Vec3<double> moving_at(const BodyMotion& motion) {
  return motion.waiting ? Vec3<double>(Vec3<double>::Zero()) : motion.velocity;
}

/// [m] Where a body is at `time` [1], relative to its place at the start of the step of dt [s].
inline Vec3<double> offset_at(const BodyMotion& motion, double time, double dt) {
  if (time == motion.anchor) return motion.offset;
  return motion.offset + moving_at(motion) * (dt * (time - motion.anchor));
}

/// How far it has turned by `time` [1], from the start of the step of dt [s].
inline Mat3<double> turned_at(const Spin& spin, const BodyMotion& motion, double time, double dt) {
  if (time == motion.anchor || motion.waiting || spin.velocity == Vec3<double>::Zero()) return spin.turned;
  const double angle = safe_norm(spin.velocity) * (dt * (time - motion.anchor));
  return rotation_about<double>(safe_unit(spin.velocity), angle) * spin.turned;
}

/// A body on its way through a step.
struct Mover {
  const Body& body;
  BodyMotion& motion;
  Spin* spin;  ///< nothing if it cannot turn
};

/// [m] From its center to a point, at `time` [1]; zero if it does not turn, and nobody asks.
inline Vec3<double> arm_of(const Mover& m, const Vec3<double>& point, double time, double dt) {
  if (!m.spin) return Vec3<double>::Zero();
  return point - (position(m.body) + offset_at(m.motion, time, dt));
}

/// [m/s] Of the point of it at the end of the arm. `in_effect`: zero while it waits.
inline Vec3<double> velocity_of(const Mover& m, const Vec3<double>& arm, bool in_effect) {
  const Vec3<double> straight = in_effect ? moving_at(m.motion) : m.motion.velocity;
  if (!m.spin || (in_effect && m.motion.waiting)) return straight;
  return straight + cross(m.spin->velocity, arm);
}

/// [m/s] What rounding alone may make of a closing speed of zero, once an impulse has made it zero: 16 epsilon of the
/// speeds there were; four times that with arms and inertia. Source: derived in docs/world.md.
inline double closing_noise(const Mover& a, const Mover& b) {
  const double noise = 16 * std::numeric_limits<double>::epsilon() * (a.motion.speed + b.motion.speed);
  return a.spin || b.spin ? 4 * noise : noise;
}

/// [m/s] > 0 if A and B approach along the normal, from A to B.
inline double closing_speed(const Vec3<double>& normal, const Vec3<double>& a, const Vec3<double>& b) {
  return normal.dot(Vec3<double>(a - b));
}

/// [m/s] The same of their points at `point` [m], at `time` [1] of the step of dt [s]. `in_effect`: see velocity_of.
inline double closing_speed(const Mover& a, const Mover& b, const Vec3<double>& normal, const Vec3<double>& point,
                            double time, double dt, bool in_effect) {
  const auto velocity = [&](const Mover& m) { return velocity_of(m, arm_of(m, point, time, dt), in_effect); };
  return closing_speed(normal, velocity(a), velocity(b));
}

/// [m/s] The largest speed of any point of it, in the sum of components: what rounding is of.
inline double speed_of(const Body& body, const Vec3<double>& velocity, const Spin* spin) {
  const double straight = velocity.cwiseAbs().sum();
  return spin ? straight + spin->velocity.cwiseAbs().sum() * farthest_point(body.shape) : straight;
}

/// What an impulse of 1 Ns along the normal does to a body: by how much it turns, and the speed along it that its point gains.
struct Yield {
  Vec3<double> turn = Vec3<double>::Zero();  ///< [rad/s] per Ns
  double speed = 0;                          ///< [m/s] per Ns
};
Yield yield_of(const Mover& m, const Vec3<double>& arm, const Vec3<double>& normal);

/// Lets the two bounce where they are, at a point [m] of contact, if they approach by more than rounding. True if they did.
inline bool bounce(const Mover& a, const Mover& b, const Vec3<double>& normal, const Vec3<double>& point) {
  if (!is_moved_by_impulses(a.body) && !is_moved_by_impulses(b.body)) return false;
  const Vec3<double> arm_a = arm_of(a, point, a.motion.anchor, 0), arm_b = arm_of(b, point, b.motion.anchor, 0);
  const double closing = closing_speed(normal, velocity_of(a, arm_a, false), velocity_of(b, arm_b, false));
  if (!(closing > closing_noise(a, b))) return false;
  const double change = (1 + std::max(a.body.restitution, b.body.restitution)) * closing;
  const auto push = [&](const Mover& m, const Vec3<double>& by, const Vec3<double>& turn) {
    if (!is_moved_by_impulses(m.body)) return;
    m.motion.velocity += by;
    if (m.spin) m.spin->velocity += turn;
    m.motion.speed = std::max(m.motion.speed, speed_of(m.body, m.motion.velocity, m.spin));
    ++m.motion.version;
  };
  if (!a.spin && !b.spin) {
    const Vec3<double> none = Vec3<double>::Zero();
    push(a, normal * (-change * share_of(a.body, b.body)), none);
    push(b, normal * (change * share_of(b.body, a.body)), none);
    return true;
  }
  const Yield of_a = yield_of(a, arm_a, normal), of_b = yield_of(b, arm_b, normal);
  const double impulse = change / (of_a.speed + of_b.speed);  // [Ns]
  push(a, normal * (-impulse * inverse_mass(a.body)), of_a.turn * -impulse);
  push(b, normal * (impulse * inverse_mass(b.body)), of_b.turn * impulse);
  return true;
}

// ---- The box that holds a body in what is left of a step, as the broad phase wants it.

/// [rad] How far it turns in what is left of the step of dt [s] after `time` [1].
inline Vec3<double> rotation_from(const BodyMotion& motion, const Spin& spin, double time, double dt) {
  return motion.waiting ? Vec3<double>(Vec3<double>::Zero()) : Vec3<double>(spin.velocity * (dt * (1 - time)));
}

/// From the motion's anchor to the end of the step of dt [s].
template <class A> Turning<A> turning_of(const A& shape, const BodyMotion& motion, const Spin& spin, double dt) {
  return {moved(turned(shape, spin.turned), motion.offset), moving_at(motion) * (dt * (1 - motion.anchor)),
          rotation_from(motion, spin, motion.anchor, dt)};
}

/// From the motion's anchor to the end of the step of dt [s], rounded outward.
inline Proxy proxy_of(const Body& body, const BodyMotion& motion, const Spin* spin, double dt) {
  Proxy proxy;
  proxy.group = body.group;
  proxy.mask = body.mask;
  proxy.is_static = body.is_static;
  proxy.skipped = std::holds_alternative<std::monostate>(body.shape);
  const Vec3<double> displacement = moving_at(motion) * (dt * (1 - motion.anchor));
  with_shape(body.shape, [&]<class A>(const A& shape) {
    const Aabb<double> box = [&] {
      if constexpr (looks_turned<A>) {
        if (spin) return swept_bounds(turning_of(shape, motion, *spin, dt));
      }
      return swept_bounds(Moving<A>{moved(shape, motion.offset), displacement});
    }();
    proxy.low = box.center - box.half_extents;
    proxy.high = box.center + box.half_extents;
  });
  return proxy;
}

/// True if the box of `inner` lies in that of `outer`.
inline bool holds_box(const Proxy& outer, const Proxy& inner) {
  return (outer.low.array() <= inner.low.array()).all() && (inner.high.array() <= outer.high.array()).all();
}

// ---- Asks many pairs at once, grouped by type pair, split among threads in blocks of fixed size: the answers and their order
// do not depend on the threads.

/// A pair in contact, by the places of its bodies in the list.
struct Touch {
  std::uint32_t first = 0, second = 0;         ///< places, first < second
  double time = 0;                             ///< [1] part of the step
  bool at_start = false;                       ///< in contact where the question starts already
  bool gave_up = false;                        ///< proven apart until `time`, and nothing after: they turn too far
  Vec3<double> normal = Vec3<double>::Zero();  ///< unit, from first to second
  Vec3<double> point = Vec3<double>::Zero();   ///< [m]
  double penetration = 0;                      ///< [m] >= 0; at an instant alone
};

/// Undoes `part` [1] of the penetration, the lighter body moving more.
inline void part_bodies(std::span<const Body> bodies, std::vector<BodyMotion>& motions, const Touch& touch,
                        double part) {
  const Body &a = bodies[touch.first], &b = bodies[touch.second];
  const double way = touch.penetration * part;
  if (is_moved_by_impulses(a)) motions[touch.first].offset -= touch.normal * (way * share_of(a, b));
  if (is_moved_by_impulses(b)) motions[touch.second].offset += touch.normal * (way * share_of(b, a));
}

/// What a question cost, for the report.
struct Asked {
  std::int64_t pairs = 0;
  std::int64_t gated = 0;  ///< not swept, because both moved less than the gate
};

/// The bodies as the narrow phase reads them: each at some time of the step, with what is left of its motion.
class NarrowPhase {
 public:
  NarrowPhase() = default;
  NarrowPhase(const NarrowPhase&) = delete;
  NarrowPhase& operator=(const NarrowPhase&) = delete;
  virtual ~NarrowPhase() = default;

  /// As many bodies as given, where their motions' anchors are. Those that cannot move keep their old place unless
  /// `resting_too`.
  /// `spins`: one a body, or none where nothing turns.
  virtual void place(std::span<const Body> bodies, std::span<const BodyMotion> motions, std::span<const Spin> spins,
                     double dt, bool resting_too) = 0;
  /// One of them, at `time` [1]. `spin`: nothing if it cannot turn.
  virtual void place_one(std::uint32_t which, const Body& body, const BodyMotion& motion, const Spin* spin, double time,
                         double dt) = 0;

  /// Appends the pairs that come into contact in what is left of the step from `start` [1] on, in the order of `pairs`.
  /// All must be placed at that time. gate [1]: see WorldOptions.
  virtual Asked sweep(std::span<const ProxyPair> pairs, double start, double gate, std::vector<Touch>& touches) = 0;
  /// Appends the pairs in contact where they are placed, with penetrations.
  virtual Asked look(std::span<const ProxyPair> pairs, std::vector<Touch>& touches) = 0;

  /// True if one of them turns in what is left of the step.
  virtual bool turns(const ProxyPair& pair) const = 0;
  /// [1] of what is left of the step, of two that touch where they are placed: until then neither sinks into the other by more than a
  /// 1024th of the lesser least half width of the two.
  virtual double until_next_look(const ProxyPair& pair, const Vec3<double>& normal) const = 0;

  virtual std::size_t bytes() const = 0;
};

/// With the kernels that the plan names; on `threads` >= 1 threads.
std::unique_ptr<NarrowPhase> make_narrow_phase(const Plan& plan, int threads);

// ---- Whom a body may meet in what is left of a step, kept up to date while bodies change course.
//
// Every body has a box that holds the rest of its path, and two bodies are linked if their boxes meet. The broad phase gives
// the first links. A body whose new path stays in its box keeps box and links; another gets a new box, and is linked to all
// whose boxes it meets. So two bodies that are not linked have disjoint boxes and cannot meet. However often bodies turn, each
// has one box, and at most one link to each other.

class Neighbors {
 public:
  Neighbors();
  ~Neighbors();

  /// Begins a step: the boxes and the links, both of which must live until its end. `has_links` [by body] is false for bodies
  /// that never change course, and are not asked about. `everyone`: link all, whatever their boxes.
  void begin(std::vector<Proxy>& proxies, std::span<const ProxyPair> pairs, const std::vector<bool>& has_links,
             bool everyone);

  /// The body goes on in this box.
  void change(std::uint32_t which, const Proxy& box);

  /// All that may be met, in ascending order.
  const std::vector<std::uint32_t>& of(std::uint32_t which);

  std::size_t bytes() const;

 private:
  void link_pairs();
  void search(const Proxy& box);

  struct Tree;
  std::vector<Proxy>* proxies_ = nullptr;
  std::span<const ProxyPair> pairs_;
  const std::vector<bool>* has_links_ = nullptr;
  bool everyone_ = false, linked_ = false;
  std::vector<std::uint32_t> start_, links_;                          // of the pairs, body by body
  std::unordered_map<std::uint32_t, std::set<std::uint32_t>> later_;  // links made since
  std::size_t searches_ = 0;
  std::unique_ptr<Tree> tree_;  // of all boxes, once enough of them have been searched
  std::vector<std::uint32_t> found_, answer_;
};

// ---- One of the broad phases, chosen by name, with its working memory.

class PairFinder {
 public:
  PairFinder() = default;
  PairFinder(const PairFinder&) = delete;
  PairFinder& operator=(const PairFinder&) = delete;
  virtual ~PairFinder() = default;
  virtual void find(std::span<const Proxy> proxies, std::vector<ProxyPair>& pairs, std::size_t max_pairs) = 0;
};

std::vector<std::string_view> pair_finder_names();  ///< of BroadPhases, in its order

std::unique_ptr<PairFinder> make_pair_finder(std::string_view name);  ///< one of those

}  // namespace thinwall
