// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/ros/frame_mailbox.h"

#include <chrono>
#include <future>

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

TEST(FrameMailbox, TheLatestFrameWinsAndTheOthersAreCounted) {
  FrameMailbox mailbox;
  for (const std::uint64_t number : {1, 2, 3}) mailbox.put({number, nullptr});
  EXPECT_EQ(mailbox.drops(), 2u);
  EXPECT_EQ(mailbox.take()->number, 3u);
  mailbox.put({4, nullptr});
  EXPECT_EQ(mailbox.take()->number, 4u);
  EXPECT_EQ(mailbox.drops(), 2u);
}

TEST(FrameMailbox, TakingWaitsForAFrame) {
  FrameMailbox mailbox;
  auto taken = std::async(std::launch::async, [&mailbox] { return mailbox.take(); });
  EXPECT_EQ(taken.wait_for(std::chrono::milliseconds(50)), std::future_status::timeout);
  mailbox.put({7, nullptr});
  ASSERT_EQ(taken.wait_for(std::chrono::seconds(10)), std::future_status::ready);
  EXPECT_EQ(taken.get()->number, 7u);
}

TEST(FrameMailbox, ClosingEndsTheWaitForGood) {
  FrameMailbox mailbox;
  auto taken = std::async(std::launch::async, [&mailbox] { return mailbox.take(); });
  mailbox.close();
  ASSERT_EQ(taken.wait_for(std::chrono::seconds(10)), std::future_status::ready);
  EXPECT_FALSE(taken.get().has_value());
  mailbox.put({1, nullptr});
  EXPECT_FALSE(mailbox.take().has_value());
}

}  // namespace
}  // namespace chain_tracker
