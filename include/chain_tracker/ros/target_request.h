// SPDX-License-Identifier: BSD-3-Clause
/// What a user says about an object to track.
#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace chain_tracker {

struct TargetRequest {
  std::string id;
  std::string model;                ///< name, file or "auto"
  std::vector<cv::Point2d> points;  ///< where the object is [px]
};

}  // namespace chain_tracker
