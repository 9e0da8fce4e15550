#include <thinwall/experiments/adapters/engine.hpp>

#ifdef THINWALL_HAS_BOX2D
#include <box2d/box2d.h>
#endif

namespace thinwall {

namespace {

#ifdef THINWALL_HAS_BOX2D

b2Vec2 in_box2d(const Vec3<double>& v) { return {static_cast<float>(v[0]), static_cast<float>(v[1])}; }
Vec3<double> out_of_box2d(const b2Vec2& v) { return Vec3<double>(v.x, v.y, 0); }

class Box2dWorld {
 public:
  Box2dWorld(const EngineStage& stage, const EngineStart& start, bool continuous, bool bullet)
      : world_(b2Vec2(0, 0)), step_(static_cast<float>(stage.step)) {
    world_.SetContinuousPhysics(continuous);
    b2PolygonShape wall_shape;
    const b2Vec2 half_extents = in_box2d(stage.wall_half_extents());
    wall_shape.SetAsBox(half_extents.x, half_extents.y);
    const b2BodyDef wall_def;
    b2FixtureDef fixture;
    fixture.shape = &wall_shape;
    fixture.friction = 0;
    fixture.restitution = 1;
    fixture.restitutionThreshold = 0;  // [m/s] what is slower sticks; 1 as it comes
    world_.CreateBody(&wall_def)->CreateFixture(&fixture);

    b2BodyDef ball_def;
    ball_def.type = b2_dynamicBody;
    ball_def.position = in_box2d(start.front().position);
    ball_def.linearVelocity = in_box2d(start.front().velocity);
    ball_def.bullet = bullet;
    b2CircleShape ball_shape;
    ball_shape.m_radius = static_cast<float>(stage.ball_radius());
    fixture.shape = &ball_shape;
    fixture.density = 1;
    ball_ = world_.CreateBody(&ball_def);
    ball_->CreateFixture(&fixture);
  }

  void step() { world_.Step(step_, 8, 3); }  // iterations as its manual advises
  BodyState body(std::size_t) const {
    return {out_of_box2d(ball_->GetPosition()), out_of_box2d(ball_->GetLinearVelocity())};
  }

 private:
  b2World world_;
  float step_;
  b2Body* ball_ = nullptr;
};

EngineMode box2d_mode(std::string name, std::string what, bool continuous, bool bullet) {
  return {.name = std::move(name),
          .what = std::move(what),
          .poses_per_step = continuous ? 0 : 1,
          .skin = b2_polygonRadius,
          .play = played_in<Box2dWorld>(continuous, bullet)};
}

#endif

}  // namespace

Engine box2d_engine(const EngineChoices&) {
  return {.name = "box2d",
          .called = "Box2D",
          .package = "libbox2d-dev",
          .made_of =
              "b2World in the plane of motion, 8 velocity and 3 position iterations, a circle and a static polygon, in "
              "float and in meters. Its polygons have a skin of 1 cm.",
#ifdef THINWALL_HAS_BOX2D
          .modes = {box2d_mode("discrete", "SetContinuousPhysics(false)", false, false),
                    box2d_mode("continuous", "as it comes: what moves is swept against what stays", true, false),
                    box2d_mode("bullet", "the ball's bullet flag is set", true, true)},
#endif
          .most_path = 2,
          .why_most_path = "b2_maxTranslation"};
}

}  // namespace thinwall
