// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/ros/log_throttle.h"

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

TEST(LogThrottle, LetsEveryKindThroughOncePerPeriod) {
  using std::chrono::seconds;
  LogThrottle throttle(seconds(5));
  const LogThrottle::Clock::time_point start;
  EXPECT_TRUE(throttle.passes("a", start));
  EXPECT_FALSE(throttle.passes("a", start + seconds(4)));
  EXPECT_TRUE(throttle.passes("b", start + seconds(4)));
  EXPECT_TRUE(throttle.passes("a", start + seconds(5)));
  EXPECT_FALSE(throttle.passes("a", start + seconds(9)));
}

}  // namespace
}  // namespace chain_tracker
