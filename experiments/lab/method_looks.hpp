#pragma once
/// A method's own look, in every figure of every report and on the page.

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace thinwall {

/// Color and open mark, the filled one for its float. No two share both.
struct MethodLook {
  std::string_view name;
  const char* color;       ///< #rrggbb
  int point_type, filled;  ///< gnuplot's numbers
};
inline constexpr std::array method_looks = {
    MethodLook{"end_of_step", "#D55E00", 4, 5},        MethodLook{"substeps", "#E69F00", 8, 9},
    MethodLook{"centre_ray", "#CC79A7", 12, 13},       MethodLook{"swept_volume_ray", "#56B4E9", 10, 11},
    MethodLook{"sweep_then_confirm", "#CC79A7", 2, 2}, MethodLook{"linear_sweep", "#CC79A7", 6, 7},
    MethodLook{"speculative", "#009E73", 8, 9},        MethodLook{"conservative_advancement", "#009E73", 12, 13},
    MethodLook{"bisection", "#E69F00", 1, 1},          MethodLook{"inclusion", "#56B4E9", 4, 5},
    MethodLook{"closed_form", "#0072B2", 6, 7},
};

/// The mark of the k-th of substeps_2, substeps_8, ... where several are drawn: in one color.
inline int substeps_mark(std::size_t k) {
  constexpr std::array in_turn = {8, 10, 3, 9, 11};
  return in_turn[k % in_turn.size()];
}

/// Of `closed_form`, `closed_form float` or `substeps_16`; of a label that is no method's, nothing.
inline const MethodLook* look_of(std::string_view label) {
  const std::string_view word = label.substr(0, label.find(' '));
  const auto is_its = [&](const MethodLook& look) {
    if (!word.starts_with(look.name)) return false;
    const std::string_view rest = word.substr(look.name.size());
    return rest.empty() || (rest[0] == '_' && rest.find_first_not_of("_0123456789") == std::string_view::npos);
  };
  const auto found = std::ranges::find_if(method_looks, is_its);
  return found == method_looks.end() ? nullptr : &*found;
}

}  // namespace thinwall
