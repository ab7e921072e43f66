// SPDX-License-Identifier: BSD-3-Clause
/// Inputs and comparisons for tests of the Haar front end.
#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/haar/haar_feature.h"
#include "support/random_inputs.h"

namespace chain_tracker {

/// Features of 1 to 4 rectangles with sides up to `reach` and weights up to 3, some of them
/// shifted, negated or scaled copies of others.
haar::FeatureEnsemble randomEnsemble(RandomInputs& random, int features, int reach);

/// Features that factor well: boxes, edges and bars with sides up to `reach`.
haar::FeatureEnsemble randomShapes(RandomInputs& random, int features, int reach);

/// Empty if all responses are equal; otherwise the first feature and place where they are not.
std::string firstDifference(const std::vector<cv::Mat1i>& expected,
                            const std::vector<cv::Mat1i>& actual);

/// The folder of OpenCV's cascades of the package opencv-data; empty if it is not installed.
std::string cascadeFolder();

}  // namespace chain_tracker
