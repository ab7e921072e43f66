// SPDX-License-Identifier: BSD-3-Clause
/// Messages -> pictures. Pure functions: what they show is in the message.
#pragma once

#include <opencv2/core.hpp>
#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/MarkerArray.h>

#include "chain_tracker/TrackedObjectArray.h"

namespace chain_tracker {

/// Red at confidence 0 over amber to green at 1; grey for what is hidden. Opaque.
std_msgs::ColorRGBA colorOf(double confidence, bool visible);

/// The image (CV_8UC3 BGR) with the objects drawn on it: the window of every part, turned with it
/// and coloured by its confidence, the chain through the centres, the outline, the points given, a
/// label of id, state and confidence. A LOST object is a label only, in the top left corner.
/// Lines and letters grow with the image.
cv::Mat drawOverlay(const cv::Mat& image, const TrackedObjectArray& objects);

/// The objects in the plane z = 0 of the image's frame, x right and y down, at `pixel_size` [m/px].
/// Namespace = id of the object. The array begins with the order to delete all markers of before,
/// so that an object that is LOST or gone leaves nothing behind.
visualization_msgs::MarkerArray toMarkers(const TrackedObjectArray& objects, double pixel_size);

}  // namespace chain_tracker
