#pragma once
/// What a verdict is held against, and at which precision.

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <thinwall/experiments/accuracy/draw.hpp>
#include <thinwall/experiments/accuracy/oracle.hpp>

namespace thinwall {

using Digits50 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

inline bool agree(ToiStatus status, oracle::Verdict verdict) {
  switch (status) {
    case ToiStatus::apart: return verdict == oracle::Verdict::apart;
    case ToiStatus::hit: return verdict == oracle::Verdict::hit;
    case ToiStatus::overlapping: return verdict == oracle::Verdict::overlapping;
    default: return false;
  }
}

}  // namespace thinwall
