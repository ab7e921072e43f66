// SPDX-License-Identifier: BSD-3-Clause
/// Places that scenes happen in.
#pragma once

#include <opencv2/core.hpp>

namespace chain_tracker {

/// A wall with stains, boards and blobs of many colours.
cv::Mat3b paintWall(const cv::Size& size, cv::RNG& rng);
/// A wooden desk with printed sheets on it.
cv::Mat3b paintDesk(const cv::Size& size, cv::RNG& rng);
/// A hall with crates, pipes and shelves, out of focus.
cv::Mat3b paintWorkshop(const cv::Size& size, cv::RNG& rng);
/// Book shelves, out of focus.
cv::Mat3b paintBookcase(const cv::Size& size, cv::RNG& rng);
/// Wet tissue with vessels and glints.
cv::Mat3b paintTissue(const cv::Size& size, cv::RNG& rng);
/// A dim room with lamps far out of focus.
cv::Mat3b paintDimRoom(const cv::Size& size, cv::RNG& rng);
/// A pavement with a kerb, grass and leaves.
cv::Mat3b paintStreet(const cv::Size& size, cv::RNG& rng);

}  // namespace chain_tracker
