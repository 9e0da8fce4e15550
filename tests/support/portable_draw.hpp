#pragma once
/// The same random numbers by every compiler, which the distributions of the standard library do not promise.

#include <cmath>
#include <cstdint>
#include <random>

#include <thinwall/discrete/scalar.hpp>

namespace thinwall::testing {

class PortableDraw {
 public:
  explicit PortableDraw(std::uint64_t seed) : engine_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
  bool one_in(int n) { return below(n) == 0; }
  Vec3<double> vector(double low, double high) { return {between(low, high), between(low, high), between(low, high)}; }
  Vec3<double> direction() {
    Vec3<double> v;
    do {
      v = vector(-1, 1);
    } while (v.squaredNorm() > 1 || v.squaredNorm() < 0.01);
    return v / std::sqrt(v.squaredNorm());
  }
  Vec3<double> point(double size) {
    const Vec3<double> way = direction();
    return way * between(0, size);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace thinwall::testing
