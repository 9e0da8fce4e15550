// Whom a body may meet, kept up to date.

#include <thinwall/experiments/world/pairs.hpp>

#include <gtest/gtest.h>

namespace thinwall::testing {
namespace {

/// However often bodies turn in a step: what is kept of them is bounded by how many there are.
TEST(Neighbors, keep_one_box_a_body_and_one_link_a_pair) {
  constexpr std::uint32_t count = 8;
  std::vector<Proxy> proxies(count);
  const auto box_at = [](double x) {
    Proxy box;
    box.low = {x, 0, 0};
    box.high = {x + 1, 1, 1};
    return box;
  };
  for (std::uint32_t i = 0; i < count; ++i) proxies[i] = box_at(i);
  const std::vector<bool> has_links(count, true);
  Neighbors neighbors;
  neighbors.begin(proxies, {}, has_links, false);
  const auto wander = [&](int rounds) {
    for (int round = 0; round < rounds; ++round) {
      for (std::uint32_t i = 0; i < count; ++i)
        neighbors.change(i, box_at((i + static_cast<std::uint32_t>(round)) % count));
    }
    return neighbors.bytes();
  };
  wander(count);
  const std::size_t once_around = wander(count);
  EXPECT_EQ(wander(100 * count), once_around);
}

}  // namespace
}  // namespace thinwall::testing
