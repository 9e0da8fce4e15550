#pragma once
/// Times several ways on the same work, in turn.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <functional>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <thinwall/experiments/lab/random.hpp>
#include <thinwall/experiments/lab/statistics.hpp>

namespace thinwall {

// ---- Times of several loops over the same queries, in rounds that are interleaved, so that whatever else the machine does
// befalls all of them alike.

/// Keeps a whole answer from being optimized away.
template <class T> void keep(const T& value) { asm volatile("" : : "m"(value) : "memory"); }

template <class Query> struct TimedLoop {
  std::function<void(std::span<const Query>)> run;
  std::vector<double> nanoseconds = {};  ///< a query, one of each round
  std::size_t slice = 0;                 ///< queries a round: all, or for a slow loop as many as fit
};

template <class Query> double nanoseconds_a_query(const TimedLoop<Query>& loop, std::span<const Query> queries) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  loop.run(queries);
  const std::chrono::duration<double, std::nano> spent = Clock::now() - start;
  return spent.count() / static_cast<double>(queries.size());
}

/// A round of every loop, in an order of its own, each on the slice of the queries that is next. A slice takes about
/// `round_ns`, but for the fastest loops, which are through with all queries sooner, and the slowest, which are asked eight.
template <class Query>
void run_rounds(std::vector<TimedLoop<Query>>& loops, std::span<const Query> queries, std::int64_t rounds,
                double round_ns, const RandomStream& stream) {
  const std::size_t all = queries.size(), least = std::min<std::size_t>(8, all);
  for (TimedLoop<Query>& loop : loops) {
    loop.run(queries.first(least));
    loop.slice = least;
    for (int look = 0; look < 2; ++look) {  // warms up, too: on as many as a few of them say that fit
      const double fits = round_ns / std::max(1.0, nanoseconds_a_query(loop, queries.first(loop.slice)));
      loop.slice = std::clamp(static_cast<std::size_t>(std::min(fits, static_cast<double>(all))), least, all);
    }
  }
  std::vector<std::size_t> order(loops.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::uint64_t round = 0; round < static_cast<std::uint64_t>(rounds); ++round) {
    for (std::size_t i = order.size(); i > 1; --i) {
      const double place = uniform(random_words(stream, round, i)[0]) * static_cast<double>(i);
      std::swap(order[i - 1], order[static_cast<std::size_t>(place)]);
    }
    for (const std::size_t i : order) {
      TimedLoop<Query>& loop = loops[i];
      const std::size_t slices = queries.size() / loop.slice;
      const auto some = queries.subspan(round % slices * loop.slice, loop.slice);
      loop.nanoseconds.push_back(nanoseconds_a_query(loop, some));
    }
  }
}

// ---- What rounds of timing give: the clock they read, and the median with its interval.

/// [s] of the processor that this thread has had: what others do meanwhile does not count.
inline double thread_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The median, and its interval by bootstrap over the rounds. Not empty.
inline Measured median_of_rounds(const std::vector<double>& rounds) {
  const std::array<double, 1> key = {static_cast<double>(rounds.size())};
  return {median(rounds), bootstrap_median(rounds, {1, stream_of(key)})};
}

}  // namespace thinwall
