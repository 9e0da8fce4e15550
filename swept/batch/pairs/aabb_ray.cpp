// Rays at boxes along the axes, for every width of vector: this file is compiled once a target.

#include <thinwall/swept/batch/run.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <thinwall/swept/batch/pairs/aabb_ray.cpp>
#include <hwy/foreach_target.h>

#include <thinwall/swept/batch/box_lanes.inl>
#include <thinwall/swept/batch/driver.inl>
#include <thinwall/swept/batch/kernel.inl>

HWY_BEFORE_NAMESPACE();
namespace thinwall::batch::HWY_NAMESPACE {
THINWALL_BATCH_TARGET(aabb_ray, AabbRay)
}  // namespace thinwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thinwall::batch {
THINWALL_BATCH_RUN_OF(aabb_ray, double, Aabb<double>, Ray<double>)
THINWALL_BATCH_RUN_OF(aabb_ray, float, Aabb<float>, Ray<float>)
}  // namespace thinwall::batch
#endif
