#include <thinwall/experiments/engines/engine.hpp>

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

/// Lengths of 0: no continuous detection.
struct BulletSweep {
  double radius = 0;     ///< [m] of the ball that is swept in place of the ball
  double threshold = 0;  ///< [m] a step: what moves less is not swept
  bool bounces = false;  ///< contacts that a sweep finds have the bodies' restitution; not so as it comes
};

class BulletWorld final : public EngineWorld {
 public:
  BulletWorld(const EngineScene& scene, const BodyState& ball, const BulletSweep& sweep)
      : wall_shape_(in_bullet({scene.thickness / 2, scene.half_side, scene.half_side})),
        ball_shape_(static_cast<btScalar>(scene.radius)),
        wall_(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &wall_shape_)),
        ball_(btRigidBody::btRigidBodyConstructionInfo(1, nullptr, &ball_shape_, inertia(ball_shape_))),
        step_(static_cast<btScalar>(scene.step)) {
    world_.setGravity({0, 0, 0});
    world_.getSolverInfo().m_restitutionVelocityThreshold = 0;  // [m/s] what is slower sticks; 0.2 as it comes
    for (btRigidBody* body : {&wall_, &ball_}) {
      body->setRestitution(1);
      body->setFriction(0);
      world_.addRigidBody(body);
    }
    btTransform pose;
    pose.setIdentity();
    pose.setOrigin(in_bullet(ball.position));
    ball_.setWorldTransform(pose);
    ball_.setInterpolationWorldTransform(pose);
    ball_.setLinearVelocity(in_bullet(ball.velocity));
    world_.setApplySpeculativeContactRestitution(sweep.bounces);
    if (sweep.radius > 0) {
      ball_.setCcdSweptSphereRadius(static_cast<btScalar>(sweep.radius));
      ball_.setCcdMotionThreshold(static_cast<btScalar>(sweep.threshold));
    }
  }
  ~BulletWorld() override {
    world_.removeRigidBody(&ball_);
    world_.removeRigidBody(&wall_);
  }
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  void step() override { world_.stepSimulation(step_, 0); }
  BodyState ball() const override {
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
  std::vector<EngineMode> modes = {{.name = "discrete",
                                    .what = "as it comes",
                                    .poses_per_step = 1,
                                    .make = [](const EngineScene& scene, const BodyState& ball) {
                                      return std::make_unique<BulletWorld>(scene, ball, BulletSweep{});
                                    }}};
  const auto add = [&](double factor, bool bounces) {
    const auto make = [=, threshold = choices.motion_threshold](const EngineScene& scene, const BodyState& ball) {
      return std::make_unique<BulletWorld>(scene, ball,
                                           BulletSweep{factor * scene.radius, threshold * scene.radius, bounces});
    };
    modes.push_back(
        {.name = fmt::format("ccd_{}{}", exact_text(factor), bounces ? "_bouncing" : ""),
         .what = fmt::format("setCcdSweptSphereRadius({0} r), setCcdMotionThreshold({1} r){2}", factor,
                             choices.motion_threshold, bounces ? ", setApplySpeculativeContactRestitution(true)" : ""),
         .make = make});
  };
  for (const double factor : choices.swept_radius) add(factor, false);
  if (!choices.swept_radius.empty()) add(std::ranges::max(choices.swept_radius), true);
  return modes;
}

#else

constexpr std::vector<EngineMode> (*bullet_modes)(const EngineChoices&) = nullptr;

#endif

}  // namespace

Engine bullet_engine() {
  return {.name = "bullet",
          .called = "Bullet",
          .package = "libbullet-dev",
          .made_of =
              "btDiscreteDynamicsWorld with the default collision configuration, the dynamic tree and the sequential "
              "impulse solver, a btSphereShape and a static btBoxShape, in float.",
          .modes = bullet_modes};
}

}  // namespace thinwall
