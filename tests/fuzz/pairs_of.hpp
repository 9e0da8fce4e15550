#pragma once
/// One input of the fuzzer: a pair with `A` as the shape of later rank, at A's scalar.

#include "fuzz/numbers.hpp"

namespace thinwall::fuzz {

/// Defined in pairs_of.cpp, which is compiled once for each shape and scalar.
template <class A> void check_one_pair_of(Bytes& bytes);

}  // namespace thinwall::fuzz
