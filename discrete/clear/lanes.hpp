#pragma once
/// Numbers side by side in registers: what the clear rung computes with. Lanes are the three of a vector, a Pair is two scalars, or
/// one twice.
///
/// A vector that is written number by number and read in pairs waits for the store, and a jump that is a coin's toss costs more
/// than a square root. So what is computed stays in registers from load to store, and answers are selected by masks. The registers
/// are GCC's and Clang's own vectors: for Lanes one of four numbers where the machine has them (the fourth is of no meaning), else
/// two of two; and plain numbers where there are none. The bits are the same everywhere: every sum has one order, (x + y) + z.

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <thinwall/discrete/scalar.hpp>

#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace thinwall::packed {

template <class Number, int count> struct Register {
  using Type [[gnu::vector_size(count * sizeof(Number))]] = Number;
};
using Two = Register<double, 2>::Type;
using Four = Register<double, 4>::Type;

template <class Number> struct PairOf {
  typename Register<Number, 2>::Type v;
};
#ifdef __AVX__
template <class Number> struct LanesOf {
  typename Register<Number, 4>::Type v;
};
#else
template <class Number> struct LanesOf {
  typename Register<Number, 2>::Type xy, zz;
};
#endif
using Bits = std::int64_t;
using Pair = PairOf<double>;
using Lanes = LanesOf<double>;
using PairMask = PairOf<Bits>;  ///< of a lane all bits, or none
using LanesMask = LanesOf<Bits>;

// ---- Lane by lane: f of the registers of x.

template <class To, class F, class... Given> THINWALL_HOT PairOf<To> each(const F& f, const PairOf<Given>&... x) {
  return {f(x.v...)};
}
template <class To, class F, class... Given> THINWALL_HOT LanesOf<To> each(const F& f, const LanesOf<Given>&... x) {
#ifdef __AVX__
  return {f(x.v...)};
#else
  return {f(x.xy...), f(x.zz...)};
#endif
}

#ifdef __SSE2__  // beside a constant GCC would compare and mask
THINWALL_HOT Two least(const Two& x, const Two& y) { return _mm_min_pd(x, y); }
THINWALL_HOT Two most(const Two& x, const Two& y) { return _mm_max_pd(x, y); }
#ifdef __AVX__
THINWALL_HOT Four least(const Four& x, const Four& y) { return _mm256_min_pd(x, y); }
THINWALL_HOT Four most(const Four& x, const Four& y) { return _mm256_max_pd(x, y); }
#endif
#else
THINWALL_HOT Two least(const Two& x, const Two& y) { return x < y ? x : y; }
THINWALL_HOT Two most(const Two& x, const Two& y) { return x > y ? x : y; }
#endif

#define THINWALL_LANE_BY_LANE(name, To, From, expression)                                                       \
  template <template <class> class Pack> THINWALL_HOT Pack<To> name(const Pack<From>& a, const Pack<From>& b) { \
    return each<To>([](const auto& x, const auto& y) { return expression; }, a, b);                             \
  }
// clang-format off
THINWALL_LANE_BY_LANE(operator+, double, double, x + y)
THINWALL_LANE_BY_LANE(operator-, double, double, x - y)
THINWALL_LANE_BY_LANE(operator*, double, double, x * y)
THINWALL_LANE_BY_LANE(operator/, double, double, x / y)
// The second, where one of the two is not a number.
THINWALL_LANE_BY_LANE(min, double, double, least(x, y))
THINWALL_LANE_BY_LANE(max, double, double, most(x, y))
// False, where one of the two is not a number.
THINWALL_LANE_BY_LANE(operator<, Bits, double, x < y)
THINWALL_LANE_BY_LANE(operator<=, Bits, double, x <= y)
THINWALL_LANE_BY_LANE(operator&, Bits, Bits, x & y)
THINWALL_LANE_BY_LANE(operator|, Bits, Bits, x | y)
// clang-format on
#undef THINWALL_LANE_BY_LANE

