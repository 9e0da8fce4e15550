/// libccd: GJK with EPA, and MPR, on support functions of our own. It has no cast. Without it this is empty.

#include "peers/peer.hpp"

#ifndef THINWALL_HAS_CCD

bool thinwall::bench::add_libccd() { return false; }

#else

#include <ccd/ccd.h>

namespace thinwall::bench {

namespace {

/// A box with a rounding around it: any of our shapes.
struct CcdShape {
  Vec3<double> center, half;
  Mat3<double> axes;
  double radius;
};

CcdShape ccd_shape(const Ball& s) { return {s.center, Vec3<double>::Zero(), Mat3<double>::Identity(), s.radius}; }
CcdShape ccd_shape(const Box& b) { return {b.center, b.half_extents, Mat3<double>::Identity(), 0}; }
CcdShape ccd_shape(const TurnedBox& b) { return {b.center, b.half_extents, b.axes, 0}; }
CcdShape ccd_shape(const Pill& c) {
  const Vec3<double> half = (c.b - c.a) / 2;
  Mat3<double> axes = Mat3<double>::Zero();
  axes.col(0) = half;  // not a unit: half an extent of 1 along it
  return {center(c), Vec3<double>::UnitX(), axes, c.radius};
}

void ccd_support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* farthest) {
  const CcdShape& shape = *static_cast<const CcdShape*>(object);
  const Vec3<double> d(direction->v[0], direction->v[1], direction->v[2]);
  Vec3<double> point = shape.center;
  for (int k = 0; k < 3; ++k) {
    const double half = shape.half[k];
    point += shape.axes.col(k) * (d.dot(shape.axes.col(k)) < 0 ? -half : half);
  }
  if (shape.radius > 0) point += d * (shape.radius / std::sqrt(d.squaredNorm()));
  ccdVec3Set(farthest, point.x(), point.y(), point.z());
}
void ccd_center(const void* object, ccd_vec3_t* middle) {
  const Vec3<double>& c = static_cast<const CcdShape*>(object)->center;
  ccdVec3Set(middle, c.x(), c.y(), c.z());
}

/// As its own documentation sets it up.
ccd_t ccd_settings() {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = &ccd_support;
  ccd.center1 = ccd.center2 = &ccd_center;
  ccd.max_iterations = 100;
  ccd.epa_tolerance = 1e-4;
  ccd.mpr_tolerance = 1e-4;
  return ccd;
}

struct CcdPair {
  CcdShape a, b;
};

using CcdDepth = int (*)(const void*, const void*, const ccd_t*, ccd_real_t*, ccd_vec3_t*, ccd_vec3_t*);
using CcdVerdict = int (*)(const void*, const void*, const ccd_t*);

}  // namespace

bool add_libccd() {
  for_each_pose([](const std::string& pair, auto set) {
    const auto prepare = [](const auto& q) { return CcdPair{ccd_shape(q.a), ccd_shape(q.b)}; };
    const auto contact_row = [&](const char* name, CcdDepth ask) {
      add_row("contact/" + pair + "/" + name, set, {}, prepare, [ask, ccd = ccd_settings()](const CcdPair& q) {
        ccd_real_t depth = 0;
        ccd_vec3_t direction, position;
        return ask(&q.a, &q.b, &ccd, &depth, &direction, &position) == 0 ? double(depth) : never;
      });
    };
    const auto overlap_row = [&](const char* name, CcdVerdict ask) {
      add_row("overlaps/" + pair + "/" + name, set, {}, prepare,
              [ask, ccd = ccd_settings()](const CcdPair& q) { return depth_of(ask(&q.a, &q.b, &ccd) != 0); });
    };
    contact_row("libccd_gjk", &ccdGJKPenetration);
    contact_row("libccd_mpr", &ccdMPRPenetration);
    overlap_row("libccd_gjk", &ccdGJKIntersect);
    overlap_row("libccd_mpr", &ccdMPRIntersect);
  });
  return true;
}

}  // namespace thinwall::bench

#endif
