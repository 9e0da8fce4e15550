#include <thinwall/experiments/lab/random.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/lab/statistics.hpp>

namespace thinwall {
namespace {

/// Known answers of Philox4x64-10, from the file kat_vectors of Random123.
TEST(Random, knows_the_published_answers) {
  const r123::Philox4x64 philox;
  const auto zeros = philox({{0, 0, 0, 0}}, {{0, 0}});
  EXPECT_EQ(
      (std::array{zeros[0], zeros[1], zeros[2], zeros[3]}),
      (std::array<std::uint64_t, 4>{0x16554d9eca36314c, 0xdb20fe9d672d0fdc, 0xd7e772cee186176b, 0x7e68b68aec7ba23b}));
  constexpr std::uint64_t ones = std::numeric_limits<std::uint64_t>::max();
  const auto full = philox({{ones, ones, ones, ones}}, {{ones, ones}});
  EXPECT_EQ(
      (std::array{full[0], full[1], full[2], full[3]}),
      (std::array<std::uint64_t, 4>{0x87b092c3013fe90b, 0x438c3c67be8d0224, 0x9cc7d7c69cd777b6, 0xa09caebf594f0ba0}));
}

TEST(Random, words_are_philox_at_key_and_counter) {
  EXPECT_EQ(random_words({0, 0}, 0, 0),
            (RandomWords{0x16554d9eca36314c, 0xdb20fe9d672d0fdc, 0xd7e772cee186176b, 0x7e68b68aec7ba23b}));
  const auto words = r123::Philox4x64()({{5, 6, 0, 0}}, {{3, 4}});
  EXPECT_EQ(random_words({3, 4}, 5, 6), (RandomWords{words[0], words[1], words[2], words[3]}));
}

TEST(Random, seed_stream_trial_and_draw_each_change_every_word) {
  const RandomWords base = random_words({1, 2}, 3, 4);
  for (const RandomWords& other :
       {random_words({2, 2}, 3, 4), random_words({1, 3}, 3, 4), random_words({1, 2}, 4, 4), random_words({1, 2}, 3, 5),
        random_words({2, 1}, 3, 4), random_words({1, 2}, 4, 3)}) {
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NE(base[i], other[i]);
  }
}

TEST(Random, uniform_reaches_zero_but_not_one) {
  EXPECT_EQ(uniform(0), 0);
  EXPECT_EQ(uniform(std::numeric_limits<std::uint64_t>::max()), 1 - 0x1p-53);
  EXPECT_EQ(uniform(std::uint64_t(1) << 63), 0.5);
}

/// Each word of the block on its own, over 64 bins: the chi-square statistic lies in its central 99.99 %.
TEST(Random, uniform_is_uniform) {
  constexpr std::int64_t bins = 64, draws = 128000;
  const Interval allowed = chi_square_range(bins - 1, 0.9999);
  for (std::size_t word = 0; word < 4; ++word) {
    std::vector<std::int64_t> counts(bins);
    for (std::uint64_t trial = 0; trial < draws; ++trial) {
      ++counts[static_cast<std::size_t>(bins * uniform(random_words({7, 11}, trial, 0)[word]))];
    }
    double sum = 0;
    for (const std::int64_t count : counts) sum += static_cast<double>((count - 2000) * (count - 2000)) / 2000;
    EXPECT_TRUE(allowed.contains(sum)) << "word " << word << ": " << sum;
  }
}

TEST(Random, streams_differ_in_every_factor_and_not_in_the_sign_of_zero) {
  const auto stream = [](std::vector<double> factors) { return stream_of(factors); };
  std::vector<std::uint64_t> streams = {stream({}),     stream({0}),    stream({0, 0}), stream({1, 0}),
                                        stream({0, 1}), stream({1, 2}), stream({2, 1}), stream({1, 2 + 0x1p-51})};
  std::sort(streams.begin(), streams.end());
  EXPECT_EQ(std::adjacent_find(streams.begin(), streams.end()), streams.end());
  EXPECT_EQ(stream({-0.0}), stream({0.0}));
  EXPECT_EQ(stream({}), 0xcbf29ce484222325);  // FNV-1a of nothing is its offset basis
}

}  // namespace
}  // namespace thinwall