/// The bits of a register of numbers, and the numbers of its bits.
template <class Numbers> THINWALL_HOT auto bits_of(const Numbers& x) {
  return std::bit_cast<typename Register<Bits, sizeof(x) / sizeof(double)>::Type>(x);
}
template <class All> THINWALL_HOT auto numbers_of(const All& x) {
  return std::bit_cast<typename Register<double, sizeof(x) / sizeof(double)>::Type>(x);
}
inline constexpr Bits sign_bit = std::numeric_limits<Bits>::min();

template <template <class> class Pack> THINWALL_HOT Pack<double> abs(const Pack<double>& a) {
  return each<double>([](const auto& x) { return numbers_of(bits_of(x) & ~sign_bit); }, a);
}
/// a as it is where s is downwards: a where s is negative, -0 included, else -a.
template <template <class> class Pack> THINWALL_HOT Pack<double> against(const Pack<double>& a, const Pack<double>& s) {
  return each<double>([](const auto& x, const auto& y) { return numbers_of(bits_of(x) ^ (~bits_of(y) & sign_bit)); }, a,
                      s);
}
/// yes where `which`, else no.
template <template <class> class Pack>
THINWALL_HOT Pack<double> select(const Pack<Bits>& which, const Pack<double>& yes, const Pack<double>& no) {
  return each<double>(
      [](const auto& m, const auto& x, const auto& y) { return numbers_of((m & bits_of(x)) | (~m & bits_of(y))); },
      which, yes, no);
}
/// a where `which`, else 0.
template <template <class> class Pack> THINWALL_HOT Pack<double> keep(const Pack<Bits>& which, const Pack<double>& a) {
  return each<double>([](const auto& m, const auto& x) { return numbers_of(m & bits_of(x)); }, which, a);
}

// ---- Across lanes.

THINWALL_HOT Pair both(double x) { return {Two{x, x}}; }
THINWALL_HOT Pair firsts(const Pair& a) { return {__builtin_shufflevector(a.v, a.v, 0, 0)}; }
THINWALL_HOT Pair seconds(const Pair& a) { return {__builtin_shufflevector(a.v, a.v, 1, 1)}; }
THINWALL_HOT Pair firsts(const Pair& a, const Pair& b) { return {__builtin_shufflevector(a.v, b.v, 0, 2)}; }
THINWALL_HOT Pair seconds(const Pair& a, const Pair& b) { return {__builtin_shufflevector(a.v, b.v, 1, 3)}; }
THINWALL_HOT double value(const Pair& a) { return a.v[0]; }

#ifdef __AVX__
THINWALL_HOT Lanes all(double x) { return {Four{x, x, x, x}}; }
THINWALL_HOT Lanes lanes(const Pair& xy, const Pair& zz) {
  return std::bit_cast<Lanes>(_mm256_set_m128d(std::bit_cast<__m128d>(zz), std::bit_cast<__m128d>(xy)));
}
THINWALL_HOT Lanes lanes(const double* x) {
  return std::bit_cast<Lanes>(_mm256_blend_pd(_mm256_broadcast_sd(x + 2), _mm256_castpd128_pd256(_mm_loadu_pd(x)), 3));
}
THINWALL_HOT constexpr LanesMask lanes(Bits x, Bits y, Bits z) {
  return {typename Register<Bits, 4>::Type{x, y, z, z}};
}
THINWALL_HOT LanesMask all(const PairMask& m) { return {__builtin_shufflevector(m.v, m.v, 0, 0, 0, 0)}; }
THINWALL_HOT Pair xy_of(const Lanes& a) { return {__builtin_shufflevector(a.v, a.v, 0, 1)}; }
THINWALL_HOT Pair zz_of(const Lanes& a) {
  return std::bit_cast<Pair>(_mm256_extractf128_pd(std::bit_cast<__m256d>(a), 1));
}
THINWALL_HOT Lanes yzx(const Lanes& a) { return {__builtin_shufflevector(a.v, a.v, 1, 2, 0, 0)}; }
#else
THINWALL_HOT Lanes all(double x) { return {Two{x, x}, Two{x, x}}; }
THINWALL_HOT Lanes lanes(const Pair& xy, const Pair& zz) { return {xy.v, zz.v}; }
THINWALL_HOT Lanes lanes(const double* x) {
  Lanes a{{}, Two{x[2], x[2]}};
  std::memcpy(&a.xy, x, sizeof a.xy);
  return a;
}
THINWALL_HOT constexpr LanesMask lanes(Bits x, Bits y, Bits z) {
  return {typename Register<Bits, 2>::Type{x, y}, typename Register<Bits, 2>::Type{z, z}};
}
THINWALL_HOT LanesMask all(const PairMask& m) { return {m.v, m.v}; }  ///< of one mask twice
THINWALL_HOT Pair xy_of(const Lanes& a) { return {a.xy}; }
THINWALL_HOT Pair zz_of(const Lanes& a) { return {a.zz}; }
THINWALL_HOT Lanes yzx(const Lanes& a) {
  return {__builtin_shufflevector(a.xy, a.zz, 1, 2), __builtin_shufflevector(a.xy, a.xy, 0, 0)};
}
#endif

