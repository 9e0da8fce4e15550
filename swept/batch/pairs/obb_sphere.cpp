// A turned box and a sphere, for every width of vector: this file is compiled once a target.

#include <thinwall/swept/batch/run.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <thinwall/swept/batch/pairs/obb_sphere.cpp>
#include <hwy/foreach_target.h>

#include <thinwall/swept/batch/driver.inl>
#include <thinwall/swept/batch/kernel.inl>
#include <thinwall/swept/batch/rounded_box_lanes.inl>

HWY_BEFORE_NAMESPACE();
namespace thinwall::batch::HWY_NAMESPACE {
THINWALL_BATCH_TARGET(obb_sphere, ObbSphere)
}  // namespace thinwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thinwall::batch {
THINWALL_BATCH_RUN_OF(obb_sphere, double, Moving<Obb<double>>, Moving<Sphere<double>>)
THINWALL_BATCH_RUN_OF(obb_sphere, float, Moving<Obb<float>>, Moving<Sphere<float>>)
}  // namespace thinwall::batch
#endif
