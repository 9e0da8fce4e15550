#include <cstdio>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/swept/time_of_impact.hpp>

/// A ball crosses a wall thinner than its step: in front at the start, behind at the end, hit on the way.
int main() {
  using namespace thinwall;
  const Moving ball{Sphere<double>{{-5, 0, 0}, 0.5}, {10, 0, 0}};
  const auto wall = at_rest(Aabb<double>{{0, 0, 0}, {0.5, 4, 4}});
  const auto toi = time_of_impact(ball, wall);
  std::printf("hit at %g of the step\n", toi.time);
  return toi.status == ToiStatus::hit && toi.time == 0.4 ? 0 : 1;
}
