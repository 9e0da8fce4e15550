/// Bullet, in float as Debian builds it by default: three of its casts, its rays, and its contacts as contactPairTest finds them.
/// Without it this is empty.

#include "peers/peer.hpp"

#ifndef THINWALL_HAS_BULLET

bool thinwall::bench::add_bullet() { return false; }

#else

#include <btBulletDynamicsCommon.h>

#include <memory>

#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

namespace thinwall::bench {

namespace {

btVector3 bt(const Vec3<double>& v) { return {btScalar(v.x()), btScalar(v.y()), btScalar(v.z())}; }

struct BulletShape {
  std::unique_ptr<btConvexShape> shape;
  btTransform at;
};

BulletShape bullet_shape(const Ball& s) {
  return {std::make_unique<btSphereShape>(btScalar(s.radius)), btTransform(btQuaternion::getIdentity(), bt(s.center))};
}
BulletShape bullet_shape(const Box& b) {
  return {std::make_unique<btBoxShape>(bt(b.half_extents)), btTransform(btQuaternion::getIdentity(), bt(b.center))};
}
BulletShape bullet_shape(const TurnedBox& b) {
  const Vec3<double> x = b.axes.row(0), y = b.axes.row(1), z = b.axes.row(2);
  btMatrix3x3 turn;
  turn[0] = bt(x);
  turn[1] = bt(y);
  turn[2] = bt(z);
  return {std::make_unique<btBoxShape>(bt(b.half_extents)), btTransform(turn, bt(b.center))};
}
BulletShape bullet_shape(const Pill& c) {
  const Vec3<double> along = c.b - c.a;
  const double length = std::sqrt(along.squaredNorm());
  const btQuaternion turn = shortestArcQuat(btVector3(0, 1, 0), bt(along / length));
  return {std::make_unique<btCapsuleShape>(btScalar(c.radius), btScalar(length)), btTransform(turn, bt(center(c)))};
}

struct BulletCast {
  BulletShape a, b;
  btTransform a_to, b_to;
};

btTransform shifted(const btTransform& at, const Vec3<double>& by) {
  return btTransform(at.getBasis(), at.getOrigin() + bt(by));
}

template <class Cast> double bullet_time(Cast& cast, const BulletCast& q) {
  btConvexCast::CastResult result;
  result.m_fraction = 1;
  const bool hit = cast.calcTimeOfImpact(q.a.at, q.a_to, q.b.at, q.b_to, result);
  return hit ? double(result.m_fraction) : never;
}

struct BulletRay {
  std::unique_ptr<btCollisionObject> object;
  BulletShape shape;
  btTransform from, to;
};

/// The deepest point of contact.
struct DeepestContact : btCollisionWorld::ContactResultCallback {
  double depth = never;
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    if (point.getDistance() > 0) return 0;
    const double found = -double(point.getDistance());
    depth = depth > last ? found : std::max(depth, found);
    return 0;
  }
  static constexpr double last = std::numeric_limits<double>::max();
};

struct BulletPair {
  BulletShape a, b;
  std::unique_ptr<btCollisionObject> object_a, object_b;
};

std::unique_ptr<btCollisionObject> object_of(const BulletShape& shape) {
  auto object = std::make_unique<btCollisionObject>();
  object->setCollisionShape(shape.shape.get());
  object->setWorldTransform(shape.at);
  return object;
}

/// A world to ask contactPairTest of; nothing is in it.
btCollisionWorld& bullet_world() {
  static btDefaultCollisionConfiguration configuration;
  static btCollisionDispatcher dispatcher(&configuration);
  static btDbvtBroadphase broad_phase;
  static btCollisionWorld world(&dispatcher, &broad_phase, &configuration);
  return world;
}

}  // namespace

bool add_bullet() {
  for_each_cast([](const std::string& pair, auto set, const Operations& least) {
    const auto prepare = [](const auto& q) {
      BulletCast made{bullet_shape(q.a.shape), bullet_shape(q.b.shape), {}, {}};
      made.a_to = shifted(made.a.at, q.a.displacement);
      made.b_to = shifted(made.b.at, q.b.displacement);
      return made;
    };
    const std::string name = "time_of_impact/" + pair;
    add_row(name + "/bullet_subsimplex_cast", set, least, prepare, [](const BulletCast& q) {
      btVoronoiSimplexSolver simplex;
      btSubsimplexConvexCast cast(q.a.shape.get(), q.b.shape.get(), &simplex);
      return bullet_time(cast, q);
    });
    add_row(name + "/bullet_gjk_cast", set, least, prepare, [](const BulletCast& q) {
      btVoronoiSimplexSolver simplex;
      btGjkConvexCast cast(q.a.shape.get(), q.b.shape.get(), &simplex);
      return bullet_time(cast, q);
    });
    add_row(name + "/bullet_continuous_convex", set, least, prepare, [](const BulletCast& q) {
      btVoronoiSimplexSolver simplex;
      btGjkEpaPenetrationDepthSolver depth;
      btContinuousConvexCollision cast(q.a.shape.get(), q.b.shape.get(), &simplex, &depth);
      return bullet_time(cast, q);
    });
  });
  for_each_ray([](const std::string& shape, auto set, const Operations& least) {
    add_row(
        "raycast/" + shape + "/bullet", set, least,
        [](const auto& q) {
          BulletRay made{nullptr, bullet_shape(q.shape), btTransform::getIdentity(), btTransform::getIdentity()};
          made.object = object_of(made.shape);
          made.from.setOrigin(bt(q.ray.origin));
          made.to.setOrigin(bt(q.ray.origin + q.ray.direction));
          return made;
        },
        [](const BulletRay& q) {
          btCollisionWorld::ClosestRayResultCallback closest(q.from.getOrigin(), q.to.getOrigin());
          btCollisionWorld::rayTestSingle(q.from, q.to, q.object.get(), q.shape.shape.get(), q.shape.at, closest);
          return closest.hasHit() ? double(closest.m_closestHitFraction) : never;
        });
  });
  for_each_pose([](const std::string& pair, auto set) {
    add_row(
        "contact/" + pair + "/bullet", set, {},
        [](const auto& q) {
          BulletPair made{bullet_shape(q.a), bullet_shape(q.b), nullptr, nullptr};
          made.object_a = object_of(made.a);
          made.object_b = object_of(made.b);
          return made;
        },
        [](const BulletPair& q) {
          DeepestContact deepest;
          bullet_world().contactPairTest(q.object_a.get(), q.object_b.get(), deepest);
          return deepest.depth;
        });
  });
  return true;
}

}  // namespace thinwall::bench

#endif
