#pragma once
/// Turns the fuzzer's bytes into numbers: as they are, or into the values that go wrong: small integers, powers of two,
/// neighbors one unit in the last place away, values that have come before, their sums and opposites, zeros.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include <thinwall/discrete/scalar.hpp>

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
  Vec3<S> vector() {
    const S x = (*this)();
    const S y = (*this)();
    const S z = (*this)();
    return {x, y, z};
  }
  Vec3<S> sizes() {
    const S x = size();
    const S y = size();
    const S z = size();
    return {x, y, z};
  }
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

}  // namespace thinwall::fuzz
