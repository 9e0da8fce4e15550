#pragma once
/// Sorts the boxes along one axis and sweeps along it.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <thinwall/discrete/broad_phase/proxy.hpp>

namespace thinwall {

/// Each body is held against those that begin before it ends. At constant density in space that is a slab of the
/// world: time grows as n^(5/3) (docs/broad_phase.md). Quick for worlds that are long and thin.
/// Source: Cohen, Lin, Manocha and Ponamgi, I-COLLIDE, 1995, one axis of three.
struct SortAndSweep {
  static constexpr std::string_view name = "sort_and_sweep";
  struct Memory;
};

namespace sweep {

/// Along the swept axis, and the other two.
struct Box {
  double low, high;
  std::array<double, 2> side_low, side_high;
  std::uint32_t id;
  bool is_static;
};

/// The axis on which the fewest of up to 64 x 63 / 2 pairs overlap, taken at even distances in the list.
inline int best_axis(std::span<const Proxy> proxies) {
  constexpr std::size_t most = 64;
  const std::size_t stride = (proxies.size() + most - 1) / most;
  std::array<int, 3> overlaps{};
  for (std::size_t i = 0; i < proxies.size(); i += stride) {
    for (std::size_t j = i + stride; j < proxies.size(); j += stride) {
      const Proxy &a = proxies[i], &b = proxies[j];
      for (int k = 0; k < 3 && !a.skipped && !b.skipped; ++k) {
        if (a.low[k] <= b.high[k] && b.low[k] <= a.high[k]) ++overlaps[static_cast<std::size_t>(k)];
      }
    }
  }
  return static_cast<int>(std::min_element(overlaps.begin(), overlaps.end()) - overlaps.begin());
}

}  // namespace sweep

struct SortAndSweep::Memory {
  PairMemory pairs;
  std::vector<sweep::Box> boxes;
  std::size_t bytes() const { return pairs.bytes() + bytes_of(boxes); }
};

inline void find_pairs(const SortAndSweep&, std::span<const Proxy> proxies, std::vector<ProxyPair>& pairs,
                       std::size_t max_pairs, SortAndSweep::Memory& m) {
  pairs.clear();
  require_valid(proxies);
  PairSink sink(proxies, max_pairs, m.pairs);
  const int axis = sweep::best_axis(proxies), u = (axis + 1) % 3, v = (axis + 2) % 3;
  m.boxes.clear();
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    const Proxy& p = proxies[i];
    if (p.skipped) continue;
    m.boxes.push_back({p.low[axis],
                       p.high[axis],
                       {p.low[u], p.low[v]},
                       {p.high[u], p.high[v]},
                       static_cast<std::uint32_t>(i),
                       p.is_static});
  }
  std::sort(m.boxes.begin(), m.boxes.end(), [](const sweep::Box& a, const sweep::Box& b) { return a.low < b.low; });
  const sweep::Box* const end = m.boxes.data() + m.boxes.size();
  for (const sweep::Box* a = m.boxes.data(); a != end; ++a) {
    for (const sweep::Box* b = a + 1; b != end && b->low <= a->high; ++b) {
      if (a->side_low[0] > b->side_high[0] || b->side_low[0] > a->side_high[0]) continue;
      if (a->side_low[1] > b->side_high[1] || b->side_low[1] > a->side_high[1]) continue;
      if (!a->is_static || !b->is_static) sink.add(a->id, b->id);
    }
  }
  sink.finish(pairs);
}

}  // namespace thinwall
