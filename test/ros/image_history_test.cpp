// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/ros/image_history.h"

#include <stdexcept>
#include <string>

#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

Frame frame(std::uint64_t number, double stamp, std::uint32_t width = 64) {
  const auto image = boost::make_shared<sensor_msgs::Image>();
  image->header.stamp = ros::Time(stamp);
  image->width = width;
  image->height = 48;
  return {number, image};
}

std::string refusalAt(const ImageHistory& history, double stamp) {
  try {
    history.at(ros::Time(stamp));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ImageHistory, FindsAFrameByItsStamp) {
  ImageHistory history(5);
  for (const std::uint64_t number : {1, 2, 3}) {
    history.add(frame(number, 10.0 + static_cast<double>(number)));
  }
  EXPECT_EQ(history.at(ros::Time(12.0)).number, 2u);
  EXPECT_TRUE(history.holds(ros::Time(12.0)));
  EXPECT_FALSE(history.holds(ros::Time(12.5)));
}

TEST(ImageHistory, RefusesOtherStampsNamingThoseHeld) {
  ImageHistory history(2);
  EXPECT_NE(refusalAt(history, 5.0).find("none"), std::string::npos);
  for (const std::uint64_t number : {1, 2, 3}) {
    history.add(frame(number, 10.0 + static_cast<double>(number)));
  }
  for (const double stamp : {11.0, 12.5, 14.0}) {
    SCOPED_TRACE(stamp);
    const std::string refusal = refusalAt(history, stamp);
    EXPECT_NE(refusal.find("from 12.000000000 to 13.000000000"), std::string::npos) << refusal;
  }
}

TEST(ImageHistory, ListsTheFramesBetween) {
  ImageHistory history(10);
  for (const std::uint64_t number : {1, 2, 3, 4, 5}) {
    history.add(frame(number, static_cast<double>(number)));
  }
  const std::vector<Frame> frames = history.between(2, 4);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].number, 3u);
  EXPECT_EQ(frames[1].number, 4u);
  EXPECT_TRUE(history.between(5, 5).empty());
}

TEST(ImageHistory, ForgetsAnotherStream) {
  ImageHistory history(10);
  history.add(frame(1, 10.0));
  history.add(frame(2, 11.0));
  history.add(frame(3, 5.0));
  EXPECT_FALSE(history.holds(ros::Time(11.0)));
  EXPECT_TRUE(history.holds(ros::Time(5.0)));
  history.add(frame(4, 6.0, 128));
  EXPECT_FALSE(history.holds(ros::Time(5.0)));
  EXPECT_TRUE(history.holds(ros::Time(6.0)));
}

TEST(ImageHistory, KeepsImagesThatComeOutOfOrder) {
  ImageHistory history(10);
  history.add(frame(1, 10.0));
  history.add(frame(2, 9.6));
  history.add(frame(3, 0.0));  // no stamp at all
  history.add(frame(4, 10.1));
  EXPECT_EQ(history.between(0, 4).size(), 4u);
}

TEST(ImageHistory, OfNoCapacityHoldsNothing) {
  ImageHistory history(0);
  history.add(frame(1, 10.0));
  EXPECT_FALSE(history.holds(ros::Time(10.0)));
}

}  // namespace
}  // namespace chain_tracker
