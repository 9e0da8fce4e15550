#pragma once
/// Turns the fuzzer's bytes into two moving shapes, as they come or moved until they all but touch. Numbers are the bytes as they are, or
/// the values that go wrong: small integers, powers of two, neighbors one unit in the last place away, values that have come before,
/// their sums and opposites, zeros.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include <thinwall/swept/shapes.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "support/numbers_of.hpp"

namespace thinwall::fuzz {

/// The input, byte by byte. Where it ends a stream goes on that all of it seeds (FNV-1a, then SplitMix64), so that the
/// shortest input is a whole scene.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {
    for (std::size_t i = 0; i < size; ++i) state_ = (state_ ^ data[i]) * 0x100000001b3;
  }

  std::uint8_t operator()() {
    if (next_ < size_) return data_[next_++];
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return static_cast<std::uint8_t>(z >> 56);
  }
  int below(int count) { return (*this)() % count; }
  int between(int low, int high) { return low + below(high - low + 1); }

 private:
  const std::uint8_t* data_;
  std::size_t size_, next_ = 0;
  std::uint64_t state_ = 0xcbf29ce484222325;
};

/// How the bytes are read.
enum class Reading {
  raw,     ///< as the bits of the number
  nasty,   ///< as a finite value made to be difficult
  unruly,  ///< the same, with infinities, NaN and the ends of the range among them
};

template <Scalar S> class Numbers {
 public:
  Numbers(Bytes& bytes, Reading reading) : bytes_(bytes), reading_(reading) {}

  S operator()() {
    const S x = reading_ == Reading::raw ? raw() : nasty();
    earlier_[count_++ % earlier_.size()] = x;
    return x;
  }
  /// A size, so seldom negative.
  S size() {
    using std::abs;
    const S x = (*this)();
    return reading_ != Reading::nasty && bytes_.below(16) == 0 ? x : S(abs(x));
  }
  Vec3<S> vector() { return {(*this)(), (*this)(), (*this)()}; }
  Vec3<S> sizes() { return {size(), size(), size()}; }
  int below(int count) { return bytes_.below(count); }
  Reading reading() const { return reading_; }

 private:
  S raw() {
    std::array<std::uint8_t, sizeof(S)> bits{};
    for (std::uint8_t& byte : bits) byte = bytes_();
    S x = 0;
    std::memcpy(&x, bits.data(), sizeof x);
    return x;
  }
  S earlier() { return count_ == 0 ? S(1) : earlier_[bytes_() % std::min(count_, earlier_.size())]; }
  S small() { return S(bytes_.between(-8, 8)); }
  S end_of_range() {
    using Limits = std::numeric_limits<S>;
    constexpr std::array<S, 8> ends{Limits::infinity(), -Limits::infinity(),  Limits::quiet_NaN(), Limits::max(),
                                    -Limits::max(),     Limits::denorm_min(), Limits::min(),       Limits::epsilon()};
    return ends[bytes_() % ends.size()];
  }
  S nasty() {
    using std::ldexp;
    using std::nextafter;
    const S infinity = std::numeric_limits<S>::infinity();
    switch (bytes_.below(16)) {
      case 0:
      case 1: return small();
      case 2: return small() / 2;
      case 3: return S(bytes_.between(-100, 100)) / 10;
      case 4: return ldexp(S(bytes_.below(2) == 0 ? 1 : -1), bytes_.between(-60, 60));
      case 5: return ldexp(small(), bytes_.between(-8, 8));
      case 6: return bytes_.below(4) == 0 ? -S(0) : S(0);
      case 7: return earlier();
      case 8: return -earlier();
      case 9: return nextafter(earlier(), bytes_.below(2) == 0 ? infinity : -infinity);
      case 10: {
        const S x = earlier();
        return x + earlier();
      }
      case 11: {
        const S x = earlier();
        return x - earlier();
      }
      case 12: return earlier() * small() / 2;
      case 13: return S(bytes_.between(-127, 127)) / 128 + S(bytes_()) / 32768 + S(bytes_()) / 8388608;
      case 14: return small() + ldexp(S(1), -bytes_.between(1, std::numeric_limits<S>::digits));
      default: return reading_ == Reading::unruly ? end_of_range() : small() * S(0.1);
    }
  }

  Bytes& bytes_;
  Reading reading_;
  std::array<S, 32> earlier_{};
  std::size_t count_ = 0;
};

// ---- Shapes.

/// Fits the rotation of the quaternion (w, x, y, z); the identity if that has no length.
inline Mat3<double> rotation(double w, double x, double y, double z) {
  const double s = w * w + x * x + y * y + z * z;
  if (!(s > 0) || !is_finite(1 / s) || !is_finite(s)) return Mat3<double>::Identity();
  Mat3<double> m;
  m << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),   //
      2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z;
  return m / s;
}

