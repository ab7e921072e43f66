// SPDX-License-Identifier: BSD-3-Clause
#include "chain/robust_costs.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/random_inputs.h"

namespace chain_tracker {
namespace {

TEST(SoftenCosts, bendsWhatLiesAboveTheOnset) {
  RandomInputs random(1);
  for (const cv::Size& size : {cv::Size(1, 1), cv::Size(7, 3), cv::Size(33, 31)}) {
    const cv::Mat1f before = random.costMaps(1, size).front();
    const double onset = cv::mean(before)[0];
    for (const double slope : {0.0, 0.3, 1.0}) {
      cv::Mat1f costs = before.clone();
      softenCosts(onset, slope, costs);
      for (int row = 0; row < size.height; ++row) {
        for (int column = 0; column < size.width; ++column) {
          const double cost = before(row, column);
          const double expected = std::min(cost, onset) + slope * std::max(0.0, cost - onset);
          ASSERT_NEAR(expected, costs(row, column), 1e-4) << "slope " << slope;
        }
      }
    }
  }
}

TEST(SoftenCosts, takeAnOnsetBelowNoughtForNought) {
  cv::Mat1f costs = (cv::Mat1f(1, 2) << 2.0F, 4.0F);
  softenCosts(-3.0, 0.5, costs);
  EXPECT_FLOAT_EQ(1.0F, costs(0, 0));
  EXPECT_FLOAT_EQ(2.0F, costs(0, 1));
}

TEST(AddTravelCosts, addTheWeightedDistance) {
  RandomInputs random(2);
  const cv::Point2d origin(100.25, 40.5);
  const cv::Point2d expected(131.0, 52.75);
  for (const int step : {1, 3}) {
    const cv::Mat1f before = random.costMaps(1, {19, 11}).front();
    cv::Mat1f costs = before.clone();
    addTravelCosts(origin, step, expected, 0.125, costs);
    for (int row = 0; row < costs.rows; ++row) {
      for (int column = 0; column < costs.cols; ++column) {
        const cv::Point2d position = origin + step * cv::Point2d(column, row);
        ASSERT_NEAR(before(row, column) + 0.125 * cv::norm(position - expected), costs(row, column),
                    1e-3);
      }
    }
  }
}

}  // namespace
}  // namespace chain_tracker
