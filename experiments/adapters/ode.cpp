#include <thinwall/experiments/adapters/engine.hpp>

#ifdef THINWALL_HAS_ODE
#include <array>
#include <mutex>
#include <new>

#include <ode/ode.h>
#endif

namespace thinwall {

namespace {

#ifdef THINWALL_HAS_ODE

/// ODE's worlds share data, and Debian builds it without the locks that would take (no ODE_EXT_mt_collisions): two threads crash
/// it. So worlds of different threads wait for each other; the same thread may have several.
std::recursive_mutex& ode_in_use() {
  static std::recursive_mutex mutex;
  return mutex;
}

dWorldID new_world() {
  static const bool prepared_once = [] { return dInitODE2(0) != 0; }();
  thread_local const bool prepared = dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll)) != 0;
  if (!prepared_once || !prepared) throw std::bad_alloc();
  return dWorldCreate();
}

class OdeWorld {
 public:
  OdeWorld(const EngineStage& stage, const EngineStart& start) : step_(stage.step) {
    const Vec3<double> sides = 2 * stage.wall_half_extents();
    dCreateBox(space_, sides[0], sides[1], sides[2]);
    const BodyState& ball = start.front();
    dMass mass;
    dMassSetSphereTotal(&mass, 1, stage.ball_radius());
    dBodySetMass(ball_, &mass);
    dGeomSetBody(dCreateSphere(space_, stage.ball_radius()), ball_);
    dBodySetPosition(ball_, ball.position[0], ball.position[1], ball.position[2]);
    dBodySetLinearVel(ball_, ball.velocity[0], ball.velocity[1], ball.velocity[2]);
  }
  ~OdeWorld() {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;

  void step() {
    dSpaceCollide(space_, this, &OdeWorld::meet);
    dWorldStep(world_, step_);
    dJointGroupEmpty(contacts_);
  }
  BodyState body(std::size_t) const {
    const dReal* p = dBodyGetPosition(ball_);
    const dReal* v = dBodyGetLinearVel(ball_);
    return {Vec3<double>(p[0], p[1], p[2]), Vec3<double>(v[0], v[1], v[2])};
  }

 private:
  static void meet(void* data, dGeomID a, dGeomID b) {
    auto& self = *static_cast<OdeWorld*>(data);
    std::array<dContact, 4> contacts = {};
    const int count = dCollide(a, b, static_cast<int>(contacts.size()), &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      dContact& contact = contacts[static_cast<std::size_t>(i)];
      contact.surface.mode = dContactBounce;
      contact.surface.bounce = 1;
      dJointAttach(dJointCreateContact(self.world_, self.contacts_, &contact), dGeomGetBody(a), dGeomGetBody(b));
    }
  }

  std::lock_guard<std::recursive_mutex> alone_{ode_in_use()};  // until the rest is gone
  double step_;
  dWorldID world_ = new_world();
  dSpaceID space_ = dSimpleSpaceCreate(nullptr);
  dJointGroupID contacts_ = dJointGroupCreate(0);
  dBodyID ball_ = dBodyCreate(world_);
};

#endif

}  // namespace

Engine ode_engine(const EngineChoices&) {
  return {
      .name = "ode",
      .called = "ODE",
      .package = "libode-dev",
      .made_of =
          "dWorldStep with a dContactBounce joint for each contact (bounce 1, no friction) and the world's own error "
          "reduction, a sphere and a box without a body. It has no continuous detection.",
#ifdef THINWALL_HAS_ODE
      .modes = {{.name = "discrete", .what = "as it comes", .poses_per_step = 1, .play = played_in<OdeWorld>()}},
#endif
  };
}

}  // namespace thinwall
