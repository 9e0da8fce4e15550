#pragma once
/// Counter-based random numbers: a trial's numbers depend on its key and counter alone, never on which thread drew them
/// or what was drawn before. The generator is Philox4x64-10 of Random123; the transform to a real number is ours,
/// because those of the standard library differ from one implementation to the next.

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include <Random123/philox.h>

namespace thinwall {

/// The key: every pair is a stream of its own.
struct RandomStream {
  std::uint64_t seed;    ///< of the run
  std::uint64_t stream;  ///< of the cell; see `stream_of`
};

using RandomWords = std::array<std::uint64_t, 4>;

/// Four independent words, uniform over all of their values.
inline RandomWords random_words(const RandomStream& key, std::uint64_t trial, std::uint64_t draw) {
  const auto words = r123::Philox4x64()({{trial, draw, 0, 0}}, {{key.seed, key.stream}});
  return {words[0], words[1], words[2], words[3]};
}

/// A number in [0, 1): one of the 2^53 multiples of 2^-53, each as likely as any other.
inline double uniform(std::uint64_t word) { return static_cast<double>(word >> 11) * 0x1p-53; }

/// A stream for a cell, from its physical factors alone: methods that share a cell share its shots, and a cell keeps
/// its shots when others come or go. Source: the 64-bit FNV-1a hash, over the bytes of the numbers, lowest first.
inline std::uint64_t stream_of(std::span<const double> factors) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const double factor : factors) {
    const auto bits = std::bit_cast<std::uint64_t>(factor + 0.0);  // + 0.0: -0 and 0 are one factor
    for (unsigned shift = 0; shift < 64; shift += 8) hash = (hash ^ ((bits >> shift) & 0xff)) * 0x100000001b3;
  }
  return hash;
}

}  // namespace thinwall
