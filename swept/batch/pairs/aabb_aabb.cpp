// Two boxes along the axes, for every width of vector: this file is compiled once a target.

#include <thinwall/swept/batch/run.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <thinwall/swept/batch/pairs/aabb_aabb.cpp>
#include <hwy/foreach_target.h>

#include <thinwall/swept/batch/box_lanes.inl>
#include <thinwall/swept/batch/driver.inl>
#include <thinwall/swept/batch/kernel.inl>

HWY_BEFORE_NAMESPACE();
namespace thinwall::batch::HWY_NAMESPACE {
THINWALL_BATCH_TARGET(aabb_aabb, AabbAabb)
}  // namespace thinwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thinwall::batch {
THINWALL_BATCH_RUN_OF(aabb_aabb, double, Moving<Aabb<double>>, Moving<Aabb<double>>)
THINWALL_BATCH_RUN_OF(aabb_aabb, float, Moving<Aabb<float>>, Moving<Aabb<float>>)
}  // namespace thinwall::batch
#endif
