#include <gtest/gtest.h>

#include <csignal>
#include <future>

#include <thinwall/experiments/lab/runner.hpp>

namespace thinwall {
namespace {

using std::chrono::milliseconds;

TEST(StopGuard, ends_what_does_not_heed_a_stop) {
  watch_for_stop();
  std::promise<void> ended;
  const StopGuard guard(milliseconds(10), [&] { ended.set_value(); });
  std::raise(SIGINT);
  EXPECT_EQ(ended.get_future().wait_for(std::chrono::seconds(60)), std::future_status::ready);
}

TEST(StopGuard, leaves_alone_what_ends_in_time_or_is_not_asked_to) {
  watch_for_stop();
  bool ended = false;
  {
    const StopGuard guard(milliseconds(0), [&] { ended = true; });
  }
  EXPECT_FALSE(ended) << "nobody asked";
  std::raise(SIGTERM);
  {
    const StopGuard guard(std::chrono::hours(1), [&] { ended = true; });
  }
  EXPECT_FALSE(ended) << "it ended within its hour";
  watch_for_stop();
}

}  // namespace
}  // namespace thinwall
