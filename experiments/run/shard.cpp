#include <thinwall/experiments/run/shard.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/random.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

Shard parse_shard(std::string_view text) {
  constexpr std::int64_t most = 1'000'000;
  const auto slash = text.find('/');
  if (slash != std::string_view::npos) {
    const auto index = parse_count(text.substr(0, slash)), count = parse_count(text.substr(slash + 1));
    if (index && count && *index >= 1 && *index <= *count && *count <= most) {
      return {static_cast<int>(*index), static_cast<int>(*count)};
    }
  }
  throw UsageError(
      fmt::format("--shard: '{}' is not allowed; i/N, the i-th of N shards: whole numbers with 1 <= i <= N <= {}",
                  one_line(text), most));
}

std::string to_text(const Shard& shard) { return fmt::format("{}/{}", shard.index, shard.count); }

std::vector<int> deal(std::size_t units, int shards) {
  // Without the shuffle a number of shards that divides the number of methods would give a shard one method alone.
  std::vector<std::pair<std::uint64_t, std::size_t>> cards(units);
  for (std::size_t i = 0; i < units; ++i) cards[i] = {random_words({.seed = 0, .stream = 0}, i, 0)[0], i};
  std::ranges::sort(cards);
  std::vector<int> owners(units);
  for (std::size_t k = 0; k < units; ++k) {
    owners[cards[k].second] = 1 + static_cast<int>(k % static_cast<std::size_t>(shards));
  }
  return owners;
}

std::vector<std::size_t> units_of(const Shard& shard, std::size_t units) {
  const std::vector<int> owners = deal(units, shard.count);
  std::vector<std::size_t> hand;
  for (std::size_t i = 0; i < units; ++i) {
    if (owners[i] == shard.index) hand.push_back(i);
  }
  return hand;
}

}  // namespace thinwall
