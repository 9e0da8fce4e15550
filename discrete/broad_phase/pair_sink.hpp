#pragma once
/// Takes pairs in any order, leaves out those that may not meet, and gives them back sorted.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <thinwall/discrete/broad_phase/proxy.hpp>

namespace thinwall {

/// Working memory of PairSink.
struct PairMemory {
  std::vector<ProxyPair> found;       ///< as they came
  std::vector<std::uint32_t> starts;  ///< where the partners of each first body begin
  std::vector<std::uint32_t> seconds;
  std::size_t bytes() const { return bytes_of(found) + bytes_of(starts) + bytes_of(seconds); }
};

/// Pairs of boxes that touch go in through `add`; `finish` sorts them by counting, in time linear in bodies and pairs
/// where no body has many partners.
class PairSink {
 public:
  PairSink(std::span<const Proxy> proxies, std::size_t max_pairs, PairMemory& memory)
      : proxies_(proxies), max_pairs_(max_pairs), memory_(memory) {
    memory_.found.clear();
    std::uint32_t groups = 0;
    std::uint32_t common_mask = ~std::uint32_t{0};
    for (const Proxy& p : proxies) {
      if (p.skipped) continue;
      groups |= p.group;
      common_mask &= p.mask;
      has_static_ = has_static_ || p.is_static;
      has_groupless_ = has_groupless_ || p.group == 0;
    }
    all_may_meet_ = !has_static_ && !has_groupless_ && (groups & ~common_mask) == 0;
  }

  /// Takes a pair that differs from those before and whose boxes touch. Neither body is skipped.
  void add(std::uint32_t a, std::uint32_t b) {
    if (!all_may_meet_ && !may_meet(proxies_[a], proxies_[b])) return;
    if (memory_.found.size() == max_pairs_) throw TooManyPairs(max_pairs_);
    memory_.found.push_back({std::min(a, b), std::max(a, b)});
  }

  /// Writes the pairs in order.
  void finish(std::vector<ProxyPair>& pairs) {
    const std::size_t count = memory_.found.size();
    if (count > std::numeric_limits<std::uint32_t>::max()) {  // beyond what the counts can hold
      pairs = memory_.found;
      std::sort(pairs.begin(), pairs.end());
      return;
    }
    std::vector<std::uint32_t>& starts = memory_.starts;
    starts.assign(proxies_.size() + 1, 0);
    for (const ProxyPair& p : memory_.found) ++starts[p.first + 1];
    for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
    memory_.seconds.resize(count);
    for (const ProxyPair& p : memory_.found) memory_.seconds[starts[p.first]++] = p.second;
    pairs.resize(count);
    std::uint32_t begin = 0;
    for (std::uint32_t first = 0; first < proxies_.size(); ++first) {  // starts[first] is now where first's list ends
      const std::uint32_t end = starts[first];
      sort_few(memory_.seconds.data() + begin, memory_.seconds.data() + end);
      for (std::uint32_t k = begin; k < end; ++k) pairs[k] = {first, memory_.seconds[k]};
      begin = end;
    }
  }

 private:
  /// Most bodies have a handful of partners, for which insertion is quicker than std::sort.
  static void sort_few(std::uint32_t* begin, std::uint32_t* end) {
    if (end - begin > 24) return std::sort(begin, end);
    for (std::uint32_t* i = begin; i < end; ++i) {
      const std::uint32_t value = *i;
      std::uint32_t* hole = i;
      for (; hole > begin && hole[-1] > value; --hole) *hole = hole[-1];
      *hole = value;
    }
  }

  std::span<const Proxy> proxies_;
  std::size_t max_pairs_;
  PairMemory& memory_;
  bool has_static_ = false;
  bool has_groupless_ = false;
  bool all_may_meet_ = false;
};

}  // namespace thinwall
