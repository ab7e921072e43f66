// SPDX-License-Identifier: BSD-3-Clause
/// What must hold before an object can be learned or tracked. Each check throws
/// std::invalid_argument naming the thing, its value and what is allowed.
#pragma once

#include <stdexcept>
#include <string>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_model.h"

namespace chain_tracker {

/// Another image may do.
class NothingToSee : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// "640x480"
std::string textOf(const cv::Size& size);

/// All faults of the model at once.
void requireModel(const ChainModel& model);

/// Not empty, CV_8UC3 or CV_8UC1.
void requireImage(const cv::Mat& image);

/// Size and type are those of the first image.
void requireSameKind(const cv::Mat& image, const cv::Size& first_size, int first_type);

/// A smaller part has no histogram worth the name [px].
constexpr double kSmallestSide = 4.0;

/// Whether the parts are large enough to have a histogram and fit into the image.
bool havePartsRoom(const ChainLayout& layout, const cv::Size& image_size);
void requirePartsFit(const ChainLayout& layout, const cv::Size& image_size);

/// At least half of the target lies inside the image: objects often stick out a little.
void requireInside(const Silhouette& silhouette, const cv::Size& image_size);

/// In the target's surroundings some pixels differ: where nothing is to be seen, as before a
/// covered lens, nothing could be followed. Throws NothingToSee.
void requireContrast(const cv::Mat& image, const Silhouette& silhouette);

/// As more are never worth while.
constexpr int kMostThreads = 256;

/// In [1, kMostThreads].
void requireThreads(int threads);

}  // namespace chain_tracker
