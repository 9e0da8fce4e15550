/// FCL: its continuous collision, by conservative advancement and as it is by default (poses along the way, the first of which is
/// in contact), and its contacts and overlap tests. Without it this is empty.

#include "peers/peer.hpp"

#ifndef THINWALL_HAS_FCL

bool thinwall::bench::add_fcl() { return false; }

#else

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>

#include <memory>

namespace thinwall::bench {

namespace {

struct FclBody {
  std::shared_ptr<fcl::CollisionGeometryd> shape;
  fcl::Transform3d from, to;
};

FclBody fcl_body(std::shared_ptr<fcl::CollisionGeometryd> shape, const Vec3<double>& at, const Vec3<double>& motion,
                 const Mat3<double>& axes = Mat3<double>::Identity()) {
  FclBody body{std::move(shape), fcl::Transform3d::Identity(), fcl::Transform3d::Identity()};
  body.from.linear() = body.to.linear() = axes;
  body.from.translation() = at;
  body.to.translation() = at + motion;
  return body;
}

FclBody fcl_body(const Ball& s, const Vec3<double>& motion) {
  return fcl_body(std::make_shared<fcl::Sphered>(s.radius), s.center, motion);
}
FclBody fcl_body(const Box& b, const Vec3<double>& motion) {
  return fcl_body(std::make_shared<fcl::Boxd>(fcl::Vector3d(2 * b.half_extents)), b.center, motion);
}
FclBody fcl_body(const TurnedBox& b, const Vec3<double>& motion) {
  return fcl_body(std::make_shared<fcl::Boxd>(fcl::Vector3d(2 * b.half_extents)), b.center, motion, b.axes);
}
FclBody fcl_body(const Pill& c, const Vec3<double>& motion) {
  const Vec3<double> along = c.b - c.a;
  const Mat3<double> turn = Eigen::Quaterniond::FromTwoVectors(Vec3<double>::UnitZ(), along).toRotationMatrix();
  return fcl_body(std::make_shared<fcl::Capsuled>(c.radius, std::sqrt(along.squaredNorm())), center(c), motion, turn);
}

struct FclPair {
  FclBody a, b;
};

double fcl_cast(const FclPair& q, fcl::CCDSolverType solver) {
  fcl::ContinuousCollisionRequestd request;
  request.ccd_solver_type = solver;
  fcl::ContinuousCollisionResultd result;
  fcl::continuousCollide(q.a.shape.get(), q.a.from, q.a.to, q.b.shape.get(), q.b.from, q.b.to, request, result);
  return result.is_collide ? result.time_of_contact : never;
}

double fcl_contact(const FclPair& q, bool wants_contact) {
  fcl::CollisionRequestd request;
  request.enable_contact = wants_contact;
  request.num_max_contacts = wants_contact ? 4 : 1;
  fcl::CollisionResultd result;
  fcl::collide(q.a.shape.get(), q.a.from, q.b.shape.get(), q.b.from, request, result);
  if (!result.isCollision()) return never;
  if (!wants_contact) return -1;
  double depth = 0;
  for (std::size_t i = 0; i < result.numContacts(); ++i)
    depth = std::max(depth, std::abs(result.getContact(i).penetration_depth));
  return depth;
}

}  // namespace

bool add_fcl() {
  for_each_cast([](const std::string& pair, auto set, const Operations& least) {
    const auto prepare = [](const auto& q) {
      return FclPair{fcl_body(q.a.shape, q.a.displacement), fcl_body(q.b.shape, q.b.displacement)};
    };
    add_row("time_of_impact/" + pair + "/fcl_conservative_advancement", set, least, prepare,
            [](const FclPair& q) { return fcl_cast(q, fcl::CCDC_CONSERVATIVE_ADVANCEMENT); });
    add_row("time_of_impact/" + pair + "/fcl_default", set, least, prepare,
            [](const FclPair& q) { return fcl_cast(q, fcl::CCDC_NAIVE); });
  });
  for_each_pose([](const std::string& pair, auto set) {
    const auto prepare = [](const auto& q) {
      return FclPair{fcl_body(q.a, Vec3<double>::Zero()), fcl_body(q.b, Vec3<double>::Zero())};
    };
    add_row("contact/" + pair + "/fcl", set, {}, prepare, [](const FclPair& q) { return fcl_contact(q, true); });
    add_row("overlaps/" + pair + "/fcl", set, {}, prepare, [](const FclPair& q) { return fcl_contact(q, false); });
  });
  return true;
}

}  // namespace thinwall::bench

#endif
