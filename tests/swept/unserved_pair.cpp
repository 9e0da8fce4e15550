// Compiled by tests/house/unserved_pair.cmake: a box and a triangle, a pair that is not served. Asked about one by one
// (ONE_BY_ONE), in groups (GROUPED) or for a proof (CERTIFIED) it must not compile, and the error must name the pair.

#include <thinwall/swept/dispatch.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>
#ifdef CERTIFIED
#include <thinwall/swept/certified.hpp>
#endif

using namespace thinwall;

using Wall = std::variant<Aabb<double>, Triangle<double>>;
using Body = std::variant<std::monostate, Sphere<double>, Obb<double>>;

#ifdef ONE_BY_ONE
bool ask(const Moving<Body>& a, const Moving<Wall>& b);
bool ask(const Moving<Body>& a, const Moving<Wall>& b) { return time_of_impact(a, b).time < 1; }
#endif

#ifdef GROUPED
std::vector<bool> ask(const std::vector<Body>& a, const std::vector<Wall>& b, const std::vector<IndexPair>& pairs);
std::vector<bool> ask(const std::vector<Body>& a, const std::vector<Wall>& b, const std::vector<IndexPair>& pairs) {
  return answers(group_pairs(a, b, pairs), a, b, pairs, false,
                 [](const auto& x, const auto& y) { return overlaps(x, y); });
}
#endif

#ifdef CERTIFIED
bool ask(const Moving<Obb<double>>& a, const Moving<Triangle<double>>& b);
bool ask(const Moving<Obb<double>>& a, const Moving<Triangle<double>>& b) {
  return certified_time_of_impact(a, b).verdict == ToiStatus::hit;
}
#endif

// A box along the axes that turns: the error must say what to write instead.
#ifdef TURNING
double ask(const Turning<Aabb<double>>& a, const Moving<Sphere<double>>& b);
double ask(const Turning<Aabb<double>>& a, const Moving<Sphere<double>>& b) { return time_of_impact(a, b).time; }
#endif
