// Two spheres, proven, for every width of vector: this file is compiled once a target.

#include <thinwall/swept/batch/run.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <thinwall/swept/batch/certified_spheres.cpp>
#include <hwy/foreach_target.h>

#include <thinwall/swept/batch/certified_ball_lanes.inl>
#include <thinwall/swept/batch/driver.inl>

HWY_BEFORE_NAMESPACE();
namespace thinwall::batch::HWY_NAMESPACE {
HWY_ATTR std::size_t certified_spheres(const Rows<double>& a, const Rows<double>& b, std::size_t n,
                                       const Answers<double>& out) {
  return run_target<CertifiedSphereSphere>(a, b, n, out);
}
}  // namespace thinwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thinwall::batch {
HWY_EXPORT(certified_spheres);
std::size_t run_certified_spheres(const Rows<double>& a, const Rows<double>& b, std::size_t n,
                                  const Answers<double>& out) {
  return HWY_DYNAMIC_DISPATCH(certified_spheres)(a, b, n, out);
}
}  // namespace thinwall::batch
#endif
