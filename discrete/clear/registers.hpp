#pragma once
/// Registers of two and of four numbers, and what the machine does to them; plain numbers where it has none.
///
/// They are GCC's and Clang's own vectors, which add and multiply as they are. What is bit by bit is asked by instruction: of an expression
/// GCC makes that of whole numbers, which waits to be passed on, with constants that take four instructions each. -march=native with
/// AVX-512 may turn masks into others all the same.

#include <bit>
#include <cmath>
#include <cstdint>

#include <thinwall/discrete/scalar.hpp>

#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace thinwall::packed {

using Two [[gnu::vector_size(16)]] = double;
using Four [[gnu::vector_size(32)]] = double;

#ifdef __AVX__
#define THINWALL_OF_REGISTERS(name, two, four)                                          \
  THINWALL_HOT Two name(const Two& x, const Two& y) { return std::bit_cast<Two>(two); } \
  THINWALL_HOT Four name(const Four& x, const Four& y) { return std::bit_cast<Four>(four); }
#elif defined(__SSE2__)
#define THINWALL_OF_REGISTERS(name, two, four) \
  THINWALL_HOT Two name(const Two& x, const Two& y) { return two; }
#endif
#ifdef __SSE2__
// The second, where one of the two is not a number.
THINWALL_OF_REGISTERS(least, _mm_min_pd(x, y), _mm256_min_pd(x, y))
THINWALL_OF_REGISTERS(most, _mm_max_pd(x, y), _mm256_max_pd(x, y))
// False, where one of the two is not a number.
THINWALL_OF_REGISTERS(below, _mm_cmplt_pd(x, y), _mm256_cmp_pd(x, y, _CMP_LT_OS))
THINWALL_OF_REGISTERS(at_most, _mm_cmple_pd(x, y), _mm256_cmp_pd(x, y, _CMP_LE_OS))
// Bit by bit.
THINWALL_OF_REGISTERS(bits_of_both, _mm_and_pd(x, y), _mm256_and_pd(x, y))
THINWALL_OF_REGISTERS(bits_of_either, _mm_or_pd(x, y), _mm256_or_pd(x, y))
THINWALL_OF_REGISTERS(bits_of_one, _mm_xor_pd(x, y), _mm256_xor_pd(x, y))
THINWALL_OF_REGISTERS(bits_without, _mm_andnot_pd(y, x), _mm256_andnot_pd(y, x))
#if defined(__AVX512DQ__) && defined(__AVX512VL__)
THINWALL_OF_REGISTERS(held_within, _mm_range_pd(x, y, 2), _mm256_range_pd(x, y, 2))  // as below, in one instruction
#endif
#undef THINWALL_OF_REGISTERS
#else
using Bits [[gnu::vector_size(16)]] = std::int64_t;
THINWALL_HOT Bits whole(const Two& x) { return std::bit_cast<Bits>(x); }
THINWALL_HOT Two least(const Two& x, const Two& y) { return x < y ? x : y; }
THINWALL_HOT Two most(const Two& x, const Two& y) { return x > y ? x : y; }
THINWALL_HOT Two below(const Two& x, const Two& y) { return std::bit_cast<Two>(x < y); }
THINWALL_HOT Two at_most(const Two& x, const Two& y) { return std::bit_cast<Two>(x <= y); }
THINWALL_HOT Two bits_of_both(const Two& x, const Two& y) { return std::bit_cast<Two>(whole(x) & whole(y)); }
THINWALL_HOT Two bits_of_either(const Two& x, const Two& y) { return std::bit_cast<Two>(whole(x) | whole(y)); }
THINWALL_HOT Two bits_of_one(const Two& x, const Two& y) { return std::bit_cast<Two>(whole(x) ^ whole(y)); }
THINWALL_HOT Two bits_without(const Two& x, const Two& y) { return std::bit_cast<Two>(whole(x) & ~whole(y)); }
#endif

THINWALL_HOT Two chosen(const Two& which, const Two& yes, const Two& no) {
#ifdef __AVX__
  return _mm_blendv_pd(no, yes, which);
#else
  return bits_of_either(bits_of_both(which, yes), bits_without(no, which));
#endif
}
#ifdef __AVX__
THINWALL_HOT Four chosen(const Four& which, const Four& yes, const Four& no) {
  return _mm256_blendv_pd(no, yes, which);
}
#endif

// std::sqrt jumps, for the sake of errno.
#ifdef __SSE2__
THINWALL_HOT Two root_of(const Two& x) { return _mm_sqrt_pd(x); }
#ifdef __AVX__
THINWALL_HOT Four root_of(const Four& x) { return _mm256_sqrt_pd(x); }
#endif
#else
THINWALL_HOT Two root_of(const Two& x) { return Two{std::sqrt(x[0]), std::sqrt(x[1])}; }
#endif

#if !defined(__AVX512DQ__) || !defined(__AVX512VL__)
/// x, no farther from 0 than h >= 0. Of h = 0, zero, of a sign that may differ.
template <class Register> THINWALL_HOT Register held_within(const Register& x, const Register& h) {
  return most(-h, least(x, h));
}
#endif

/// -0, a sign alone, in every lane of such a register.
template <class Register> THINWALL_HOT Register minus_zero(const Register&) { return -Register{}; }

}  // namespace thinwall::packed
