// Compiled by tests/house/uncertified_pair.cmake: a box and a triangle cannot be certified, and the error must name both.

#include <thinwall/swept/certified.hpp>

using namespace thinwall;

bool ask(const Moving<Obb<double>>& a, const Moving<Triangle<double>>& b);
bool ask(const Moving<Obb<double>>& a, const Moving<Triangle<double>>& b) {
  return certified_time_of_impact(a, b).verdict == ToiStatus::hit;
}
