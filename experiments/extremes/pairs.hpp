#pragma once
/// The pairs of shapes and the precisions they are asked in. A precision is a source file: in_float.cpp and so on.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/extremes/axes.hpp>
#include <thinwall/experiments/extremes/tally.hpp>

namespace thinwall {

struct ExtremeInquiry {
  Place place{};
  std::int64_t queries = 0;
  std::uint64_t seed = 0;
  std::vector<std::string> methods{};  ///< that are asked for
  double tolerance = 1;                ///< [epsilon]
};

using AskExtreme = std::vector<ExtremeTally> (*)(const ExtremeInquiry& inquiry);

/// A precision, its name in the settings and its round-off.
struct Precision {
  std::string_view name, title;
  double unit;           ///< [1] u
  bool is_wide = false;  ///< in software
};
inline constexpr std::size_t precision_count = 4;
const std::array<Precision, precision_count>& all_precisions();

struct ExtremePair {
  std::string_view name;
  bool rounded;                                 ///< at least one shape has a radius
  bool every_method;                            ///< or the closed form alone, in float and double
  bool has_box;                                 ///< that can be thin
  std::array<AskExtreme, precision_count> ask;  ///< null: not in that precision
};
std::span<const ExtremePair> extreme_pairs();

/// Of the four pairs that every method is asked: sphere_sphere, sphere_aabb, sphere_capsule, obb_obb.
std::array<AskExtreme, 4> ask_in_float();
std::array<AskExtreme, 4> ask_in_double();
std::array<AskExtreme, 4> ask_in_long_double();
std::array<AskExtreme, 4> ask_at_50_digits();

/// Every method that is asked anywhere, the foil first.
std::vector<std::string_view> extreme_method_names();

}  // namespace thinwall
