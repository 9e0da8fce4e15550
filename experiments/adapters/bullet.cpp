#include <thinwall/experiments/adapters/engine.hpp>

#ifdef THINWALL_HAS_BULLET
#include <algorithm>

#include <fmt/format.h>

#include <btBulletDynamicsCommon.h>

#include <thinwall/experiments/lab/text.hpp>
#endif

namespace thinwall {

namespace {

#ifdef THINWALL_HAS_BULLET

btVector3 in_bullet(const Vec3<double>& v) {
  return {static_cast<btScalar>(v[0]), static_cast<btScalar>(v[1]), static_cast<btScalar>(v[2])};
}
Vec3<double> out_of_bullet(const btVector3& v) { return Vec3<double>(v.x(), v.y(), v.z()); }

/// The pools hold thousands of contacts otherwise, and a world is made for every shot.
btDefaultCollisionConstructionInfo small_pools() {
  btDefaultCollisionConstructionInfo info;
  info.m_defaultMaxPersistentManifoldPoolSize = 4;
  info.m_defaultMaxCollisionAlgorithmPoolSize = 4;
  return info;
}

/// In radii of the ball; 0: no continuous detection.
struct BulletSweep {
  double radius = 0;     ///< of the ball that is swept in place of the ball
  double threshold = 0;  ///< a step: what moves less is not swept
  bool bounces = false;  ///< contacts that a sweep finds have the bodies' restitution; not so as it comes
};

class BulletWorld {
 public:
  BulletWorld(const EngineStage& stage, const EngineStart& start, const BulletSweep& sweep)
      : wall_shape_(in_bullet(stage.wall_half_extents())),
        ball_shape_(static_cast<btScalar>(stage.ball_radius())),
        wall_(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &wall_shape_)),
        ball_(btRigidBody::btRigidBodyConstructionInfo(1, nullptr, &ball_shape_, inertia(ball_shape_))),
        step_(static_cast<btScalar>(stage.step)) {
    world_.setGravity({0, 0, 0});
    world_.getSolverInfo().m_restitutionVelocityThreshold = 0;  // [m/s] what is slower sticks; 0.2 as it comes
    for (btRigidBody* body : {&wall_, &ball_}) {
      body->setRestitution(1);
      body->setFriction(0);
      world_.addRigidBody(body);
    }
    btTransform pose;
    pose.setIdentity();
    pose.setOrigin(in_bullet(start.front().position));
    ball_.setWorldTransform(pose);
    ball_.setInterpolationWorldTransform(pose);
    ball_.setLinearVelocity(in_bullet(start.front().velocity));
    world_.setApplySpeculativeContactRestitution(sweep.bounces);
    if (sweep.radius > 0) {
      ball_.setCcdSweptSphereRadius(static_cast<btScalar>(sweep.radius * stage.ball_radius()));
      ball_.setCcdMotionThreshold(static_cast<btScalar>(sweep.threshold * stage.ball_radius()));
    }
  }
  ~BulletWorld() {
    world_.removeRigidBody(&ball_);
    world_.removeRigidBody(&wall_);
  }
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  void step() { world_.stepSimulation(step_, 0); }
  BodyState body(std::size_t) const {
    return {out_of_bullet(ball_.getWorldTransform().getOrigin()), out_of_bullet(ball_.getLinearVelocity())};
  }

 private:
  static btVector3 inertia(const btSphereShape& shape) {
    btVector3 inertia;
    shape.calculateLocalInertia(1, inertia);
    return inertia;
  }

  btDefaultCollisionConfiguration configuration_{small_pools()};
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broad_phase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broad_phase_, &solver_, &configuration_};
  btBoxShape wall_shape_;
  btSphereShape ball_shape_;
  btRigidBody wall_, ball_;
  btScalar step_;
};

std::vector<EngineMode> bullet_modes(const EngineChoices& choices) {
  std::vector<EngineMode> modes = {
      {.name = "discrete", .what = "as it comes", .poses_per_step = 1, .play = played_in<BulletWorld>(BulletSweep{})}};
  const auto add = [&](double radius, bool bounces) {
    const double threshold = choices.motion_threshold;
    modes.push_back({.name = fmt::format("ccd_{}{}", exact_text(radius), bounces ? "_bouncing" : ""),
                     .what = fmt::format("setCcdSweptSphereRadius({0} r), setCcdMotionThreshold({1} r){2}", radius,
                                         threshold, bounces ? ", setApplySpeculativeContactRestitution(true)" : ""),
                     .play = played_in<BulletWorld>(BulletSweep{radius, threshold, bounces})});
  };
  for (const double radius : choices.swept_radius) add(radius, false);
  if (!choices.swept_radius.empty()) add(std::ranges::max(choices.swept_radius), true);
  return modes;
}

#else

std::vector<EngineMode> bullet_modes(const EngineChoices&) { return {}; }

#endif

}  // namespace

Engine bullet_engine(const EngineChoices& choices) {
  return {.name = "bullet",
          .called = "Bullet",
          .package = "libbullet-dev",
          .made_of =
              "btDiscreteDynamicsWorld with the default collision configuration, the dynamic tree and the sequential "
              "impulse solver, a btSphereShape and a static btBoxShape, in float.",
          .modes = bullet_modes(choices)};
}

}  // namespace thinwall
