// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/scene_painting.h"

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

TEST(Sprite, MayBeAsSmallAsAPixel) {
  for (const int side : {1, 4}) {
    const double middle = 0.5 * (side - 1);
    const Sprite sprite(cv::Mat3b(side, side, cv::Vec3b::all(200)),
                        cv::Mat1b(side, side, uchar(255)), {middle, middle}, 1.0);
    for (const double scale : {0.25, 1.0, 4.0}) {
      Layer layer({16, 16});
      sprite.paint({0.0, scale, {8.0, 8.0}}, layer);
      EXPECT_GT(layer.coverageAt({8.0, 8.0}), 0) << side << " px, scale " << scale;
    }
  }
}

}  // namespace
}  // namespace chain_tracker
