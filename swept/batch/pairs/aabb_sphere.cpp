// A box along the axes and a sphere, for every width of vector: this file is compiled once a target.

#include <thinwall/swept/batch/run.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <thinwall/swept/batch/pairs/aabb_sphere.cpp>
#include <hwy/foreach_target.h>

#include <thinwall/swept/batch/driver.inl>
#include <thinwall/swept/batch/kernel.inl>
#include <thinwall/swept/batch/rounded_box_lanes.inl>

HWY_BEFORE_NAMESPACE();
namespace thinwall::batch::HWY_NAMESPACE {
THINWALL_BATCH_TARGET(aabb_sphere, AabbSphere)
}  // namespace thinwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thinwall::batch {
THINWALL_BATCH_RUN_OF(aabb_sphere, double, Moving<Aabb<double>>, Moving<Sphere<double>>)
THINWALL_BATCH_RUN_OF(aabb_sphere, float, Moving<Aabb<float>>, Moving<Sphere<float>>)
}  // namespace thinwall::batch
#endif
