#include <gtest/gtest.h>

#include <thinwall/experiments/program/run.hpp>

namespace thinwall {
namespace {

Progress at(std::int64_t done, std::int64_t all, std::int64_t resumed = 0) {
  return {.units_done = 1, .units = 2, .trials_done = done, .trials = all, .trials_resumed = resumed};
}

TEST(ProgressLine, shows_share_count_rate_and_time_left) {
  EXPECT_EQ(progress_line(at(0, 100), 0), "[                        ]   0 %  0 trials");
  EXPECT_EQ(progress_line(at(2500000, 10000000), 2),
            "[======                  ]  25 %  2.5 M trials  1.2 M/s  6 s left");
  EXPECT_EQ(progress_line(at(100, 100), 1), "[========================] 100 %  100 trials  100/s  0 s left");
}

TEST(ProgressLine, takes_the_rate_from_what_was_computed_now) {
  EXPECT_EQ(progress_line(at(900, 1000, 800), 1), "[=====================   ]  90 %  900 trials  100/s  1 s left");
  EXPECT_EQ(progress_line(at(800, 1000, 800), 1), "[===================     ]  80 %  800 trials");
}

TEST(ProgressLine, fits_a_terminal_and_survives_an_empty_run) {
  EXPECT_LE(progress_line(at(123456789012, 1234567890123), 0.001).size(), 79u);
  EXPECT_EQ(progress_line({}, 0), "[========================] 100 %  0 trials");
}

}  // namespace
}  // namespace thinwall
