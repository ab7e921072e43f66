// SPDX-License-Identifier: BSD-3-Clause
/// ROS image -> the one pixel format the tracker sees.
#pragma once

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/Image.h>

namespace chain_tracker {

/// The image as CV_8UC3 BGR; shares the message's memory if it is bgr8 already, so do not write.
///
/// Grey images become grey BGR: objects of one tracker see one format whatever the camera sends.
/// 16-bit images are scaled from [0, 65535] to [0, 255], Bayer images are demosaiced. The plain
/// OpenCV encodings are read as OpenCV orders them: 8UC1 and 16UC1 as grey, 8UC3 and 16UC3 as BGR,
/// 8UC4 and 16UC4 as BGRA.
/// Throws std::invalid_argument, naming the encoding and the size, if the image is empty, its
/// encoding has no colour or grey in it, or its data does not fit its size.
cv_bridge::CvImageConstPtr toBgr8(const sensor_msgs::ImageConstPtr& message);

}  // namespace chain_tracker
