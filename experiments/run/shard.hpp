#pragma once
/// A run cut into parts for machines that know nothing of each other.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace thinwall {

/// Part `index` of `count`, counted from 1.
struct Shard {
  int index = 1;  ///< 1 to count
  int count = 1;  ///< >= 1
  bool operator==(const Shard&) const = default;
};

/// From `2/4`. Throws UsageError.
Shard parse_shard(std::string_view text);

std::string to_text(const Shard& shard);  ///< `2/4`

/// The index of the shard that each of `units` units belongs to. The units are shuffled, always the same way, and dealt
/// out like cards: each shard gets as many, give or take one, and a fair mix of the cheap and the dear.
std::vector<int> deal(std::size_t units, int shards);

/// Which of `units` units belong to the shard, in their own order.
std::vector<std::size_t> units_of(const Shard& shard, std::size_t units);

}  // namespace thinwall