THINWALL_HOT Lanes lanes(const Vec3<double>& v) { return lanes(v.data()); }
THINWALL_HOT Lanes all(const Pair& x) { return all(value(x)); }  ///< of a number twice
THINWALL_HOT void store(const Lanes& a, Vec3<double>& to) {
  const Pair xy = xy_of(a);
  std::memcpy(to.data(), &xy, sizeof xy);
  to[2] = value(zz_of(a));
}

/// Which lanes, as bits from 0.
THINWALL_HOT unsigned bits(const PairMask& m) {
#ifdef __SSE2__
  return static_cast<unsigned>(_mm_movemask_pd(std::bit_cast<__m128d>(m)));
#else
  return (m.v[0] & 1U) | (m.v[1] & 2U);
#endif
}
THINWALL_HOT unsigned bits(const LanesMask& m) {
#ifdef __AVX__
  return static_cast<unsigned>(_mm256_movemask_pd(std::bit_cast<__m256d>(m))) & 7U;
#else
  return bits(PairMask{m.xy}) | (bits(PairMask{m.zz}) & 1U) << 2U;
#endif
}
THINWALL_HOT bool all_of(const PairMask& m) { return bits(m) == 3U; }
THINWALL_HOT bool all_of(const LanesMask& m) { return bits(m) == 7U; }
THINWALL_HOT bool any_of(const LanesMask& m) { return bits(m) != 0U; }
/// Both, without a jump.
THINWALL_HOT bool both(bool a, bool b) { return (static_cast<unsigned>(a) & static_cast<unsigned>(b)) != 0U; }

THINWALL_HOT Pair root(const Pair& a) {
#ifdef __SSE2__
  return std::bit_cast<Pair>(_mm_sqrt_pd(std::bit_cast<__m128d>(a)));  // std::sqrt jumps, for the sake of errno
#else
  return {Two{std::sqrt(a.v[0]), std::sqrt(a.v[1])}};
#endif
}

/// The sum of a, and that of b.
THINWALL_HOT Pair two_sums(const Lanes& a, const Lanes& b) {
  return (firsts(xy_of(a), xy_of(b)) + seconds(xy_of(a), xy_of(b))) + firsts(zz_of(a), zz_of(b));
}
THINWALL_HOT Pair sum(const Lanes& a) { return two_sums(a, a); }
THINWALL_HOT Pair dot(const Lanes& a, const Lanes& b) { return sum(a * b); }
THINWALL_HOT Lanes cross(const Lanes& a, const Lanes& b) { return yzx(a * yzx(b) - yzx(a) * b); }
THINWALL_HOT Lanes unit(const Lanes& a) { return a / all(root(dot(a, a))); }
THINWALL_HOT Pair largest_of(const Lanes& a) { return max(firsts(max(xy_of(a), zz_of(a))), seconds(xy_of(a))); }
THINWALL_HOT Pair smallest_of(const Lanes& a) { return min(firsts(min(xy_of(a), zz_of(a))), seconds(xy_of(a))); }

/// All bits of the lane of the lowest bit set.
THINWALL_HOT LanesMask lowest(unsigned which) {
  static constexpr LanesMask x = lanes(-1, 0, 0), y = lanes(0, -1, 0), none = lanes(0, 0, 0);
  static constexpr LanesMask first[8] = {none, x, y, x, lanes(0, 0, -1), x, y, x};
  return first[which];
}

}  // namespace thinwall::packed
