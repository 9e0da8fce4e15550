#include <cstdio>

#include <thinwall/swept/certified.hpp>

/// A ball that grazes a wall's edge exactly: whether it touches is proven, not guessed.
int main() {
  using namespace thinwall;
  const Moving ball{Sphere<double>{{-10, 4, 5}, 5}, {20, 0, 0}};
  const auto wall = at_rest(Aabb<double>{{0, 0, 0}, {1, 1, 1}});
  const CertifiedToi toi = certified_time_of_impact(ball, wall);
  std::printf("hit between %.17g and %.17g of the step\n", toi.lower, toi.upper);
  return toi.verdict == ToiStatus::hit && toi.lower < 0.45 && toi.upper >= 0.45 ? 0 : 1;
}
