// SPDX-License-Identifier: BSD-3-Clause
/// Surfaces that scenes are made of.
#pragma once

#include <opencv2/core.hpp>

namespace chain_tracker {

/// Smooth noise of several octaves around `mean`, `contrast` grey levels strong.
cv::Mat3b paintNoise(const cv::Size& size, const cv::Scalar& mean, double contrast, cv::RNG& rng);

/// The same of a surface of one colour: lighter and darker, hardly coloured.
cv::Mat3b paintMottle(const cv::Size& size, const cv::Scalar& mean, double contrast, cv::RNG& rng);

/// Adds fine noise, the same in all channels, smoothed over `softness` px; both > 0.
void addGrain(double contrast, double softness, cv::RNG& rng, cv::Mat3b& image);

/// Wood with its grain along +x.
cv::Mat3b paintWood(const cv::Size& size, const cv::Scalar& mean, double contrast, cv::RNG& rng);

/// Light that falls from one side and less towards the corners; `strength` in [0, 1).
void shadeUnevenly(double strength, cv::RNG& rng, cv::Mat3b& image);

/// Mixes a colour into the image where `weight` (0-255) says.
void tint(const cv::Mat1b& weight, const cv::Scalar& color, cv::Mat3b& image);

/// Lines of print: dark words on the rectangle, `line_height` px apart.
void paintPrint(const cv::Rect& area, int line_height, const cv::Scalar& ink, cv::RNG& rng,
                cv::Mat3b& image);

cv::Scalar randomColor(cv::RNG& rng);
/// As most things are: not very colourful.
cv::Scalar mutedColor(cv::RNG& rng);

}  // namespace chain_tracker
