#pragma once
/// Numbers side by side in registers: what the clear rung computes with. Lanes are the three of a vector, a Pair is two scalars, or
/// one twice.
///
/// A vector that is written number by number and read in pairs waits for the store, and a jump that is a coin's toss costs more
/// than a square root. So what is computed stays in registers (registers.hpp) from load to store, and answers are selected by masks.
/// Lanes are one register of four numbers where the machine has them, else two of two; the fourth repeats the third. The bits are the
/// same everywhere: every sum has one order, (x + y) + z.

#include <bit>
#include <cstdint>
#include <cstring>

#include <thinwall/discrete/clear/registers.hpp>
#include <thinwall/discrete/scalar.hpp>

namespace thinwall::packed {

/// Of `double`, numbers; of `bool`, masks: of a lane all bits, or none.
template <class Kind> struct PairOf {
  Two v;
};
#ifdef __AVX__
template <class Kind> struct LanesOf {
  Four v;
};
#else
template <class Kind> struct LanesOf {
  Two xy, zz;
};
#endif
using Pair = PairOf<double>;
using Lanes = LanesOf<double>;
using PairMask = PairOf<bool>;
using LanesMask = LanesOf<bool>;

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
THINWALL_LANE_BY_LANE(held_within, double, double, held_within(x, y))
// False, where one of the two is not a number.
THINWALL_LANE_BY_LANE(operator<, bool, double, below(x, y))
THINWALL_LANE_BY_LANE(operator<=, bool, double, at_most(x, y))
THINWALL_LANE_BY_LANE(operator&, bool, bool, bits_of_both(x, y))
THINWALL_LANE_BY_LANE(operator|, bool, bool, bits_of_either(x, y))
// clang-format on
#undef THINWALL_LANE_BY_LANE

template <template <class> class Pack> THINWALL_HOT Pack<double> abs(const Pack<double>& a) {
  return each<double>([](const auto& x) { return bits_without(x, minus_zero(x)); }, a);
}
/// a as it is where s is downwards: a where s is negative, -0 included, else -a.
template <template <class> class Pack> THINWALL_HOT Pack<double> against(const Pack<double>& a, const Pack<double>& s) {
  return each<double>([](const auto& x, const auto& y) { return bits_of_one(x, bits_without(minus_zero(y), y)); }, a,
                      s);
}
/// yes where `which`, else no.
template <template <class> class Pack>
THINWALL_HOT Pack<double> select(const Pack<bool>& which, const Pack<double>& yes, const Pack<double>& no) {
  return each<double>([](const auto& m, const auto& x, const auto& y) { return chosen(m, x, y); }, which, yes, no);
}
/// a where `which`, else 0.
template <template <class> class Pack> THINWALL_HOT Pack<double> keep(const Pack<bool>& which, const Pack<double>& a) {
  return each<double>([](const auto& m, const auto& x) { return bits_of_both(m, x); }, which, a);
}

// ---- Across lanes.

THINWALL_HOT Pair both(double x) { return {Two{x, x}}; }
THINWALL_HOT Pair pair(double x, double y) { return {Two{x, y}}; }
THINWALL_HOT Pair firsts(const Pair& a) { return {__builtin_shufflevector(a.v, a.v, 0, 0)}; }
THINWALL_HOT Pair seconds(const Pair& a) { return {__builtin_shufflevector(a.v, a.v, 1, 1)}; }
THINWALL_HOT Pair swapped(const Pair& a) { return {__builtin_shufflevector(a.v, a.v, 1, 0)}; }
THINWALL_HOT Pair firsts(const Pair& a, const Pair& b) { return {__builtin_shufflevector(a.v, b.v, 0, 2)}; }
THINWALL_HOT Pair seconds(const Pair& a, const Pair& b) { return {__builtin_shufflevector(a.v, b.v, 1, 3)}; }
THINWALL_HOT double value(const Pair& a) { return a.v[0]; }

/// All bits, or none.
THINWALL_HOT constexpr double all_bits(bool yes) { return std::bit_cast<double>(-std::int64_t{yes}); }

#ifdef __AVX__
THINWALL_HOT Lanes all(double x) { return {Four{x, x, x, x}}; }
THINWALL_HOT Lanes lanes(const Pair& xy, const Pair& zz) {
  return std::bit_cast<Lanes>(_mm256_set_m128d(std::bit_cast<__m128d>(zz), std::bit_cast<__m128d>(xy)));
}
THINWALL_HOT Lanes lanes(const double* x) {
  return {_mm256_insertf128_pd(_mm256_broadcast_sd(x + 2), _mm_loadu_pd(x), 0)};  // two loads, and nothing else
}
THINWALL_HOT constexpr LanesMask mask(bool x, bool y, bool z, bool fourth) {
  return {Four{all_bits(x), all_bits(y), all_bits(z), all_bits(fourth)}};
}
/// Of what is there twice.
template <class Kind> THINWALL_HOT LanesOf<Kind> all(const PairOf<Kind>& x) {
#ifdef __AVX2__
  return {_mm256_broadcastsd_pd(x.v)};
#else
  return {Four{x.v[0], x.v[0], x.v[0], x.v[0]}};
#endif
}
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
THINWALL_HOT constexpr LanesMask mask(bool x, bool y, bool z, bool fourth) {
  return {Two{all_bits(x), all_bits(y)}, Two{all_bits(z), all_bits(fourth)}};
}
template <class Kind> THINWALL_HOT LanesOf<Kind> all(const PairOf<Kind>& x) { return {x.v, x.v}; }
THINWALL_HOT Pair xy_of(const Lanes& a) { return {a.xy}; }
THINWALL_HOT Pair zz_of(const Lanes& a) { return {a.zz}; }
THINWALL_HOT Lanes yzx(const Lanes& a) {
  return {__builtin_shufflevector(a.xy, a.zz, 1, 2), __builtin_shufflevector(a.xy, a.xy, 0, 0)};
}
#endif

THINWALL_HOT constexpr LanesMask mask(bool x, bool y, bool z) { return mask(x, y, z, z); }
THINWALL_HOT Lanes lanes(const Vec3<double>& v) { return lanes(v.data()); }
THINWALL_HOT void store(const Lanes& a, double* to) {
  const Pair xy = xy_of(a);
  std::memcpy(to, &xy, sizeof xy);
  to[2] = value(zz_of(a));
}
THINWALL_HOT void store(const Lanes& a, Vec3<double>& to) { store(a, to.data()); }

/// Which lanes, as bits from 0.
THINWALL_HOT unsigned bits(const PairMask& m) {
#ifdef __SSE2__
  return static_cast<unsigned>(_mm_movemask_pd(std::bit_cast<__m128d>(m)));
#else
  return (whole(m.v)[0] & 1U) | (whole(m.v)[1] & 2U);
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
/// 1 if such bits are of one lane alone, else 0.
THINWALL_HOT unsigned is_one_axis(unsigned axes) { return 0x16U >> axes & 1U; }
/// Both, and either, without a jump.
THINWALL_HOT bool both(bool a, bool b) { return (static_cast<unsigned>(a) & static_cast<unsigned>(b)) != 0U; }
THINWALL_HOT bool either(bool a, bool b) { return (static_cast<unsigned>(a) | static_cast<unsigned>(b)) != 0U; }

template <template <class> class Pack> THINWALL_HOT Pack<double> root(const Pack<double>& a) {
  return each<double>([](const auto& x) { return root_of(x); }, a);
}

/// The sum of a, and that of b.
THINWALL_HOT Pair two_sums(const Lanes& a, const Lanes& b) {
#ifdef __AVX__
  const Lanes x_and_z{__builtin_shufflevector(a.v, b.v, 0, 4, 2, 6)};
#else
  const Lanes x_and_z{firsts(xy_of(a), xy_of(b)).v, firsts(zz_of(a), zz_of(b)).v};
#endif
  return (xy_of(x_and_z) + seconds(xy_of(a), xy_of(b))) + zz_of(x_and_z);
}
THINWALL_HOT Pair sum(const Lanes& a) { return (xy_of(a) + swapped(xy_of(a))) + zz_of(a); }
THINWALL_HOT Pair dot(const Lanes& a, const Lanes& b) { return sum(a * b); }
/// a x b in the order z, x, y: the dot product of two vectors so turned is that of the vectors.
THINWALL_HOT Lanes turned_cross(const Lanes& a, const Lanes& b) { return a * yzx(b) - yzx(a) * b; }
THINWALL_HOT Lanes cross(const Lanes& a, const Lanes& b) { return yzx(turned_cross(a, b)); }
THINWALL_HOT Lanes unit(const Lanes& a) { return a / all(root(dot(a, a))); }
/// Of a length L near 1, and its square: unit but for 3/2 (L - 1)^2. Newton's step, which takes no root.
THINWALL_HOT Lanes nearer_unit(const Lanes& a, const Pair& square) { return a * all(both(1.5) - square * both(0.5)); }
THINWALL_HOT Lanes nearer_unit(const Lanes& a) { return nearer_unit(a, dot(a, a)); }
THINWALL_HOT Pair largest_of(const Lanes& a) {
  const Pair with_z = max(xy_of(a), zz_of(a));
  return max(with_z, swapped(with_z));
}
THINWALL_HOT Pair smallest_of(const Lanes& a) {
  const Pair with_z = min(xy_of(a), zz_of(a));
  return min(with_z, swapped(with_z));
}

/// All bits of the lane of the lowest bit set.
THINWALL_HOT LanesMask lowest(unsigned which) {
  static constexpr LanesMask x = mask(true, false, false), y = mask(false, true, false), z = mask(false, false, true);
  static constexpr LanesMask first[8] = {mask(false, false, false), x, y, x, z, x, y, x};
  return first[which];
}

/// Which lanes, of four numbers of which the last is its own.
THINWALL_HOT unsigned four_bits(const LanesMask& m) {
#ifdef __AVX__
  return static_cast<unsigned>(_mm256_movemask_pd(std::bit_cast<__m256d>(m)));
#else
  return bits(PairMask{m.xy}) | bits(PairMask{m.zz}) << 2U;
#endif
}
/// Of those the lowest, or none.
THINWALL_HOT LanesMask lowest_of_four(const LanesMask& m) {
  static constexpr LanesMask none = mask(false, false, false, false), x = mask(true, false, false, false),
                             y = mask(false, true, false, false), z = mask(false, false, true, false),
                             w = mask(false, false, false, true);
  static constexpr LanesMask first[16] = {none, x, y, x, z, x, y, x, w, x, y, x, z, x, y, x};
  return first[four_bits(m)];
}

}  // namespace thinwall::packed
