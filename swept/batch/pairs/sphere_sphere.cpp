// Two spheres, for every width of vector: this file is compiled once a target.

#include <thinwall/swept/batch/run.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <thinwall/swept/batch/pairs/sphere_sphere.cpp>
#include <hwy/foreach_target.h>

#include <thinwall/swept/batch/ball_lanes.inl>
#include <thinwall/swept/batch/driver.inl>
#include <thinwall/swept/batch/kernel.inl>

HWY_BEFORE_NAMESPACE();
namespace thinwall::batch::HWY_NAMESPACE {
THINWALL_BATCH_TARGET(sphere_sphere, SphereSphere)
}  // namespace thinwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thinwall::batch {
THINWALL_BATCH_RUN_OF(sphere_sphere, double, Moving<Sphere<double>>, Moving<Sphere<double>>)
THINWALL_BATCH_RUN_OF(sphere_sphere, float, Moving<Sphere<float>>, Moving<Sphere<float>>)
}  // namespace thinwall::batch
#endif
