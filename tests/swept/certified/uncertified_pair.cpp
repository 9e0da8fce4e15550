// Compiled by tests/house/uncertified_pair.cmake: a box and a triangle cannot be certified, and the error must name both.
// With SERVED a sphere takes the box's place.

#include <thinwall/swept/certified.hpp>

using namespace thinwall;

#ifdef SERVED
using Body = Sphere<double>;
#else
using Body = Obb<double>;
#endif

bool ask(const Moving<Body>& a, const Moving<Triangle<double>>& b);
bool ask(const Moving<Body>& a, const Moving<Triangle<double>>& b) {
  return certified_time_of_impact(a, b).verdict == ToiStatus::hit;
}
