// SPDX-License-Identifier: BSD-3-Clause
#include "support/map_difference.h"

#include <cmath>
#include <sstream>

namespace chain_tracker {

std::string firstDifference(const cv::Mat& expected_map, const cv::Mat& actual_map,
                            double tolerance) {
  cv::Mat1d expected;
  cv::Mat1d actual;
  expected_map.convertTo(expected, CV_64F);
  actual_map.convertTo(actual, CV_64F);
  std::ostringstream text;
  if (expected.size() != actual.size()) {
    text << "the map is " << actual.size() << ", expected " << expected.size();
    return text.str();
  }
  for (int row = 0; row < expected.rows; ++row) {
    for (int column = 0; column < expected.cols; ++column) {
      const double wanted = expected(row, column);
      const double value = actual(row, column);
      if (wanted == value || std::abs(wanted - value) <= tolerance) continue;
      text.precision(9);
      text << "row " << row << ", column " << column << " is " << value << ", expected " << wanted;
      return text.str();
    }
  }
  return "";
}

}  // namespace chain_tracker
