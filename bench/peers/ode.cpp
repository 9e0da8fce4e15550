/// ODE: its rays and its contacts (it has no cast). Without it this is empty.

#include "peers/peer.hpp"

#ifndef THINWALL_HAS_ODE

bool thinwall::bench::add_ode() { return false; }

#else

#include <ode/ode.h>

namespace thinwall::bench {

namespace {

/// A dGeom and its owner.
struct OdeGeom {
  dGeomID id = nullptr;
  explicit OdeGeom(dGeomID geom) : id(geom) {}
  OdeGeom(OdeGeom&& other) noexcept : id(std::exchange(other.id, nullptr)) {}
  OdeGeom(const OdeGeom&) = delete;
  OdeGeom& operator=(const OdeGeom&) = delete;
  OdeGeom& operator=(OdeGeom&&) = delete;
  ~OdeGeom() {
    if (id != nullptr) dGeomDestroy(id);
  }
};

OdeGeom placed(dGeomID geom, const Vec3<double>& at) {
  dGeomSetPosition(geom, dReal(at.x()), dReal(at.y()), dReal(at.z()));
  return OdeGeom(geom);
}

OdeGeom ode_geom(const Ball& s) { return placed(dCreateSphere(nullptr, dReal(s.radius)), s.center); }
OdeGeom ode_geom(const Box& b) {
  const Vec3<double> sides = 2 * b.half_extents;
  return placed(dCreateBox(nullptr, dReal(sides.x()), dReal(sides.y()), dReal(sides.z())), b.center);
}
OdeGeom ode_geom(const TurnedBox& b) {
  OdeGeom geom = ode_geom(Box{b.center, b.half_extents});
  dMatrix3 turn{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) turn[4 * row + column] = dReal(b.axes(row, column));
  }
  dGeomSetRotation(geom.id, turn);
  return geom;
}
OdeGeom ode_geom(const Pill& c) {
  const Vec3<double> along = c.b - c.a;
  OdeGeom geom = placed(dCreateCapsule(nullptr, dReal(c.radius), dReal(std::sqrt(along.squaredNorm()))), center(c));
  dMatrix3 turn{};
  dRFromZAxis(turn, dReal(along.x()), dReal(along.y()), dReal(along.z()));
  dGeomSetRotation(geom.id, turn);
  return geom;
}

struct OdePair {
  OdeGeom a, b;
};
struct OdeRay {
  OdeGeom ray, shape;
  double length;
};

}  // namespace

bool add_ode() {
  static const bool started = dInitODE2(0) != 0;
  for_each_ray([](const std::string& shape, auto set, const Operations& least) {
    add_row(
        "raycast/" + shape + "/ode", set, least,
        [](const auto& q) {
          const double length = unit_length(q);
          const Vec3<double>&o = q.ray.origin, &d = q.ray.direction;
          OdeRay made{OdeGeom(dCreateRay(nullptr, dReal(length))), ode_geom(q.shape), length};
          dGeomRaySet(made.ray.id, dReal(o.x()), dReal(o.y()), dReal(o.z()), dReal(d.x()), dReal(d.y()), dReal(d.z()));
          return made;
        },
        [](const OdeRay& q) {
          dContactGeom hit;
          const int count = dCollide(q.ray.id, q.shape.id, 1, &hit, sizeof hit);
          return count > 0 ? double(hit.depth) / q.length : never;
        });
  });
  for_each_pose([](const std::string& pair, auto set) {
    add_row(
        "contact/" + pair + "/ode", set, {},
        [](const auto& q) {
          return OdePair{ode_geom(q.a), ode_geom(q.b)};
        },
        [](const OdePair& q) {
          std::array<dContactGeom, 4> found;
          const int count = dCollide(q.a.id, q.b.id, 4, found.data(), sizeof found[0]);
          double depth = count > 0 ? 0 : never;
          for (int i = 0; i < count; ++i) depth = std::max(depth, double(found[static_cast<std::size_t>(i)].depth));
          return depth;
        });
  });
  return started;
}

}  // namespace thinwall::bench

#endif