/// Axes: upright, turned by right angles, next to upright, by 3-4-5, or anyhow.
template <Scalar S> Mat3<S> draw_axes(Numbers<S>& numbers) {
  const int kind = numbers.below(numbers.reading() == Reading::nasty ? 5 : 6);
  const auto small = [&] { return static_cast<double>(numbers.below(9) - 4); };
  Mat3<S> axes = Mat3<S>::Identity();
  if (kind == 1) {
    const int first = numbers.below(3), signs = numbers.below(8);
    axes.setZero();
    for (int i = 0; i < 3; ++i) axes((first + i) % 3, i) = (signs >> i & 1) != 0 ? S(-1) : S(1);
  } else if (kind == 2) {
    const double tilt = std::ldexp(1.0, -1 - numbers.below(60));
    axes = rotation(1, numbers.below(2) == 0 ? tilt : 0, 0, tilt).template cast<S>();
  } else if (kind == 3) {
    const int axis = numbers.below(3), i = (axis + 1) % 3, j = (axis + 2) % 3;
    axes(i, i) = axes(j, j) = S(3) / S(5);
    axes(j, i) = S(4) / S(5);
    axes(i, j) = -axes(j, i);
  } else if (kind == 4) {
    const double w = small(), x = small(), y = small(), z = small();
    axes = rotation(w, x, y, z).template cast<S>();
  } else if (kind == 5) {
    for (int i = 0; i < 3; ++i) axes.col(i) = numbers.vector();
  }
  return axes;
}

template <Scalar S> Sphere<S> drawn(Numbers<S>& numbers, TypeTag<Sphere<S>>) {
  return {numbers.vector(), numbers.size()};
}
template <Scalar S> Aabb<S> drawn(Numbers<S>& numbers, TypeTag<Aabb<S>>) { return {numbers.vector(), numbers.sizes()}; }
template <Scalar S> Obb<S> drawn(Numbers<S>& numbers, TypeTag<Obb<S>>) {
  return {numbers.vector(), numbers.sizes(), draw_axes(numbers)};
}
template <Scalar S> Triangle<S> drawn(Numbers<S>& numbers, TypeTag<Triangle<S>>) {
  return {numbers.vector(), numbers.vector(), numbers.vector()};
}
template <Scalar S> Capsule<S> drawn(Numbers<S>& numbers, TypeTag<Capsule<S>>) {
  return {numbers.vector(), numbers.vector(), numbers.size()};
}

template <class A, class B> struct Scene {
  using S = typename A::Scalar;
  Moving<A> a;
  Moving<B> b;

  bool is_valid() const { return valid(a) && valid(b); }
  S size() const { return magnitude(a) + magnitude(b); }
};

/// When the two are nearest, about: the separation is convex in time.
template <class A, class B> typename A::Scalar nearest_time(const Moving<A>& a, const Moving<B>& b) {
  using S = typename A::Scalar;
  S low = 0, high = 1;
  const Vec3<S> path = relative_displacement(a, b);
  for (int i = 0; i < 2 * std::numeric_limits<S>::digits && low < high; ++i) {
    const S middle = (low + high) / 2;
    const Separation<S> there = separation(pose_at(a, middle), pose_at(b, middle));
    (there.normal.dot(path) > 0 ? low : high) = middle;
  }
  return low;
}

/// Moves B along the normal until the two all but touch at `time`.
template <class A, class B> void bring_together(Scene<A, B>& scene, const typename A::Scalar& time) {
  using S = typename A::Scalar;
  const Separation<S> there = separation(pose_at(scene.a, time), pose_at(scene.b, time));
  const Vec3<S> by = there.normal * -there.distance;
  if (is_finite(by)) scene.b.shape = moved(scene.b.shape, by);
}

template <class A, class B> Scene<A, B> draw_scene(Numbers<typename A::Scalar>& numbers) {
  using S = typename A::Scalar;
  Scene<A, B> scene{at_rest(drawn(numbers, TypeTag<A>{})), at_rest(drawn(numbers, TypeTag<B>{}))};
  const int motion = numbers.below(4);
  if (motion != 0) scene.a.displacement = numbers.vector();
  if (motion > 1) scene.b.displacement = numbers.vector();
  const int together = numbers.below(8);
  if (!scene.is_valid() || !is_ordinary(scene.size())) return scene;
  if (together == 1) scene.a.displacement = scene.b.displacement + (center(scene.b.shape) - center(scene.a.shape));
  if (together == 2) bring_together(scene, S(0));
  if (together == 3) bring_together(scene, S(1));
  if (together == 4) bring_together(scene, nearest_time(scene.a, scene.b));
  return scene;
}

// ---- Are the numbers of a scene of like enough size for 50 digits to judge it, or for no product of them to leave the range?

/// The exponents of all numbers but zeros lie within `most` of 0.
template <class Thing> bool is_moderate(const Thing& thing, int most) {
  bool moderate = true;
  for_each_number(thing,
                  [&](const auto& x) { moderate = moderate && (x == 0 || std::abs(binary_exponent(x)) <= most); });
  return moderate;
}
template <class A, class B> bool is_moderate(const Scene<A, B>& scene, int most) {
  return is_moderate(scene.a, most) && is_moderate(scene.b, most);
}

/// The oracle at 50 digits, 168 bits, adds up squares: numbers 2^60 apart leave it the digits it needs.
template <class A, class B> bool is_judged(const Scene<A, B>& scene) {
  return scene.is_valid() && is_moderate(scene, 60);
}

}  // namespace thinwall::fuzz
