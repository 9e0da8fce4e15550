#pragma once
/// What a broad phase knows of a body, and the pairs it finds.
/// A pair is two bodies of which at least one can move, whose groups may meet, and whose boxes share a point.

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <thinwall/discrete/scalar.hpp>

namespace thinwall {

/// The box that holds a body during the step, whom it may meet, and whether it can move.
struct Proxy {
  Vec3<double> low = Vec3<double>::Zero();   ///< [length] least corner of the closed box, already rounded outward
  Vec3<double> high = Vec3<double>::Zero();  ///< [length] greatest corner, >= low; both may be infinite
  std::uint32_t group = 1;                   ///< bits the body belongs to
  std::uint32_t mask = ~std::uint32_t{0};    ///< bits it may meet; a pair needs both directions
  bool is_static = false;                    ///< two static bodies are never a pair
  bool skipped = false;                      ///< without a shape or a physics part: meets nobody, its box is not read
};

/// Two bodies by their index in the list of proxies; first < second.
struct ProxyPair {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  friend bool operator==(const ProxyPair&, const ProxyPair&) = default;
  friend auto operator<=>(const ProxyPair&, const ProxyPair&) = default;  // NOLINT(modernize-use-nullptr): false alarm
};

/// More pairs than the caller allows. The list of pairs is left empty.
struct TooManyPairs : std::runtime_error {
  explicit TooManyPairs(std::size_t limit)
      : std::runtime_error("more than " + std::to_string(limit) +
                           " pairs of bodies may touch: allow more pairs, or part bodies that lie on one another"),
        max_pairs(limit) {}
  std::size_t max_pairs;  ///< what was allowed
};

/// A proxy whose box is NaN or inside out.
struct InvalidProxy : std::invalid_argument {
  InvalidProxy(std::size_t which, const std::string& what)
      : std::invalid_argument("proxy " + std::to_string(which) + ": " + what), index(which) {}
  std::size_t index;  ///< of the first such proxy
};

inline constexpr std::size_t no_pair_limit = std::numeric_limits<std::size_t>::max();

/// True if the closed boxes share a point: touching counts.
inline bool boxes_touch(const Proxy& a, const Proxy& b) {
  return a.low[0] <= b.high[0] && b.low[0] <= a.high[0] &&  //
         a.low[1] <= b.high[1] && b.low[1] <= a.high[1] &&  //
         a.low[2] <= b.high[2] && b.low[2] <= a.high[2];
}

/// True unless both are static, either is skipped, or one's mask leaves out the other's group.
inline bool may_meet(const Proxy& a, const Proxy& b) {
  return !(a.is_static && b.is_static) && !a.skipped && !b.skipped && (a.group & b.mask) != 0 &&
         (b.group & a.mask) != 0;
}

/// Throws InvalidProxy for the first proxy that is not skipped and whose box is NaN or has low > high; throws
/// std::length_error for more proxies than an index can name.
inline void require_valid(std::span<const Proxy> proxies) {
  if (proxies.size() > std::numeric_limits<std::uint32_t>::max()) throw std::length_error("more than 2^32 - 1 proxies");
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    const Proxy& p = proxies[i];
    if (p.skipped || (p.low[0] <= p.high[0] && p.low[1] <= p.high[1] && p.low[2] <= p.high[2])) continue;
    const bool is_nan = p.low.hasNaN() || p.high.hasNaN();
    throw InvalidProxy(i, is_nan ? "its box is not a number" : "its box has low > high");
  }
}

/// [bytes] that a list holds, used or not.
template <class T> std::size_t bytes_of(const std::vector<T>& list) { return list.capacity() * sizeof(T); }

/// Finds every pair, sorted by (first, second), into `pairs`, whose old content goes. The same pairs from each method.
/// `Method::Memory` is working memory that a caller who steps a world may keep from call to call; it changes no answer, and says how much
/// it is: `memory.bytes()`.
/// Errors: InvalidProxy; TooManyPairs as soon as more than max_pairs are found, with memory bounded by that number.
template <class Method>
void find_pairs(const Method& method, std::span<const Proxy> proxies, std::vector<ProxyPair>& pairs,
                std::size_t max_pairs = no_pair_limit) {
  typename Method::Memory memory;
  find_pairs(method, proxies, pairs, max_pairs, memory);
}

// ---- Takes pairs in any order, leaves out those that may not meet, and gives them back sorted.

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
      has_groupless_ = has_groupless_ || p.group == 0;
    }
    all_may_meet_ = !has_groupless_ && (groups & ~common_mask) == 0;
  }

  /// Takes a pair that differs from those before and whose boxes touch. Neither body is skipped, and one can move.
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
  bool has_groupless_ = false;
  bool all_may_meet_ = false;
};

}  // namespace thinwall
