#pragma once
/// Looks at every pair: the baseline, and what the others are tested against.

#include <string_view>

#include <thinwall/discrete/broad_phase/proxy.hpp>

namespace thinwall {

/// The half loop: each pair once, n (n - 1) / 2 looks.
struct AllPairs {
  static constexpr std::string_view name = "all_pairs";
  struct Memory {
    static std::size_t bytes() { return 0; }
  };
};

/// The full loop: each pair from both sides, n^2 looks, one side kept. The half loop's foil.
struct AllOrderedPairs {
  static constexpr std::string_view name = "all_ordered_pairs";
  using Memory = AllPairs::Memory;
};

inline void look_at_all(std::span<const Proxy> proxies, std::vector<ProxyPair>& pairs, std::size_t max_pairs,
                        bool from_both_sides) {
  pairs.clear();
  require_valid(proxies);
  const auto count = static_cast<std::uint32_t>(proxies.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t j = from_both_sides ? 0 : i + 1; j < count; ++j) {
      if (!boxes_touch(proxies[i], proxies[j]) || j <= i || !may_meet(proxies[i], proxies[j])) continue;
      if (pairs.size() == max_pairs) {
        pairs.clear();
        throw TooManyPairs(max_pairs);
      }
      pairs.push_back({i, j});
    }
  }
}

inline void find_pairs(const AllPairs&, std::span<const Proxy> proxies, std::vector<ProxyPair>& pairs,
                       std::size_t max_pairs, AllPairs::Memory&) {
  look_at_all(proxies, pairs, max_pairs, false);
}
inline void find_pairs(const AllOrderedPairs&, std::span<const Proxy> proxies, std::vector<ProxyPair>& pairs,
                       std::size_t max_pairs, AllOrderedPairs::Memory&) {
  look_at_all(proxies, pairs, max_pairs, true);
}

}  // namespace thinwall
